// EngineClient: whatever computes, seen from the page. Three sources speak it: a worker with the engine in
// WebAssembly, a socket to `acus serve`, and a recording.
import type { Frame } from './frame';
import type { Command, Report } from './protocol';

export type Link = 'connecting' | 'open' | 'lost' | 'closed';

export interface Listener {
  report(report: Report): void;
  frame(frame: Frame): void;
  link(link: Link, words: string): void; // words say what happened, for a person
}

export interface EngineClient {
  readonly kind: 'wasm' | 'serve' | 'recording';
  connect(listener: Listener): void;
  send(command: Command): void;
  close(): void;
}

// Text that should be a report; anything else is null.
export function readReport(text: string): Report | null {
  try {
    const value: unknown = JSON.parse(text);
    return value !== null && typeof value === 'object' && 'type' in value ? (value as Report) : null;
  } catch {
    return null;
  }
}
