/** The element with this id; the page's markup promises it is there. */
export function byId<E extends Element = HTMLElement>(id: string): E {
  const element = document.getElementById(id);
  if (!element) throw new Error(`no element with id ${id}`);
  return element as unknown as E;
}

/** Fills a definition list with rows of a name and a value. */
export function setFacts(list: HTMLElement, facts: readonly (readonly [name: string, value: string])[]): void {
  list.replaceChildren(
    ...facts.flatMap(([name, value]) => {
      const term = document.createElement('dt');
      const description = document.createElement('dd');
      term.textContent = name;
      description.textContent = value;
      return [term, description];
    }),
  );
}

/** Fills a list with sentences; without any it is not shown. */
export function setList(list: HTMLElement, sentences: readonly string[]): void {
  list.hidden = sentences.length === 0;
  list.replaceChildren(
    ...sentences.map((text) => {
      const item = document.createElement('li');
      item.textContent = text;
      return item;
    }),
  );
}

/** Shows how far along its track a slider stands (Chromium has no part for it). */
export function paintSlider(slider: HTMLInputElement): void {
  const [min, max] = [Number(slider.min), Number(slider.max)];
  const filled = max > min ? (slider.valueAsNumber - min) / (max - min) : 0;
  slider.style.setProperty('--filled', `${(100 * filled).toFixed(2)}%`);
}

/** The value of a colour (or other) token of the style sheet. */
export function token(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** The longest that anything waits for a frame. */
const PATIENCE_MILLISECONDS = 300;

/** Resolves when the next frame is drawn; a page out of sight, which draws none, does not wait for that. */
export function nextFrame(): Promise<void> {
  return new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
    setTimeout(resolve, PATIENCE_MILLISECONDS);
  });
}
