const KEY = 'fast-winding.theme';
type Theme = 'light' | 'dark';

/** Follows the system until the person chooses; `changed` is called after each change. */
export function startTheme(button: HTMLButtonElement, changed: () => void): void {
  const system = matchMedia('(prefers-color-scheme: dark)');
  let choice = storedChoice();
  const apply = (): void => {
    const theme = choice ?? (system.matches ? 'dark' : 'light');
    document.documentElement.dataset.theme = theme;
    button.textContent = theme === 'dark' ? 'Light' : 'Dark';
    button.setAttribute('aria-label', `Use the ${theme === 'dark' ? 'light' : 'dark'} theme`);
    changed();
  };
  system.addEventListener('change', apply);
  button.addEventListener('click', () => {
    choice = document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark';
    withStorage((storage) => storage.setItem(KEY, choice!));
    apply();
  });
  apply();
}

function storedChoice(): Theme | undefined {
  const value = withStorage((storage) => storage.getItem(KEY));
  return value === 'light' || value === 'dark' ? value : undefined;
}

/** Storage may be forbidden; the choice then lasts as long as the page. */
function withStorage<T>(access: (storage: Storage) => T): T | undefined {
  try {
    return access(localStorage);
  } catch {
    return undefined;
  }
}
