// Recording: one insertion as the page saw it. Every trace is kept; shapes are kept apart from each other by a
// least travel and time, and thinned when they grow many.
import { place, type Frame, type Trace } from './frame';
import type { EngineEvent, Model } from './protocol';

const mostShapes = 900;
const shapeStep = 0.03; // s of simulated time between two kept shapes
const nodeUnit = 1e-6; // m, of a kept displacement; 16 bits reach 32 mm
const reach = 32767;

// The drawn part of a frame, small: displacements in micrometres, stress in 16 bits of its largest.
export interface Shape {
  at: number; // index of its trace
  needle: Float32Array;
  displacement: Int16Array;
  stress: Uint16Array;
  largestStress: number;
}

export class Recording {
  readonly traces: Trace[] = [];
  readonly shapes: Shape[] = [];
  readonly events: EngineEvent[] = [];
  travelled = 0; // m, farthest so far
  private step = shapeStep;

  constructor(
    readonly model: Model,
    readonly label: string,
    readonly id: number,
  ) {}

  get length(): number {
    return this.traces.length;
  }

  add(frame: Frame): void {
    const last = this.traces.at(-1);
    if (last && frame.trace[place.time_s]! <= last[place.time_s]!) return;
    // Of a hand at rest the first moment is kept and the last.
    if (last && still(frame.trace, last) && still(last, this.traces.at(-2))) {
      this.traces[this.traces.length - 1] = frame.trace;
      return;
    }
    this.keep(frame.trace);
    const kept = this.shapes.at(-1);
    const since = kept ? frame.trace[place.time_s]! - this.traces[kept.at]![place.time_s]! : Infinity;
    if (since < this.step && frame.trace[place.stage] === last?.[place.stage]) return;
    this.shapes.push(shapeOf(frame, this.model, this.traces.length - 1));
    if (this.shapes.length > mostShapes) this.thin();
  }

  keep(trace: Trace): void {
    this.traces.push(trace);
    this.travelled = Math.max(this.travelled, trace[place.hand_travel_m]!);
  }

  // Index of the last trace at or before a time [s].
  at(time: number): number {
    return lastAtOrBefore(this.traces.length, (i) => this.traces[i]![place.time_s]!, time);
  }

  // Index of the first trace that had gone as far [m], or of the one that went farthest.
  atTravel(travel: number): number {
    let farthest = 0;
    for (let i = 0; i < this.traces.length; ++i) {
      const here = this.traces[i]![place.hand_travel_m]!;
      if (here >= travel) return i;
      if (here > this.traces[farthest]![place.hand_travel_m]!) farthest = i;
    }
    return farthest;
  }

  // A frame to draw: the trace at an index with the shape kept last before it.
  frame(index: number): Frame | null {
    const trace = this.traces[index];
    if (!trace || this.shapes.length === 0) return null;
    const shape = this.shapes[lastAtOrBefore(this.shapes.length, (i) => this.shapes[i]!.at, index)]!;
    const time = trace[place.time_s]!;
    const events = this.events.filter((event) => event.time_s <= time).length;
    return { trace, events, needle: shape.needle, ...unfolded(shape, this.model) };
  }

  private thin(): void {
    const kept = this.shapes.filter((shape, i) => i % 2 === 0 || this.stageChanges(shape.at));
    this.shapes.splice(0, this.shapes.length, ...kept);
    this.step *= 2;
  }

  private stageChanges(at: number): boolean {
    return at > 0 && this.traces[at]![place.stage] !== this.traces[at - 1]![place.stage];
  }
}

// Nothing that a person could see or read has moved.
export const still = (a: Trace, b: Trace | undefined): boolean =>
  b !== undefined &&
  a[place.stage] === b[place.stage] &&
  Math.abs(a[place.hand_travel_m]! - b[place.hand_travel_m]!) < 1e-8 &&
  Math.abs(a[place.tip_depth_m]! - b[place.tip_depth_m]!) < 1e-7 &&
  Math.abs(a[place.deflection_m]! - b[place.deflection_m]!) < 1e-7 &&
  Math.abs(a[place.hand_force_N]! - b[place.hand_force_N]!) < 1e-6;

export function shapeOf(frame: Frame, model: Model, at: number): Shape {
  const displacement = new Int16Array(frame.nodes.length);
  for (let i = 0; i < displacement.length; ++i) {
    const moved = Math.round((frame.nodes[i]! - model.nodes_m[i]!) / nodeUnit);
    displacement[i] = Math.max(-reach, Math.min(reach, moved));
  }
  let largestStress = 0;
  for (const value of frame.stress) largestStress = Math.max(largestStress, value);
  const stress = new Uint16Array(frame.stress.length);
  if (largestStress > 0) for (let i = 0; i < stress.length; ++i) stress[i] = Math.round((frame.stress[i]! / largestStress) * 65535);
  return { at, needle: frame.needle.slice(), displacement, stress, largestStress };
}

function unfolded(shape: Shape, model: Model): Pick<Frame, 'nodes' | 'stress'> {
  const nodes = new Float32Array(shape.displacement.length);
  for (let i = 0; i < nodes.length; ++i) nodes[i] = model.nodes_m[i]! + shape.displacement[i]! * nodeUnit;
  const stress = new Float32Array(shape.stress.length);
  for (let i = 0; i < stress.length; ++i) stress[i] = (shape.stress[i]! / 65535) * shape.largestStress;
  return { nodes, stress };
}

// The last of `count` rising values that is at most `limit`; 0 when none is.
function lastAtOrBefore(count: number, value: (i: number) => number, limit: number): number {
  let low = 0;
  let high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (value(middle) <= limit) low = middle;
    else high = middle - 1;
  }
  return low;
}
