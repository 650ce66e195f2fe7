// The person's hand in the picture: pulls the hub by mouse, pen or touch, pushes with the wheel, zooms with Ctrl and
// the wheel, and turns the view elsewhere.
import type { StageView } from '../view/stage_view';
import type { Session } from './session.svelte';

const hubLength = 24e-3; // m
const reach = { mouse: 16, pen: 22, touch: 34 } as Record<string, number>; // px around the hub
const wheelTravel = 0.25e-3; // m for a notch of 100
const leastScreen = 40; // px a metre of travel; below, the needle is seen from its end

export function handIn(session: Session): (stage: StageView, box: HTMLElement) => () => void {
  return (stage, box) => {
    const canvas = stage.pixels;
    let drag: { x: number; y: number; travel: number; fine: boolean } | null = null;

    const place = (event: PointerEvent | WheelEvent) => {
      const at = canvas.getBoundingClientRect();
      return { x: event.clientX - at.left, y: event.clientY - at.top };
    };
    const overHub = (event: PointerEvent): boolean => {
      const frame = session.frame;
      if (!frame || !session.canPush) return false;
      const { along } = stage.axes;
      const foot = stage.axes.entry.clone().set(frame.needle[0]!, frame.needle[1]!, frame.needle[2]!);
      const a = stage.rig.screen(foot);
      const b = stage.rig.screen(foot.addScaledVector(along, -hubLength));
      const p = place(event);
      const [dx, dy] = [b.x - a.x, b.y - a.y];
      const t = Math.max(0, Math.min(1, ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy || 1)));
      return Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy) < (reach[event.pointerType] ?? 16);
    };
    const down = (event: PointerEvent) => {
      if (!event.isPrimary || event.button !== 0 || !overHub(event)) return;
      event.stopImmediatePropagation();
      canvas.setPointerCapture(event.pointerId);
      stage.hold(true);
      drag = { ...place(event), travel: session.asked, fine: event.altKey };
      box.dataset.hand = 'holds';
    };
    const move = (event: PointerEvent) => {
      if (!drag) {
        canvas.style.cursor = event.pointerType === 'mouse' && event.buttons === 0 && overHub(event) ? 'grab' : '';
        return;
      }
      event.stopImmediatePropagation();
      canvas.style.cursor = 'grabbing';
      const p = place(event);
      const way = stage.travelOnScreen;
      const long = way.x * way.x + way.y * way.y;
      const [dx, dy] = [p.x - drag.x, p.y - drag.y];
      const travel = long > leastScreen ** 2 ? (dx * way.x + dy * way.y) / long : dy / stage.rig.scale;
      session.push(drag.travel + travel * (drag.fine ? 0.1 : 1));
    };
    const up = (event: PointerEvent) => {
      if (!drag) return;
      event.stopImmediatePropagation();
      drag = null;
      stage.hold(false);
      canvas.style.cursor = '';
      delete box.dataset.hand;
    };
    const wheel = (event: WheelEvent) => {
      const scrolls = document.documentElement.scrollHeight > window.innerHeight + 2;
      if (event.ctrlKey || event.metaKey) {
        event.preventDefault();
        stage.zoom(Math.exp(-event.deltaY * 0.002));
      } else if (!scrolls || box.closest('[tabindex]')?.contains(document.activeElement)) {
        event.preventDefault();
        session.pushBy((event.deltaY / 100) * wheelTravel * (event.shiftKey ? 8 : 1));
      }
    };
    // Two fingers zoom.
    const fingers = new Map<number, { x: number; y: number }>();
    const finger = (event: PointerEvent) => {
      if (event.pointerType !== 'touch') return;
      if (event.type === 'pointerup' || event.type === 'pointercancel') return void fingers.delete(event.pointerId);
      const before = [...fingers.values()];
      if (event.type === 'pointermove' && !fingers.has(event.pointerId)) return;
      fingers.set(event.pointerId, place(event));
      const now = [...fingers.values()];
      if (before.length === 2 && now.length === 2 && !drag) {
        const apart = ([a, b]: { x: number; y: number }[]) => Math.hypot(a!.x - b!.x, a!.y - b!.y) || 1;
        stage.zoom(apart(now) / apart(before));
      }
    };

    // Before the view's own turning hears of it.
    const early = { capture: true } as const;
    const heard: [string, (event: never) => void][] = [
      ['pointerdown', down],
      ['pointermove', move],
      ['pointerup', up],
      ['pointercancel', up],
    ];
    for (const name of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel']) canvas.addEventListener(name, finger as EventListener, early);
    for (const [name, act] of heard) canvas.addEventListener(name, act as EventListener, early);
    canvas.addEventListener('wheel', wheel, { passive: false });
    return () => {
      for (const name of ['pointerdown', 'pointermove', 'pointerup', 'pointercancel']) canvas.removeEventListener(name, finger as EventListener, early);
      for (const [name, act] of heard) canvas.removeEventListener(name, act as EventListener, early);
      canvas.removeEventListener('wheel', wheel);
    };
  };
}
