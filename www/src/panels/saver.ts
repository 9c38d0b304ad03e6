import { byId } from '../dom.ts';
import type { Page } from '../page.ts';
import { MESH_FORMATS } from '../state.ts';
import type { MeshFormat, State } from '../state.ts';

/** A button that saves a mesh, and the menu of formats beside it, which is one for all: what is chosen here holds for the others too. */
export function saver(page: Page, id: string, isThere: (state: State) => boolean, save: (format: MeshFormat) => void): void {
  formatMenu(page, id, [], isThere, (format) => save(format as MeshFormat));
}

/** The same with formats of its own beside those of meshes. */
export function formatMenu(page: Page, id: string, own: readonly string[], isThere: (state: State) => boolean, save: (format: string) => void): void {
  const { store } = page;
  const button = byId<HTMLButtonElement>(id);
  const menu = byId<HTMLSelectElement>(`${id}-format`);
  menu.replaceChildren(...[...MESH_FORMATS, ...own].map((format) => new Option(format.toUpperCase(), format)));
  menu.addEventListener('change', () => {
    if (!own.includes(menu.value)) store.set({ meshFormat: menu.value as MeshFormat });
  });
  button.addEventListener('click', () => save(menu.value));
  store.on(['meshFormat'], ({ meshFormat }) => {
    menu.value = meshFormat;
  });
  store.on(['voxels', 'surface', 'repair', 'offset', 'combined'], (state) => {
    button.disabled = menu.disabled = !isThere(state);
  });
}
