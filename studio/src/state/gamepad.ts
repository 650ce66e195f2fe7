// A gamepad: its stick or right trigger pushes, the left trigger pulls; it rumbles when something happens.
import type { EventName } from '../sources/protocol';
import type { Session } from './session.svelte';

const fastest = 40e-3; // m/s at full stick
const dead = 0.12; // share of the stick that is rest
const rumbles: Partial<Record<EventName, [number, number]>> = {
  contact: [60, 0.3],
  buckling: [220, 0.9],
  second_buckling: [220, 0.9],
  straightening: [80, 0.5],
  puncture: [140, 1],
  exit: [60, 0.3],
}; // ms, strength

export function playGamepads(session: Session): () => void {
  let last = performance.now();
  let wanted = 0;
  const first = () => navigator.getGamepads().find((pad) => pad !== null) ?? null;
  const look = () => {
    const now = performance.now();
    const passed = Math.min(0.1, (now - last) / 1000);
    last = now;
    const pad = first();
    if (pad && session.canPush) {
      const stick = pad.axes[1] ?? 0;
      const pull = (pad.buttons[7]?.value ?? 0) - (pad.buttons[6]?.value ?? 0);
      const way = Math.abs(stick) > dead ? stick : Math.abs(pull) > dead ? pull : 0;
      if (way !== 0) session.pushBy(way * Math.abs(way) * fastest * passed);
    }
    wanted = requestAnimationFrame(look);
  };
  const appear = () => {
    cancelAnimationFrame(wanted);
    last = performance.now();
    look();
  };
  window.addEventListener('gamepadconnected', appear);
  session.onEvent = (event) => {
    const [duration, strength] = rumbles[event] ?? [0, 0];
    if (duration) void first()?.vibrationActuator?.playEffect('dual-rumble', { duration, strongMagnitude: strength, weakMagnitude: strength / 2 });
  };
  return () => {
    cancelAnimationFrame(wanted);
    window.removeEventListener('gamepadconnected', appear);
    session.onEvent = null;
  };
}
