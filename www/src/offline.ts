/** The service worker: threads on hosts that do not isolate the page, and the page without a network. */
import { byId } from './dom.ts';

const WORKER = 'service-worker.js';
const KEY = 'fast-winding.reloaded';

/** Starts it; `shown` resolves when the page has nothing else to load. */
export async function startOffline(shown: Promise<unknown>): Promise<void> {
  const { serviceWorker } = navigator;
  if (!import.meta.env.PROD || !serviceWorker) return;
  if (crossOriginIsolated) await shown;
  else isolate(serviceWorker);
  try {
    await serviceWorker.register(WORKER, { updateViaCache: 'none' });
    await shown;
    (await serviceWorker.ready).active?.postMessage('fill');
  } catch {
    // The page does without.
  }
}

/** Loads the page again when the worker has it, once and never again, and only if the person has not begun to use it: otherwise threads run the next time. */
function isolate(serviceWorker: ServiceWorkerContainer): void {
  // Within another page, isolation is that page's.
  if (serviceWorker.controller || parent !== window) return;
  let isTouched = false;
  for (const event of ['pointerdown', 'keydown', 'drop']) addEventListener(event, () => (isTouched = true), { capture: true, once: true });
  serviceWorker.addEventListener(
    'controllerchange',
    () => {
      if (!isTouched && isFirst()) location.reload();
      else byId('engine-later').hidden = false;
    },
    { once: true },
  );
}

/** False also where nothing can be remembered. */
function isFirst(): boolean {
  try {
    if (sessionStorage.getItem(KEY)) return false;
    sessionStorage.setItem(KEY, 'yes');
    return sessionStorage.getItem(KEY) === 'yes';
  } catch {
    return false;
  }
}
