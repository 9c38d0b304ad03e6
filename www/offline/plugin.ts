import { createHash } from 'node:crypto';
import { readdirSync, readFileSync } from 'node:fs';
import type { Plugin } from 'vite';
import { SAMPLES } from '../samples/catalogue.ts';

const WORKER = 'service-worker.js';
const PUBLIC = new URL('../public/', import.meta.url);
/** Stored when they are asked for: other samples than the first, fonts of other scripts, and those for old browsers. */
const LATER = [/^samples\//, /-(cyrillic|greek|vietnamese|latin-ext)[-.]/, /\.woff$/];

/** Builds the service worker, which knows the files of the page. */
export function offline(): Plugin {
  return {
    name: 'offline',
    apply: 'build',
    buildStart() {
      this.emitFile({ type: 'chunk', id: 'offline/service-worker.ts', fileName: WORKER });
    },
    generateBundle: {
      order: 'post',
      handler(_, bundle) {
        const own = readdirSync(PUBLIC);
        const others = Object.keys(bundle).filter((path) => path !== WORKER);
        const version = createHash('sha256');
        for (const path of others.toSorted()) {
          const file = bundle[path];
          version.update(path).update(file.type === 'chunk' ? file.code : file.source);
        }
        for (const name of own) version.update(name).update(readFileSync(new URL(name, PUBLIC)));
        const first = `samples/${SAMPLES[0].file}`;
        const files = [...own, ...others.filter((path) => path === first || !LATER.some((pattern) => pattern.test(path)))];
        const worker = bundle[WORKER];
        if (worker.type !== 'chunk' || worker.imports.length > 0) throw new Error('the service worker is to be one file');
        worker.code = worker.code.replaceAll('__FILES__', JSON.stringify(files)).replaceAll('__VERSION__', JSON.stringify(version.digest('hex').slice(0, 12)));
      },
    },
  };
}
