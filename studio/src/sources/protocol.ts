// The words between page and engine, as docs/studio-protocol.md has them. All SI. They stand in one place, beside the
// engine's own worker.
export { stages } from '../../../bindings/wasm/protocol';
export type {
  Command,
  EventName,
  Expectation,
  InsertionEvent as EngineEvent,
  Loop,
  Model,
  Report,
  Stage,
} from '../../../bindings/wasm/protocol';
import type { Report } from '../../../bindings/wasm/protocol';
export type Hello = Extract<Report, { type: 'hello' }>;
