// A recording as text that fits into a page: JSON of the model and events, bytes of traces and shapes, deflated.
import { columns } from './frame';
import type { EngineEvent, Model } from './protocol';
import { Recording, type Shape } from './recording';

const version = 1;
const mostShapes = 400; // in a file; more would only make it heavy

interface Head {
  version: number;
  label: string;
  model: Model;
  events: EngineEvent[];
  traces: number;
  shapes: { at: number; points: number; largestStress: number }[];
}

type Bytes = Uint8Array<ArrayBuffer>;
const bytesOf = (array: ArrayBufferView): Bytes => new Uint8Array(array.buffer as ArrayBuffer, array.byteOffset, array.byteLength);

async function through(bytes: Bytes, stream: CompressionStream | DecompressionStream): Promise<Bytes> {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

function base64(bytes: Bytes): string {
  let text = '';
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

export async function recordingText(recording: Recording): Promise<string> {
  const every = Math.ceil(recording.shapes.length / mostShapes);
  const shapes = recording.shapes.filter((_, i) => i % every === 0 || i === recording.shapes.length - 1);
  const head: Head = {
    version,
    label: recording.label,
    model: recording.model,
    events: recording.events,
    traces: recording.length,
    shapes: shapes.map(({ at, needle, largestStress }) => ({ at, points: needle.length / 3, largestStress })),
  };
  const json = new TextEncoder().encode(JSON.stringify(head));
  const parts = [bytesOf(new Uint32Array([json.length])), json, ...recording.traces.map(bytesOf)];
  for (const shape of shapes) parts.push(bytesOf(shape.needle), bytesOf(shape.displacement), bytesOf(shape.stress));
  const whole = new Uint8Array(await new Blob(parts as Bytes[]).arrayBuffer());
  return base64(await through(whole, new CompressionStream('deflate')));
}

export async function recordingFrom(text: string): Promise<Recording> {
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const bytes = await through(packed, new DecompressionStream('deflate'));
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length))) as Head;
  if (head.version !== version) throw new Error(`This replay was made by another version of the studio (${head.version}).`);
  let offset = 4 + length;
  const take = (size: number): ArrayBuffer => {
    const part = bytes.slice(offset, offset + size).buffer;
    offset += size;
    return part;
  };
  const recording = new Recording(head.model, head.label, 0);
  for (let i = 0; i < head.traces; ++i) recording.keep(new Float64Array(take(8 * columns.length)));
  const nodes = head.model.nodes_m.length / 3;
  for (const { at, points, largestStress } of head.shapes) {
    const shape: Shape = {
      at,
      needle: new Float32Array(take(12 * points)),
      displacement: new Int16Array(take(6 * nodes)),
      stress: new Uint16Array(take(2 * nodes)),
      largestStress,
    };
    recording.shapes.push(shape);
  }
  recording.events.push(...head.events);
  return recording;
}
