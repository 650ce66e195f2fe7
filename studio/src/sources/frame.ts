// Frames: what an engine sends of one step, as bytes.
import { numberNames, readFrame, type NumberName } from '../../../bindings/wasm/protocol';
import { stages, type Stage } from './protocol';

// The columns of trace.csv in their order.
export const columns = numberNames;
export type Column = NumberName;
export const place = Object.fromEntries(columns.map((name, i) => [name, i])) as Record<Column, number>;

export type Trace = Float64Array; // one value a column

export interface Frame {
  trace: Trace;
  events: number; // so far
  needle: Float32Array; // m, x y z from hub to tip
  nodes: Float32Array; // m, x y z, now
  stress: Float32Array; // Pa, at the nodes
}

export const stageOf = (trace: Trace): Stage => stages[trace[place.stage]!] ?? 'free';

// Null for what is no frame. The numbers are a copy, so that keeping them does not keep the picture.
export function decode(bytes: ArrayBuffer): Frame | null {
  const read = readFrame(bytes);
  return read && { trace: read.numbers.slice(), events: read.events, needle: read.needle, nodes: read.nodes, stress: read.stress };
}
