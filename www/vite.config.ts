import { defineConfig } from 'vite';
import { offline } from './offline/plugin.ts';
import { samples } from './samples/plugin.ts';

/** Cross-origin isolation: without it there is no shared memory, and so no threads. */
const isolation = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp',
};

export default defineConfig({
  base: './',
  plugins: [samples(), offline()],
  // The package starts its worker by a URL next to its own code, which a pre-bundled copy would lose.
  optimizeDeps: { exclude: ['fast-winding'] },
  build: { target: 'esnext', chunkSizeWarningLimit: 900 },
  worker: { format: 'es' },
  server: { headers: isolation, fs: { allow: ['.', '../pkg'] } },
  preview: { headers: isolation },
});
