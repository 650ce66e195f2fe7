import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';
import { presets } from './build/presets';

// Where the engine for a page was built; ACUS_ENGINE names another folder.
const engine = process.env.ACUS_ENGINE ?? fileURLToPath(new URL('../build/wasm/bindings/wasm', import.meta.url));
if (!existsSync(`${engine}/acus_engine.wasm`)) throw new Error(`There is no engine in ${engine}: build it first, with ./dev wasm`);

export default defineConfig({
  resolve: { alias: { 'acus-engine': engine } },
  base: './', // works from any web host, below any path
  plugins: [svelte(), presets()],
  worker: { format: 'es' },
  server: { fs: { allow: ['..', engine] } },
  build: {
    target: 'es2022',
    modulePreload: false,
    chunkSizeWarningLimit: 1200,
    // One script: a replay that is kept as a single file carries it whole.
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
});
