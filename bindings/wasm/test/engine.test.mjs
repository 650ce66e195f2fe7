// What a page can do wrong, and what the engine is made of.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { gzipSync } from "node:zlib";

import { builtFile, fileOfTree, numberNames, openEngine, readFrame, serve, stages } from "./built.mjs";

const scene = await fileOfTree("scenes/quick.toml");
const started = async (...settings) => {
  const engine = await openEngine();
  engine.command(JSON.stringify({ type: "start", scene, settings: ["tissue.tetrahedra=300", ...settings] }));
  const reports = engine.reports().map((text) => JSON.parse(text));
  assert.deepEqual(reports.map(({ type }) => type), ["hello", "model"]);
  return { engine, model: reports[1] };
};

test("malformed commands are refused in a sentence, and the engine goes on", async () => {
  const { engine } = await started();
  const nonsense = ["", "{", "null", "[".repeat(1e6), '{"type":"jump"}', '{"type":"push","travel_m":"far"}', "\0", "\ud800",
    '{"type":"start","scene":"[?"}', '{"type":"start","scene":"[tissue]\\nmesh = \\"liver.msh\\""}', '{"type":"arm"}',
    JSON.stringify({ type: "start", scene: "a.".repeat(20000) }), JSON.stringify({ type: "start", scene: "x".repeat(3e6) }),
    JSON.stringify({ type: "start", scene: "[tissue]\ntetrahedra = 1e12" })];
  for (const text of nonsense) {
    engine.command(text);
    const reports = engine.reports().map((report) => JSON.parse(report));
    assert.equal(reports.length, 1, text.slice(0, 60));
    assert.equal(reports[0].type, "refused", text.slice(0, 60));
    assert.ok(reports[0].sentence.length > 10);
  }
  assert.equal(engine.advance(0.0105), 10);
});

test("frames read back as the protocol says", async () => {
  const { engine, model } = await started();
  engine.command(JSON.stringify({ type: "steady", speed_m_s: 0.02 }));
  for (let i = 0; i < 10; ++i) engine.advance(0.01);
  const frame = readFrame(engine.frame());
  const number = (name) => frame.numbers[numberNames.indexOf(name)];
  assert.ok(Math.abs(number("hand_travel_m") - 0.02 * number("time_s")) < 1e-9);
  assert.equal(stages[number("stage")], "contact");
  assert.ok(number("hand_force_N") > 0.01);
  assert.equal(frame.nodes.length, model.nodes_m.length);
  assert.equal(frame.stress.length, model.nodes_m.length / 3);
  const hub = frame.needle.slice(0, 3);
  assert.ok(Math.abs(hub[2] - (model.entry_m[2] + model.needle_length_m - number("hand_travel_m"))) < 1e-6);
  assert.equal(readFrame(new ArrayBuffer(100)), null);
  assert.equal(readFrame(engine.frame().slice(0, -4)), null);
});

test("scene that cannot be is a sentence from runScene too", async () => {
  const engine = await openEngine();
  assert.match(engine.runScene("[needle]\nlength_mm = -1").sentence, /length_mm/);
});

test("names of numbers are the columns of the trace", async () => {
  const table = await fileOfTree("src/acus/io/trace_columns.cpp");
  const columns = [...table.matchAll(/Column<Frame>\{"(\w+)"/g)].map((match) => match[1]);
  assert.deepEqual([...numberNames], columns);
});

// Through the worker's own code, with a port instead of a page.
test("worker answers commands and posts frames while it steps", async () => {
  const engine = await openEngine();
  const reports = [];
  const frames = [];
  const port = {
    onmessage: null,
    postMessage: (message) => (typeof message === "string" ? reports.push(JSON.parse(message)) : frames.push(readFrame(message))),
  };
  const stop = serve(engine, port);
  const send = (command) => port.onmessage({ data: JSON.stringify(command) });
  send({ type: "start", scene, settings: ["tissue.tetrahedra=300"] });
  send({ type: "steady", speed_m_s: 0.02 });
  port.onmessage({ data: 7 });
  const buckled = () => reports.some(({ event }) => event === "buckling");
  for (let i = 0; i < 1000 && !buckled(); ++i) await new Promise((resolve) => setTimeout(resolve, 10));
  stop();
  assert.deepEqual(reports.slice(0, 3).map(({ type }) => type), ["hello", "model", "refused"]);
  assert.ok(buckled());
  assert.ok(frames.length > 1);
  assert.equal(frames[0].numbers[0], 0); // at rest, before it moves
});

test("engine is smaller than 300 kB on its way", async () => {
  let bytes = 0;
  for (const name of ["acus_engine.wasm", "acus_engine.mjs", "engine.js", "worker.js", "protocol.js"])
    bytes += gzipSync(await readFile(builtFile(name)), { level: 9 }).length;
  assert.ok(bytes < 300e3, `${bytes} bytes`);
});

test("kernels are vectors: the module has SIMD instructions", async () => {
  const module = await readFile(builtFile("acus_engine.wasm"));
  // f32x4.mul is 0xfd 0xe6 0x01.
  let count = 0;
  for (let at = module.indexOf("\xfd\xe6\x01", 0, "latin1"); at >= 0; at = module.indexOf("\xfd\xe6\x01", at + 1, "latin1")) ++count;
  assert.ok(count > 100, `${count} products of four floats`);
});
