/** Whether a script is of another origin, such as a CDN's: no worker may start with it. Chromium throws then, Firefox tells later. */
export function isElsewhere({ protocol, origin }: URL): boolean {
  return /^https?:$/.test(protocol) && origin !== self.origin;
}

/** A worker of another origin. Only a script of this one may start it: one that imports the other. */
export function workerElsewhere(url: URL): Worker {
  const script = new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' });
  return new Worker(URL.createObjectURL(script), { type: 'module' });
}
