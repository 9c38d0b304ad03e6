import type { Plugin } from 'vite';
import type { SampleFile } from './catalogue.ts';
import { RECIPES } from './recipes.ts';

const FOLDER = 'samples/';

/** Serves the sample models under `samples/` and writes them into a build; nothing of them is kept in the repository. */
export function samples(): Plugin {
  const made = new Map<string, Buffer>();
  const make = (file: string): Buffer | undefined => {
    const recipe = RECIPES[file as SampleFile];
    if (recipe && !made.has(file)) made.set(file, recipe());
    return made.get(file);
  };
  return {
    name: 'samples',
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const path = new URL(request.url ?? '/', 'http://localhost').pathname;
        const bytes = path.startsWith(`/${FOLDER}`) ? make(path.slice(FOLDER.length + 1)) : undefined;
        if (!bytes) return next();
        response.setHeader('Content-Type', 'application/octet-stream');
        response.end(bytes);
      });
    },
    generateBundle() {
      for (const file of Object.keys(RECIPES)) {
        this.emitFile({ type: 'asset', fileName: FOLDER + file, source: make(file)! });
      }
    },
  };
}
