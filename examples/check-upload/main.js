import { init, WindingError } from 'fast-winding';

const form = document.querySelector('form');
const [say, order] = [form.querySelector('output'), form.querySelector('button')];
const BED = [220, 220, 250];
/** Ends the check of a file when another is chosen. */
let running = new AbortController();

form.model.addEventListener('change', async () => {
  const [file] = form.model.files;
  running.abort();
  running = new AbortController();
  const { signal } = running;
  order.disabled = true;
  say.value = 'looking at it…';
  try {
    const { text, prints } = await verdictOf(new Uint8Array(await file.arrayBuffer()), signal);
    say.value = text;
    order.disabled = !prints;
  } catch (error) {
    if (error.code === 'Aborted') return;
    say.value = error instanceof WindingError ? `${file.name}: ${error.message}` : 'it could not be checked';
  }
});

/** What the check says, and whether the model prints and fits on the bed. */
async function verdictOf(bytes, signal) {
  const fw = await init();
  const soup = await fw.Soup.parse(bytes, { signal, transfer: true });
  try {
    const { verdict, bed } = await soup.check({ bed: BED, signal, limit: 100 });
    return { text: verdict.text, prints: bed.fits && ['clean', 'printsAsSeen'].includes(verdict.rating) };
  } finally {
    soup.free();
  }
}
