/** Hands bytes to the person as a file. */
export function download(bytes: Uint8Array, name: string, type: string): void {
  const url = URL.createObjectURL(new Blob([bytes as Uint8Array<ArrayBuffer>], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  // The click has taken hold of the blob once the event loop comes round.
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** `bunny.stl` → `bunny`. */
export function stem(name: string): string {
  return name.replace(/\.[^.]*$/, '');
}
