import { byId } from './dom.ts';

/** What a file is that is dropped on a field of its own: a second model, or a picture for the texture. */
export type DropField = 'second' | 'picture';

/** A file may be dropped anywhere on the page, where a veil shows that it will be taken, or on a field for it. */
export function acceptDrops(take: (file: File, field?: DropField) => void): void {
  const veil = byId('drop-veil');
  const fields = [...document.querySelectorAll<HTMLElement>('[data-drop]')];
  const hasFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  const fieldUnder = ({ target }: DragEvent): HTMLElement | undefined => fields.find((field) => target instanceof Element && field.contains(target));
  const clear = (): void => {
    veil.hidden = true;
    for (const field of fields) field.classList.remove('over');
  };
  addEventListener('dragover', (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    const under = fieldUnder(event);
    veil.hidden = under !== undefined;
    for (const field of fields) field.classList.toggle('over', field === under);
  });
  addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) clear();
  });
  addEventListener('drop', (event) => {
    clear();
    if (!hasFile(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) take(file, fieldUnder(event)?.dataset.drop as DropField | undefined);
  });
}
