// The built engine, as the tests find it. ACUS_WASM names another folder.
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const root = new URL("../../../", import.meta.url);
const built = process.env.ACUS_WASM ? new URL(`file://${process.env.ACUS_WASM}/`) : new URL("build/wasm/bindings/wasm/", root);

export const fileOfTree = (path) => readFile(new URL(path, root), "utf8");
export const builtFile = (name) => fileURLToPath(new URL(name, built));
export const wasmBytes = () => readFile(new URL("acus_engine.wasm", built));

export const { Engine } = await import(new URL("engine.js", built));
export const { serve } = await import(new URL("worker.js", built));
export const { readFrame, numberNames, stages } = await import(new URL("protocol.js", built));

export const openEngine = async () => Engine.open(await wasmBytes());

// FNV-1a of 64 bits over bytes, as base/hash.h has it.
export class Hash {
  #high = 0xcbf29ce4;
  #low = 0x84222325;

  take(bytes) {
    let high = this.#high;
    let low = this.#low;
    for (const byte of bytes) {
      low = (low ^ byte) >>> 0;
      // times 2^40 + 0x1b3
      const product = low * 0x1b3;
      const carry = Math.floor(product / 0x100000000);
      high = (Math.imul(high, 0x1b3) + carry + (low << 8)) >>> 0;
      low = product >>> 0;
    }
    this.#high = high;
    this.#low = low;
  }

  toString() {
    return this.#high.toString(16).padStart(8, "0") + this.#low.toString(16).padStart(8, "0");
  }
}
