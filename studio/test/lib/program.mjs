// The real program, `acus` as it was built: as a server of pages, and as the engine with nothing around it.
// ACUS_PROGRAM names another one.
import { execFile, spawn } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { recordingOf, wayOf } from './hand.mjs';
import { rowsOf } from './studio.mjs';

const program = process.env.ACUS_PROGRAM ?? fileURLToPath(new URL('../../../build/release/acus', import.meta.url));
export const sceneFile = (name) => fileURLToPath(new URL(`../../../scenes/${name}.toml`, import.meta.url));
const asOptions = (settings) => Object.entries(settings).flatMap(([key, value]) => ['--set', `${key}=${value}`]);

const running = [];
// For a test that failed before it ended its servers: they would keep it alive.
export const endServers = () => Promise.all(running.splice(0).map((server) => server.end()));

// { address, end() } of `acus serve`; `end` gives the exit code.
export async function serve(scene, settings, { port = 0, options = [] } = {}) {
  const server = spawn(program, ['serve', sceneFile(scene), '--port', String(port), '--no-browser', ...asOptions(settings), ...options]);
  const exit = new Promise((ended) => server.on('exit', ended));
  const end = (signal = 'SIGINT') => {
    server.kill(signal);
    return exit;
  };
  running.push({ end });
  const address = await new Promise((found, failed) => {
    let said = '';
    const listen = (more) => {
      said += more;
      const match = said.match(/http:\/\/\S+/);
      if (match) found(match[0]);
    };
    server.stdout.on('data', listen);
    server.stderr.on('data', listen);
    void exit.then((code) => failed(new Error(`acus serve ended with ${code}: ${said}`)));
  });
  return { address, end };
}

// A whole insertion by `acus replay`, whose hand goes the way that a page's trace tells, to the bit: { rows, events },
// both read from the program's own files. `told`: what the page told its hand, in turn.
export async function nativeInsertion(scene, settings, trace, told) {
  const folder = await mkdtemp(join(tmpdir(), 'acus-native-'));
  const [recording, out] = [join(folder, 'hand.acusrec'), join(folder, 'out')];
  const way = wayOf(trace, told, { step: settings['run.time_step_ms'] / 1e3, fastest: (5 * settings['hand.speed_mm_s']) / 1e3 });
  await writeFile(recording, recordingOf(await readFile(sceneFile(scene), 'utf8'), way));
  await promisify(execFile)(program, ['replay', recording, '--out', out, ...asOptions(settings)]);
  const [rows, events] = await Promise.all(['trace.csv', 'events.csv'].map(async (name) => rowsOf(await readFile(join(out, name)))));
  await rm(folder, { recursive: true });
  return { rows, events };
}
