// The engine as JavaScript likes it: objects and ArrayBuffers instead of addresses.
import createEngine, { type EngineModule } from "./acus_engine.mjs";

export type { EngineModule } from "./acus_engine.mjs";

export interface WholeInsertion {
  state_hash: string;
  steps: number;
  outcome: string;
}

export class Engine {
  private constructor(private readonly module: EngineModule) {}

  // `wasm`: the bytes of acus_engine.wasm.
  static async open(wasm: ArrayBuffer | Uint8Array): Promise<Engine> {
    return new Engine(await createEngine({ wasmBinary: wasm }));
  }

  // A command as JSON text; what is wrong with it is answered by a report.
  command(json: string): void {
    this.withText(json, (address) => this.module._acus_command(address));
  }

  // Lets `seconds` pass, in at most `mostSteps` steps of the simulation; returns how many were taken.
  advance(seconds: number, mostSteps = 100): number {
    return this.module._acus_advance(seconds, mostSteps);
  }

  // The reports that came since the last call, as JSON texts.
  reports(): string[] {
    const texts: string[] = [];
    for (let at = this.module._acus_next_report(); at !== 0; at = this.module._acus_next_report())
      texts.push(this.module.UTF8ToString(at));
    return texts;
  }

  // The present moment, a copy; null before the first insertion.
  frame(): ArrayBuffer | null {
    const size = this.module._acus_write_frame();
    if (size === 0) return null;
    const at = this.module._acus_frame();
    return this.module.HEAPU8.slice(at, at + size).buffer as ArrayBuffer;
  }

  // Names the state of the insertion to the last bit; "" before the first.
  stateHash(): string {
    return this.module.UTF8ToString(this.module._acus_state_hash());
  }

  // A whole insertion by the scene's own hand, apart from the one that is running.
  runScene(toml: string): WholeInsertion | { sentence: string } {
    return this.withText(toml, (address) => JSON.parse(this.module.UTF8ToString(this.module._acus_run_scene(address))));
  }

  private withText<Result>(text: string, use: (address: number) => Result): Result {
    const bytes = new TextEncoder().encode(text);
    const address = this.module._malloc(bytes.length + 1);
    if (address === 0) throw new Error("the engine has no memory left");
    try {
      this.module.HEAPU8.set(bytes, address);
      this.module.HEAPU8[address + bytes.length] = 0;
      return use(address);
    } finally {
      this.module._free(address);
    }
  }
}
