// The way of a hand that a page led, found from its trace, and the recording that `acus replay` follows.

// How far the hand is at the end of each step of `step` [s]. It does as src/acus/view/led_hand.cpp says: { steady } m/s, or
// { push } m, as fast as `fastest` [m/s]. The trace has some of its moments, and which of the steps between two of them was
// the first that followed the next of `told` is not written down: one alone leads to the very bits of the later moment.
export function wayOf(trace, told, { step, fastest }) {
  const next = (travel, { push, steady }) => travel + (push === undefined ? steady * step : Math.max(-fastest * step, Math.min(fastest * step, push - travel)));
  const way = [];
  const orders = [{ steady: 0 }, ...told];
  for (const { time_s, hand_travel_m } of trace) {
    const from = way.at(-1) ?? 0;
    const steps = Math.round(time_s / step) - way.length;
    const turningAt = (turn) => {
      const part = [];
      for (let i = 0, travel = from; i < steps; ++i) part.push((travel = next(travel, orders[i < turn ? 0 : 1])));
      return part;
    };
    const leadsThere = (turn) => (turningAt(turn).at(-1) ?? from) === hand_travel_m;
    const turns = leadsThere(steps) ? [steps] : orders.length > 1 ? [...Array(steps).keys()].filter(leadsThere) : [];
    if (turns.length !== 1) throw new Error(`${turns.length} ways of the hand lead to ${hand_travel_m} m at ${time_s} s`);
    way.push(...turningAt(turns[0]));
    if (turns[0] < steps) orders.shift();
  }
  return way;
}

// A recording as docs/recording.md has it, byte by byte, that was broken off before its end: a scene [TOML] and a way.
export function recordingOf(scene, way) {
  const u32 = (value) => Buffer.from(Uint32Array.of(value).buffer);
  const u64 = (value) => Buffer.from(BigUint64Array.of(BigInt(value)).buffer);
  const text = (words) => [u32(Buffer.byteLength(words)), Buffer.from(words)];
  const block = (kind, ...parts) => {
    const payload = Buffer.concat(parts);
    return Buffer.concat([u32(kind), u32(payload.length), payload]);
  };
  const parts = [
    Buffer.concat([Buffer.from('\x89ACUS\r\n\x1a', 'latin1'), u32(1)]),
    block(1, ...text(scene), ...text('{}'), u64(0)),
    block(2, u64(1), u32(way.length), u32(0), Buffer.from(Float64Array.from(way).buffer)),
  ];
  return Buffer.concat(parts.flatMap((part, i) => [part, u32(crc32c(Buffer.concat(parts.slice(0, i + 1))))]));
}

function crc32c(bytes) {
  let rest = ~0;
  for (const byte of bytes) {
    rest ^= byte;
    for (let bit = 0; bit < 8; ++bit) rest = (rest >>> 1) ^ (rest & 1 ? 0x82f63b78 : 0);
  }
  return ~rest >>> 0;
}
