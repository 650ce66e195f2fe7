declare module 'virtual:presets' {
  const presets: { id: string; group: string; title: string; words: string; toml: string }[];
  export default presets;
}

declare module 'acus-engine/worker.js?worker' {
  const EngineWorker: new (options?: { name?: string }) => Worker;
  export default EngineWorker;
}
