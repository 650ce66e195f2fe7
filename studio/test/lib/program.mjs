// The real program, `acus` as it was built: as a server of pages, and as the engine with nothing around it.
// ACUS_PROGRAM names another one.
import { execFile, spawn } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
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

// A whole insertion by `acus run`, whose hand goes the way that a page's trace tells: { rows, events }, both read from
// the program's own files.
export async function nativeInsertion(scene, settings, trace) {
  const folder = await mkdtemp(join(tmpdir(), 'acus-native-'));
  const path = JSON.stringify(cornersOf(trace, 5 * settings['hand.speed_mm_s']));
  await promisify(execFile)(program, ['run', sceneFile(scene), '--out', folder, ...asOptions({ ...settings, 'hand.kind': 'path', 'hand.path': path })]);
  const [rows, events] = await Promise.all(['trace.csv', 'events.csv'].map(async (name) => rowsOf(await readFile(join(folder, name)))));
  await rm(folder, { recursive: true });
  return { rows, events };
}

// A hand that rests, glides and goes on steadily goes along straight lines, [s] and [mm]. A trace has some of its
// moments; where two lines meet between two of them is found from their neighbours, and a glide too short for two
// moments of its own has the speed of a push [mm/s].
function cornersOf(trace, pushed) {
  const points = trace.map(({ time_s, hand_travel_m }) => [time_s, hand_travel_m * 1e3]);
  if (points[0][0] > 0) points.unshift([0, points[0][1]]);
  const slope = (i) => (points[i + 1] && points[i] ? (points[i + 1][1] - points[i][1]) / (points[i + 1][0] - points[i][0]) : 0);
  const alone = (i) => !same(slope(i), slope(i - 1)) && !same(slope(i), slope(i + 1));
  const corners = [points[0]];
  for (let i = 1; i + 1 < points.length; ++i) {
    const here = slope(i);
    if (same(slope(i - 1), here)) continue;
    const [[t, x], [u, y]] = [points[i], points[i + 1]];
    corners.push([t, x]);
    if (same(here, slope(i + 1))) continue;
    const [before, after] = [i - 1, i + 1].map((next) => (alone(next) ? Math.sign(here) * pushed : slope(next)));
    const meet = same(before, after) ? u - Math.abs(y - x) / pushed : (y - x + before * t - after * u) / (before - after);
    if (meet > t && meet < u) corners.push([meet, x + before * (meet - t)]);
  }
  corners.push(points.at(-1));
  return corners;
}
const same = (a, b) => Math.abs(a - b) < 1e-6 * Math.max(1, Math.abs(a), Math.abs(b));
