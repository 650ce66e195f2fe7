// What emscripten makes of exports.cpp; numbers are addresses where the name does not say otherwise.
export interface EngineModule {
  readonly HEAPU8: Uint8Array; // another one after the memory has grown
  UTF8ToString(address: number): string;
  _malloc(bytes: number): number;
  _free(address: number): void;
  _acus_command(json: number): void;
  _acus_advance(seconds: number, mostSteps: number): number;
  _acus_next_report(): number; // 0: none
  _acus_write_frame(): number; // how many bytes it has
  _acus_frame(): number;
  _acus_state_hash(): number;
  _acus_run_scene(toml: number): number;
}

export default function createEngine(options: { wasmBinary: ArrayBuffer | Uint8Array }): Promise<EngineModule>;
