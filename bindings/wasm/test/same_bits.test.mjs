// The browser's engine and the native one give the same bits: tests/physics and tests/view hold what native builds gave.
import assert from "node:assert/strict";
import { test } from "node:test";

import { Hash, fileOfTree, openEngine } from "./built.mjs";

test("hash of a text is the published one", () => {
  const hash = new Hash(); // FNV-1a test vector of Noll's list
  hash.take(new TextEncoder().encode("foobar"));
  assert.equal(String(hash), "85944171f73967e8");
});

const recorded = (await fileOfTree("tests/physics/state_hashes.txt")).trim().split("\n").map((line) => line.split(" "));

for (const [name, hash] of recorded)
  test(`final state of ${name} is the native one`, async () => {
    const engine = await openEngine();
    const insertion = engine.runScene(await fileOfTree(`tests/physics/same_bits/${name}.toml`));
    assert.equal(insertion.state_hash, hash);
  });

test("whole session by commands gives the native reports and frames, byte for byte", async () => {
  const engine = await openEngine();
  assert.equal(JSON.parse(engine.reports()[0]).type, "hello");
  const hash = new Hash();
  const events = new Set();
  const listen = () => {
    for (const report of engine.reports()) {
      const { type, event } = JSON.parse(report);
      if (type === "event") events.add(event);
      hash.take(new TextEncoder().encode(report));
    }
    const frame = engine.frame();
    if (frame) hash.take(new Uint8Array(frame));
  };
  for (const line of (await fileOfTree("tests/view/session.jsonl")).trim().split("\n")) {
    const order = JSON.parse(line);
    if (order.type) {
      engine.command(line);
      listen();
    } else
      for (let i = 0; i < order.times; ++i) {
        engine.advance(order.advance_s);
        listen();
      }
  }
  assert.deepEqual([...events].sort(), ["buckling", "contact", "exit", "puncture", "second_buckling", "straightening"]);
  assert.equal(String(hash), (await fileOfTree("tests/view/session_hash.txt")).trim());
});
