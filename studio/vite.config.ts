import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vite';
import { presets } from './build/presets';

export default defineConfig({
  base: './', // works from any web host, below any path
  plugins: [svelte(), presets()],
  worker: { format: 'es' },
  server: { fs: { allow: ['..'] } },
  build: {
    target: 'es2022',
    modulePreload: false,
    chunkSizeWarningLimit: 1200,
    // One script: a replay that is kept as a single file carries it whole.
    rollupOptions: { output: { inlineDynamicImports: true } },
  },
});
