// The engine in a worker of a page. It takes commands as JSON texts and posts reports as JSON texts and frames as
// ArrayBuffers: docs/studio-protocol.md.
import { Engine } from "./engine.js";

// What this needs of the worker's global scope; tests bring their own.
export interface Port {
  onmessage: ((message: { data: unknown }) => void) | null;
  postMessage(message: string): void;
  postMessage(message: ArrayBuffer, transfer: ArrayBuffer[]): void;
}

const tick = 8; // ms from one look at the clock to the next
const frameEvery = 15; // ms between frames, about what a screen shows
const busy = 12; // ms of stepping at a stretch, so that commands are heard
const slice = 2e-3; // s of the wall that are simulated at once
const mostSteps = 20; // in a slice
const longestGap = 0.1; // s: a page that slept does not catch up

export function serve(engine: Engine, port: Port, now = () => performance.now()): () => void {
  let last = now();
  let lastFrame = -Infinity;
  let stale = false; // the last frame posted

  const postReports = () => {
    for (const report of engine.reports()) {
      port.postMessage(report);
      if (report.startsWith('{"type":"model"')) begin();
    }
  };
  // A new insertion is shown at rest, and the time it took to build does not count.
  const begin = () => {
    last = now();
    stale = true;
    lastFrame = -Infinity;
    postFrame();
  };
  const postFrame = () => {
    if (!stale || now() - lastFrame < frameEvery) return;
    const frame = engine.frame();
    if (frame) port.postMessage(frame, [frame]);
    stale = false;
    lastFrame = now();
  };

  // What is not simulated within `busy` is left out: slow motion instead of a page that hangs.
  const advance = () => {
    const begun = now();
    for (let owed = Math.min((begun - last) / 1e3, longestGap); owed > 0 && now() - begun < busy; owed -= slice)
      if (engine.advance(Math.min(owed, slice), mostSteps) > 0) stale = true;
    last = begun;
    postReports();
    postFrame();
  };

  port.onmessage = ({ data }) => {
    engine.command(typeof data === "string" ? data : "");
    postReports();
  };
  postReports();
  const timer = setInterval(advance, tick);
  return () => clearInterval(timer);
}

// Commands that come before the engine is there are kept.
async function open(port: Port): Promise<void> {
  const early: { data: unknown }[] = [];
  port.onmessage = (message) => early.push(message);
  try {
    const answer = await fetch(new URL("./acus_engine.wasm", import.meta.url));
    if (!answer.ok) throw new Error(`its file could not be loaded (${answer.status})`);
    serve(await Engine.open(await answer.arrayBuffer()), port);
  } catch (error) {
    const sentence = `the engine could not start: ${error instanceof Error ? error.message : String(error)}`;
    port.postMessage(JSON.stringify({ type: "failed", sentence }));
    return;
  }
  for (const message of early) port.onmessage?.(message);
}

if (typeof WorkerGlobalScope !== "undefined" && self instanceof WorkerGlobalScope) void open(self as unknown as Port);
