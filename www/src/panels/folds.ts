const KEY = 'fast-winding.open';
/** What is open before the person has opened or closed anything. */
const OPEN_AT_FIRST = ['check-block'];

/** The blocks of the panel that fold: which of them are open is remembered. */
export function folds(): void {
  const blocks = [...document.querySelectorAll<HTMLDetailsElement>('details.fold')];
  const open = new Set(stored() ?? OPEN_AT_FIRST);
  for (const block of blocks) {
    block.open = open.has(block.id);
    block.addEventListener('toggle', () => {
      const ids = blocks.filter((other) => other.open).map(({ id }) => id);
      withStorage((storage) => storage.setItem(KEY, JSON.stringify(ids)));
    });
  }
}

function stored(): string[] | undefined {
  const value: unknown = withStorage((storage) => JSON.parse(storage.getItem(KEY) ?? 'null'));
  return Array.isArray(value) ? value.filter((id) => typeof id === 'string') : undefined;
}

/** Storage may be forbidden, and may hold anything. */
function withStorage<T>(access: (storage: Storage) => T): T | undefined {
  try {
    return access(localStorage);
  } catch {
    return undefined;
  }
}
