// WasmSource: the engine in WebAssembly, in a worker of this page.
import EngineWorker from 'acus-engine/worker.js?worker';
import { readReport, type EngineClient, type Listener } from './engine_client';
import { decode } from './frame';
import type { Command } from './protocol';

export class WasmSource implements EngineClient {
  readonly kind = 'wasm';
  private worker: Worker | null = null;

  connect(listener: Listener): void {
    listener.link('connecting', 'Loading the engine.');
    const worker = new EngineWorker({ name: 'acus engine' });
    this.worker = worker;
    worker.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data !== 'string') {
        const frame = decode(data);
        if (frame) listener.frame(frame);
        return;
      }
      const report = readReport(data);
      if (report?.type === 'hello') listener.link('open', 'The engine runs in this page.');
      if (report) listener.report(report);
    };
    worker.onerror = (event) =>
      listener.link('closed', `The engine could not be loaded${event.message ? `: ${event.message}` : ''}. Load the page again, or try a newer browser.`);
  }

  send(command: Command): void {
    this.worker?.postMessage(JSON.stringify(command));
  }

  close(): void {
    this.worker?.terminate();
    this.worker = null;
  }
}
