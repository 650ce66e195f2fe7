// RecordingSource: a kept insertion, played as if an engine sent it. It can be paused, stepped and slowed down; a
// push goes to the moment at which the hand first was there.
import type { EngineClient, Listener } from './engine_client';
import { place } from './frame';
import type { Command } from './protocol';
import type { Recording } from './recording';

const tickTime = 33; // ms

export class RecordingSource implements EngineClient {
  readonly kind = 'recording';
  index = 0; // of the trace that is shown
  running = false;
  private listener: Listener | null = null;
  private time = 0; // s, of the recording
  private factor = 1;
  private last = 0; // ms, of the wall
  private timer = 0;

  constructor(readonly recording: Recording) {}

  connect(listener: Listener): void {
    this.listener = listener;
    listener.link('open', 'A recorded insertion.');
    listener.report(this.recording.model);
    this.seek(this.recording.length - 1);
  }

  send(command: Command): void {
    if (command.type === 'pause') this.stop();
    else if (command.type === 'resume') this.play();
    else if (command.type === 'rate') this.factor = command.factor;
    else if (command.type === 'step') this.seek(this.index + command.steps);
    else if (command.type === 'push') this.seek(this.recording.atTravel(command.travel_m));
  }

  close(): void {
    this.stop();
    this.listener?.link('closed', 'The recording is closed.');
    this.listener = null;
  }

  seek(index: number): void {
    this.index = Math.max(0, Math.min(this.recording.length - 1, index));
    const frame = this.recording.frame(this.index);
    if (!frame) return;
    this.time = frame.trace[place.time_s]!;
    this.listener?.frame(frame);
  }

  private get end(): number {
    return this.recording.traces.at(-1)?.[place.time_s] ?? 0;
  }

  private play(): void {
    if (this.running) return;
    this.running = true;
    this.last = performance.now();
    if (this.time >= this.end) this.time = 0;
    this.tick();
  }

  private stop(): void {
    this.running = false;
    clearTimeout(this.timer);
  }

  private tick(): void {
    const now = performance.now();
    const time = Math.min(this.end, this.time + ((now - this.last) / 1000) * this.factor);
    this.last = now;
    if (time >= this.end) this.running = false;
    this.seek(this.recording.at(time));
    this.time = time;
    if (this.running) this.timer = window.setTimeout(() => this.tick(), tickTime);
  }
}
