/** A worker of another origin, such as a CDN. Only a script of this one may start it: one that imports the other. */
export function workerElsewhere(url: URL): Worker {
  const script = new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' });
  return new Worker(URL.createObjectURL(script), { type: 'module' });
}
