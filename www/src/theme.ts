import { remember, remembered } from './storage.ts';

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
    remember(KEY, choice);
    apply();
  });
  apply();
}

function storedChoice(): Theme | undefined {
  const value = remembered(KEY);
  return value === 'light' || value === 'dark' ? value : undefined;
}
