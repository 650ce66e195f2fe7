// Keys, while the picture has the focus; everything they do is also a button or a slider.
import type { StageView } from '../view/stage_view';
import type { Session } from './session.svelte';
import { view } from './view.svelte';

const small = 0.5e-3; // m
const large = 4e-3;
const page = 10e-3;
const turn = Math.PI / 24;
const switches = [' ', 's', 'w', 'r', 'p']; // a press counts once, however long it is

export function keyDown(event: KeyboardEvent, session: Session, stage: StageView | null, speed: number): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const way = event.shiftKey ? large : small;
  const acts: Record<string, () => void> = {
    ArrowDown: () => session.pushBy(way),
    ArrowUp: () => session.pushBy(-way),
    PageDown: () => session.pushBy(page),
    PageUp: () => session.pushBy(-page),
    ArrowLeft: () => stage?.turn(-turn),
    ArrowRight: () => stage?.turn(turn),
    '+': () => stage?.zoom(1.25),
    '=': () => stage?.zoom(1.25),
    '-': () => stage?.zoom(0.8),
    '1': () => view.look('overview'),
    '2': () => view.look('side'),
    '3': () => view.look('front'),
    '4': () => view.look('along'),
    ' ': () => session.pause(session.live ? !session.paused : session.playing),
    '.': () => session.step(),
    s: () => session.steady(session.steadySpeed > 0 ? 0 : speed),
    w: () => session.steady(session.steadySpeed < 0 ? 0 : -speed),
    r: () => session.start(),
    p: () => session.play(!session.playing),
  };
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const act = acts[key];
  if (!act) return;
  event.preventDefault();
  if (event.repeat && switches.includes(key)) return;
  act();
}
