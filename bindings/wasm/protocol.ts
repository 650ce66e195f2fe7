// docs/studio-protocol.md as types: what a page and an engine say to each other, and how a frame is read.

export type Command =
  | { type: "start" | "check"; scene: string; settings?: string[] }
  | { type: "push"; travel_m: number }
  | { type: "steady"; speed_m_s: number }
  | { type: "pause" | "resume" | "arm" | "disarm" | "hold" }
  | { type: "step"; steps: number }
  | { type: "rate"; factor: number };

export type Outcome = "straight_puncture" | "buckled_then_punctured" | "never_punctured";

export interface Expectation {
  words: string;
  outcome: Outcome;
  critical_load_N: number;
  highest_load_N: number | null;
  rupture_force_N: number;
  longest_straight_m: number;
}

export type SceneTables = Record<string, Record<string, unknown>>;

export interface Model extends Expectation {
  type: "model";
  scene: SceneTables;
  scene_toml: string;
  time_step_s: number;
  entry_m: [number, number, number];
  direction: [number, number, number];
  needle_length_m: number;
  needle_radius_m: number;
  nodes_m: number[];
  tetrahedra: number[];
  triangles: number[];
}

export type EventName =
  | "contact"
  | "buckling"
  | "straightening"
  | "puncture"
  | "second_buckling"
  | "layer"
  | "exit";

export interface InsertionEvent {
  type: "event";
  time_s: number;
  event: EventName;
  hand_travel_m: number;
  hand_force_N: number;
  free_length_m: number;
}

export interface Loop {
  type: "loop";
  real_time_factor: number;
  load: number;
  paused: boolean;
  late_ticks: number;
  tick_p999_s: number;
  gate: "disarmed" | "ramping" | "armed";
  fault: string;
  device_force_N: number;
  force_limit_N: number;
  owner: boolean;
}

export type Report =
  | {
      type: "hello";
      engine: string;
      source: "wasm" | "serve";
      device: string | null;
      scenes: Record<string, string>;
    }
  | Model
  | ({ type: "expectation" } & Expectation)
  | InsertionEvent
  | { type: "refused" | "failed"; sentence: string }
  | Loop;

// The columns of trace.csv in their order.
export const numberNames = [
  "time_s",
  "hand_travel_m",
  "hand_force_N",
  "energy_force_N",
  "tip_force_N",
  "tip_depth_m",
  "inserted_length_m",
  "free_length_m",
  "critical_load_N",
  "deflection_m",
  "stage",
  "work_hand_J",
  "energy_tissue_J",
  "energy_needle_J",
  "energy_kinetic_J",
  "work_cutting_J",
  "work_friction_J",
  "work_damping_J",
  "work_numerical_J",
  "energy_residual_J",
  "solver_iterations",
  "energy_contact_J",
  "work_snap_J",
  "work_relaxation_J",
  "tip_aside_m",
  "shaft_force_N",
  "hub_force_x_N",
  "hub_force_y_N",
  "hub_force_z_N",
  "hub_moment_x_Nm",
  "hub_moment_y_Nm",
  "hub_moment_z_Nm",
] as const;
export type NumberName = typeof numberNames[number];

export const stages = ["free", "contact", "buckled", "inserted", "inserted_buckled", "withdrawn"] as const;
export type Stage = typeof stages[number];

export interface Frame {
  events: number; // so far
  numbers: Float64Array; // in the order of numberNames
  needle: Float32Array; // x, y, z of each point, m
  nodes: Float32Array; // x, y, z of each node, m
  stress: Float32Array; // of each node, Pa
}

const mark = 0x46434131;
const head = 16; // bytes

// Views into `bytes`, not copies. Null for what is no frame.
export function readFrame(bytes: ArrayBuffer): Frame | null {
  if (bytes.byteLength < head + 8 * numberNames.length) return null;
  const [found, points, nodes, events] = new Uint32Array(bytes, 0, 4) as unknown as [number, number, number, number];
  const needleAt = head + 8 * numberNames.length;
  const nodesAt = needleAt + 12 * points;
  const stressAt = nodesAt + 12 * nodes;
  if (found !== mark || bytes.byteLength !== stressAt + 4 * nodes) return null;
  return {
    events,
    numbers: new Float64Array(bytes, head, numberNames.length),
    needle: new Float32Array(bytes, needleAt, 3 * points),
    nodes: new Float32Array(bytes, nodesAt, 3 * nodes),
    stress: new Float32Array(bytes, stressAt, nodes),
  };
}
