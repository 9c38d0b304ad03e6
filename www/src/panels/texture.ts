import { saveTexture, takePicture, TEXTURE_FORMATS } from '../actions/picture.ts';
import type { TextureFormat } from '../actions/picture.ts';
import { makeTexture, remap } from '../actions/texture.ts';
import { affectedOf, isAffected } from '../affected.ts';
import { byId, setFacts, setList } from '../dom.ts';
import { count, length, milliseconds, plural, significant } from '../format.ts';
import type { Page } from '../page.ts';
import { sentence } from '../problem.ts';
import { allOf } from '../state.ts';
import type { Item, State, Timed } from '../state.ts';
import type { Store } from '../store.ts';
import type { Mapping, Texturing } from '../texture.ts';
import { atlasView } from './atlas.ts';
import { showFindings } from './defects.ts';
import { proxyFields } from './proxy.ts';
import { seamsPanel } from './seams.ts';
import { slider } from './slider.ts';
import { enableWhenUsable, reveal } from './usable.ts';

/** A texture for a soup: the proxy, its charts, the field lines that lead to it, and the picture. */
export function texturePanel(page: Page): void {
  const { store } = page;
  const isSoup = ({ model }: State): boolean => model?.shape.kind === 'soup';
  const proxy = proxyFields(page, () => store.state.texture && void remap(page, wanted()));
  const cone = slider('texture-cone');
  const [refine, onlySeams] = ['texture-refine', 'texture-only-seams'].map((id) => byId<HTMLInputElement>(id));
  const wanted = (): Mapping => ({ ...proxy(), cone: cone.valueAsNumber, onlySeams: onlySeams.checked });

  byId('texture').addEventListener('click', () => void makeTexture(page, wanted(), refine.checked));
  enableWhenUsable(page, byId<HTMLButtonElement>('texture'), isSoup);
  store.on(['model'], (state) => {
    byId('texture-cloud').hidden = !state.model || isSoup(state);
  });
  store.on(['texture'], (state) => {
    const { texture } = state;
    byId('texture-result').hidden = !texture;
    setFacts(byId('texture-facts'), texture ? factsOf(texture) : []);
    if (texture) say(texture.value);
    // What was coloured was of the texture before.
    if (store.state.defect && isAffected(store.state.defect.kind)) store.set({ defect: undefined });
    showFindings(store, byId('affected'), texture ? affectedOf(texture.value.affected) : [], ({ visible }) => ({ ...allOf(false), layer: visible.layer, defects: true, textured: true }));
    if (texture) reveal(state, 'texture-result');
  });
  shownChoice(store);
  pictureField(page);
  seamsPanel(page, wanted);
  atlasView(store);
  download(page);
}

/** What of the texture the view shows: one press for what the list of all things does with several. */
const SHOWN: Record<string, readonly Item[]> = { textured: ['textured'], charts: ['proxy'], lines: ['model', 'proxy', 'fieldLines'] };

function shownChoice(store: Store<State>): void {
  const choices = [...document.querySelectorAll<HTMLInputElement>('input[name=texture-shown]')];
  for (const choice of choices) {
    choice.addEventListener('change', () => {
      const shown = Object.fromEntries(SHOWN[choice.value].map((item) => [item, true]));
      store.set({ visible: { ...allOf(false), layer: store.state.visible.layer, ...shown }, halves: false });
    });
  }
  const flow = byId('texture-flow');
  flow.addEventListener('click', () => store.set({ isFlowing: !store.state.isFlowing }));
  store.on(['visible', 'texture', 'isFlowing'], ({ visible, isFlowing }) => {
    const shown = visible.fieldLines ? 'lines' : visible.textured ? 'textured' : visible.proxy ? 'charts' : '';
    for (const choice of choices) choice.checked = choice.value === shown;
    byId('texture-flow-row').hidden = !visible.fieldLines;
    flow.textContent = isFlowing ? 'Stop the motion' : 'Set in motion';
  });
}

/** The checker, or an image that is chosen or dropped. */
function pictureField(page: Page): void {
  const { store } = page;
  const input = byId<HTMLInputElement>('texture-file');
  byId('texture-choose').addEventListener('click', () => input.click());
  input.addEventListener('change', () => {
    if (input.files?.[0]) void takePicture(page, input.files[0]);
    input.value = '';
  });
  byId('texture-checker').addEventListener('click', () => {
    store.set({ picture: undefined });
    byId('texture-choose').focus();
  });
  store.on(['picture'], ({ picture }) => {
    byId('texture-picture').textContent = picture?.name ?? 'a checker';
    byId('texture-checker').hidden = !picture;
  });
}

function download(page: Page): void {
  const [button, menu] = [byId<HTMLButtonElement>('texture-download'), byId<HTMLSelectElement>('texture-download-format')];
  menu.replaceChildren(...Object.entries(TEXTURE_FORMATS).map(([format, label]) => new Option(label, format)));
  button.addEventListener('click', () => void saveTexture(page, menu.value as TextureFormat));
  page.store.on(['texture', 'job'], ({ texture, job }) => {
    button.disabled = menu.disabled = !texture || job !== undefined;
  });
}

function factsOf({ value: { report, lines }, milliseconds: time }: Timed<Texturing>): [string, string][] {
  const { mapping, proxyTriangles, proxyComponents } = report;
  const { meanRatio, largestRatio, areaSpread } = mapping.distortion;
  return [
    ['Proxy', `${length(report.offset)} away, ${plural(proxyTriangles, 'triangle')}${proxyComponents > 1 ? `, ${count(proxyComponents)} parts` : ''}`],
    ['Charts', `${count(report.charts)}, ${length(report.seamLength)} of seams`],
    ['Of the picture used', `${significant(100 * report.coverage, 2)} %`],
    ['Stretched, mean and most', `${significant(meanRatio, 3)}, ${significant(largestRatio, 3)}`],
    ['Areas differ by', `${significant(100 * Math.expm1(areaSpread), 2)} %`],
    ['Field lines', `${count(report.lines)}, ${count(Math.max(0, lines.offsets.length - 1))} drawn`],
    ['Computed', milliseconds(time)],
  ];
}

/** Told by the triangles that they are of. */
const LISTED = ['bad-texture', 'weak-field', 'lost-lines', 'tangential-lines'];

/** What became of the triangles, in words. */
function say({ report: { mapping, warnings } }: Texturing): void {
  const { triangles, flipped, torn, unfolded } = mapping;
  const bad = flipped + torn;
  const doubtful = bad + unfolded;
  byId('texture-verdict').dataset.rating = doubtful === 0 ? 'good' : doubtful <= 0.01 * triangles ? 'caution' : 'alarm';
  const fine = unfolded
    ? `${plural(unfolded, 'triangle')} of ${count(triangles)} ${unfolded === 1 ? 'was laid flat by itself' : 'were laid flat by themselves'}.`
    : `All ${plural(triangles, 'triangle')} have their part of the picture.`;
  byId('texture-verdict-text').textContent =
    bad === 0 ? fine : `${plural(bad, 'triangle')} of ${count(triangles)} ${bad === 1 ? 'is' : 'are'} not textured well.`;
  const others = warnings.filter(({ code }) => !LISTED.includes(code));
  setList(byId('texture-verdict-reasons'), others.map(({ message }) => sentence(message)));
}
