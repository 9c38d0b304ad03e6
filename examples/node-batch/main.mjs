import { readdir, readFile } from 'node:fs/promises';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { isMainThread, parentPort, Worker } from 'node:worker_threads';
import { init } from 'fast-winding/sync';

const MODEL = /\.(stl|obj|ply|off|3mf)$/i;

if (isMainThread) {
  const [folder = '../models', threads = availableParallelism()] = process.argv.slice(2);
  const files = (await readdir(folder)).filter((name) => MODEL.test(name)).sort();
  const next = (worker) => (files.length > 0 ? worker.postMessage(join(folder, files.shift())) : worker.terminate());
  for (let i = Math.min(Number(threads), files.length); i > 0; i--) {
    const worker = new Worker(new URL(import.meta.url));
    worker.on('message', (report) => {
      console.log(JSON.stringify(report));
      next(worker);
    });
    next(worker);
  }
} else {
  const fw = await init();
  parentPort.on('message', async (file) => parentPort.postMessage(await look(fw, file)));
}

/** What is known of a file, or what is wrong with it. */
async function look(fw, file) {
  try {
    const soup = fw.Soup.parse(await readFile(file));
    const { verdict, volume } = soup.check();
    soup.free();
    return { file, rating: verdict.rating, text: verdict.text, volume };
  } catch (error) {
    return { file, error: error.code, message: error.message };
  }
}
