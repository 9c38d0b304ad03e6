import { byId } from '../dom.ts';
import { problemOf } from '../problem.ts';

const ALL_ELSE = 'All else works without it: figures, layers, results and their files.';

/** Says in the place of the 3D view why there is none, and takes away what is for it alone. */
export function withoutView(error: unknown): void {
  const isUnsupported = document.createElement('canvas').getContext('webgl2') === null;
  const why = isUnsupported ? 'There is no 3D view: this browser gives the page no WebGL 2.' : `The 3D view could not start. ${problemOf('', error).detail}`;
  byId('no-view').textContent = `${why} ${ALL_ELSE}`;
  byId('no-view').hidden = false;
  byId('no-view').closest('.view')!.classList.add('missing');
}
