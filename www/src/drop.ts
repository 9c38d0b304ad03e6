import { byId } from './dom.ts';

/** A file may be dropped anywhere on the page, where a veil shows that it will be taken; on the field for it, it is the second model. */
export function acceptDrops(take: (file: File, isSecond: boolean) => void): void {
  const veil = byId('drop-veil');
  const hasFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
  const isOnSecond = ({ target }: DragEvent): boolean => target instanceof Element && target.closest('[data-drop=second]') !== null;
  const clear = (): void => {
    veil.hidden = true;
    byId('second-drop').classList.remove('over');
  };
  addEventListener('dragover', (event) => {
    if (!hasFile(event)) return;
    event.preventDefault();
    veil.hidden = isOnSecond(event);
    byId('second-drop').classList.toggle('over', isOnSecond(event));
  });
  addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) clear();
  });
  addEventListener('drop', (event) => {
    clear();
    if (!hasFile(event)) return;
    event.preventDefault();
    const file = event.dataTransfer?.files[0];
    if (file) take(file, isOnSecond(event));
  });
}
