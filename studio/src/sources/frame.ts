// Frames: what an engine sends of one step, as bytes.
import { stages, type Stage } from './protocol';

// The columns of trace.csv in their order, and the energy of the grip behind them.
export const columns = [
  'time_s',
  'hand_travel_m',
  'hand_force_N',
  'energy_force_N',
  'tip_force_N',
  'tip_depth_m',
  'inserted_length_m',
  'free_length_m',
  'critical_load_N',
  'deflection_m',
  'stage',
  'work_hand_J',
  'energy_tissue_J',
  'energy_needle_J',
  'energy_kinetic_J',
  'work_cutting_J',
  'work_friction_J',
  'work_damping_J',
  'work_numerical_J',
  'energy_residual_J',
  'solver_iterations',
  'energy_contact_J',
  'work_snap_J',
  'energy_grip_J',
] as const;
export type Column = (typeof columns)[number];
export const place = Object.fromEntries(columns.map((name, i) => [name, i])) as Record<Column, number>;

export type Trace = Float64Array; // one value a column

export interface Frame {
  trace: Trace;
  events: number; // so far
  needle: Float32Array; // m, x y z from hub to tip
  nodes: Float32Array; // m, x y z, now
  stress: Float32Array; // Pa, at the nodes
}

const magic = 0x46434131;
const head = 208;

export const stageOf = (trace: Trace): Stage => stages[trace[place.stage]!] ?? 'free';

// A frame, or what is wrong with the bytes.
export function decode(bytes: ArrayBuffer): Frame | string {
  if (bytes.byteLength < head) return `a frame of ${bytes.byteLength} bytes is too short`;
  const view = new DataView(bytes);
  if (view.getUint32(0, true) !== magic) return 'these bytes are not a frame';
  const points = view.getUint32(4, true);
  const nodes = view.getUint32(8, true);
  const size = head + 12 * points + 16 * nodes;
  if (bytes.byteLength !== size) return `a frame of ${points} points and ${nodes} nodes has ${size} bytes, not ${bytes.byteLength}`;
  return {
    trace: new Float64Array(bytes.slice(16, head)),
    events: view.getUint32(12, true),
    needle: new Float32Array(bytes, head, 3 * points),
    nodes: new Float32Array(bytes, head + 12 * points, 3 * nodes),
    stress: new Float32Array(bytes, head + 12 * (points + nodes), nodes),
  };
}

export function encode(frame: Frame): ArrayBuffer {
  const points = frame.needle.length / 3;
  const nodes = frame.stress.length;
  const bytes = new ArrayBuffer(head + 12 * points + 16 * nodes);
  const view = new DataView(bytes);
  view.setUint32(0, magic, true);
  view.setUint32(4, points, true);
  view.setUint32(8, nodes, true);
  view.setUint32(12, frame.events, true);
  new Float64Array(bytes, 16, columns.length).set(frame.trace);
  new Float32Array(bytes, head, 3 * points).set(frame.needle);
  new Float32Array(bytes, head + 12 * points, 3 * nodes).set(frame.nodes);
  new Float32Array(bytes, head + 12 * (points + nodes), nodes).set(frame.stress);
  return bytes;
}
