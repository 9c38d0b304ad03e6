/**
 * Answers for the page's files: with the headers that isolate it, which give it threads on hosts that cannot set them; and from what is
 * stored, when there is no network.
 *
 * The page itself comes from the network if that answers soon, so that it is never older than it need be. All else has a name that changes
 * with its content, or is of the same version, and comes from the store first.
 */

declare const self: ServiceWorkerGlobalScope;
/** Set when the page is built: the files that the page needs, relative to it, and a name that changes with any of them. */
declare const __FILES__: readonly string[];
declare const __VERSION__: string;

const PREFIX = 'fast-winding-';
const STORE = PREFIX + __VERSION__;
const PAGE = 'index.html';
/** Folders whose files are stored as they are asked for. */
const FOLDERS = ['assets/', 'samples/'];
/** After that the stored page is shown. */
const PATIENCE_MILLISECONDS = 3000;
const ISOLATION = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };

self.addEventListener('install', (event) => {
  // The first one is at work at once, and stores the files when the page says so. A later one is complete before its time comes: when no page of the one before is open.
  if (self.registration.active) event.waitUntil(fill());
});

self.addEventListener('activate', (event) => {
  event.waitUntil(Promise.all([removeOthers(), self.clients.claim()]));
});

self.addEventListener('message', (event) => {
  if (event.data === 'fill') event.waitUntil(fill());
});

self.addEventListener('fetch', (event) => {
  const { request } = event;
  const path = pathOf(request.url);
  if (request.method !== 'GET' || path === undefined || (request.cache === 'only-if-cached' && request.mode !== 'same-origin')) return;
  if (path === PAGE) event.respondWith(page(request).then(isolated));
  else if (__FILES__.includes(path) || FOLDERS.some((folder) => path.startsWith(folder))) event.respondWith(file(request, event).then(isolated));
});

/** Relative to the page; nothing for what is not below it. */
function pathOf(url: string): string | undefined {
  const { origin, pathname } = new URL(url);
  const scope = new URL(self.registration.scope);
  if (origin !== scope.origin || !pathname.startsWith(scope.pathname)) return undefined;
  return pathname.slice(scope.pathname.length) || PAGE;
}

async function page(request: Request): Promise<Response> {
  const stored = await (await caches.open(STORE)).match(PAGE);
  const fetched = fetch(request);
  if (!stored) return fetched;
  const late = new Promise<Response>((resolve) => setTimeout(() => resolve(stored), PATIENCE_MILLISECONDS));
  return Promise.race([fetched.then((response) => (response.status < 500 ? response : stored), () => stored), late]);
}

async function file(request: Request, event: FetchEvent): Promise<Response> {
  const store = await caches.open(STORE);
  const stored = await store.match(request, { ignoreSearch: true });
  if (stored) return stored;
  const response = await fetch(request);
  // Without room it is not stored.
  if (response.ok) event.waitUntil(store.put(request, response.clone()).catch(() => undefined));
  return response;
}

/** The same with the headers of isolation, unless the host has set its own. */
function isolated(response: Response): Response {
  if (response.type === 'error' || response.type === 'opaqueredirect' || response.headers.has('Cross-Origin-Embedder-Policy')) return response;
  const headers = new Headers(response.headers);
  for (const [name, value] of Object.entries(ISOLATION)) headers.set(name, value);
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}

/** Stores all files or none; the page is the sign that they are there. */
async function fill(): Promise<void> {
  const store = await caches.open(STORE);
  if (await store.match(PAGE)) return;
  // Past the browser's own cache, but for names that change with the content.
  await store.addAll(__FILES__.map((path) => new Request(path, { cache: path.startsWith('assets/') ? 'default' : 'reload' })));
}

async function removeOthers(): Promise<void> {
  const names = await caches.keys();
  await Promise.all(names.filter((name) => name.startsWith(PREFIX) && name !== STORE).map((name) => caches.delete(name)));
}

export {};
