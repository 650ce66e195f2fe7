// The words between page and engine, as docs/studio-protocol.md has them. All SI.

export const stages = ['free', 'contact', 'buckled', 'inserted', 'inserted_buckled', 'withdrawn'] as const;
export type Stage = (typeof stages)[number];

export type EventName =
  | 'contact'
  | 'buckling'
  | 'straightening'
  | 'puncture'
  | 'second_buckling'
  | 'layer'
  | 'exit';

export type Command =
  | { type: 'start' | 'check'; scene: string; settings: string[] }
  | { type: 'push'; travel_m: number }
  | { type: 'steady'; speed_m_s: number }
  | { type: 'pause' | 'resume' | 'arm' | 'disarm' }
  | { type: 'step'; steps: number }
  | { type: 'rate'; factor: number };

export interface Hello {
  type: 'hello';
  engine: string;
  source: 'wasm' | 'serve';
  device: string | null;
  scenes: Record<string, string>;
}

export interface Expectation {
  words: string;
  outcome: 'straight_puncture' | 'buckled_then_punctured' | 'never_punctured';
  critical_load_N: number;
  highest_load_N: number;
  rupture_force_N: number;
  longest_straight_m: number;
}

type SceneValue = number | string | boolean | number[] | number[][];
export type SceneKeys = Record<string, Record<string, SceneValue>>;

export interface Model extends Expectation {
  type: 'model';
  scene: SceneKeys;
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

export interface EngineEvent {
  type: 'event';
  time_s: number;
  event: EventName;
  hand_travel_m: number;
  hand_force_N: number;
  free_length_m: number;
}

export interface Loop {
  type: 'loop';
  real_time_factor: number;
  load: number;
  late_ticks: number;
  tick_p999_s: number;
  gate: 'disarmed' | 'ramping' | 'armed';
  fault: string;
  device_force_N: number;
  force_limit_N: number;
  owner: boolean;
}

export type Report =
  | Hello
  | Model
  | (Expectation & { type: 'expectation' })
  | EngineEvent
  | { type: 'refused' | 'failed'; sentence: string }
  | Loop;
