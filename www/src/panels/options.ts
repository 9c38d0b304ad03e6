/** What a person has set in the panels is remembered, and set again when the page is loaded. */
import { hashOf } from '../address.ts';
import { byId } from '../dom.ts';
import { isRecord, remember, remembered } from '../storage.ts';

const KEY = 'fast-winding.options';

/** Fields that mean the same for every model. */
const OPTIONS = [
  'orient-method', 'check-thickness', 'check-angle', 'repair-method', 'repair-auto', 'repair-resolution', 'voxel-resolution', 'voxel-threshold',
  'voxel-method', 'surface-resolution', 'surface-fine', 'surface-smoothing', 'surface-trim', 'surface-download-format', 'offset-distance',
  'offset-resolution', 'offset-sharp', 'operation', 'texture-auto', 'texture-resolution', 'texture-smoothing', 'texture-both', 'texture-refine',
  'texture-cone', 'texture-only-seams', 'print-pace', 'heat', 'distance', 'cut',
];
/** Fields with lengths that are the model's; a height before the number of the layer of that height. */
const OF_MODEL = ['layer-height', 'layer-slider', 'offset-exact', 'hollow-thickness', 'hollow-drain', 'texture-exact'];

type Values = Record<string, string | boolean>;
interface Options {
  values: Values;
  /** Of the model at this address, without its tool. */
  model: string;
  ofModel: Values;
}
type Field = HTMLInputElement | HTMLSelectElement;

/** Sets the options again, and remembers each change; the fields' own listeners must be there already. Returns what is to be called when the first model is open. */
export function followOptions(address: () => Parameters<typeof hashOf>[0]): () => void {
  const options = stored();
  const ofThisModel = (): Values => {
    const model = hashOf({ ...address(), tool: undefined });
    if (options.model !== model) Object.assign(options, { model, ofModel: {} });
    return options.ofModel;
  };
  // Of all at once: one of them may have changed others.
  const note = ({ target }: Event): void => {
    const { id } = target as Element;
    const [ids, values] = OPTIONS.includes(id) ? [OPTIONS, options.values] : [OF_MODEL, ofThisModel()];
    if (!ids.includes(id)) return;
    for (const each of ids) values[each] = valueOf(byId<Field>(each));
    remember(KEY, options);
  };
  const start = (ids: readonly string[], values: Values): void => {
    for (const id of ids) if (id in values) setField(byId<Field>(id), values[id]);
  };
  start(OPTIONS, { ...options.values });
  for (const event of ['input', 'change']) document.addEventListener(event, note);
  return () => start(OF_MODEL, { ...ofThisModel() });
}

function stored(): Options {
  const value = remembered(KEY);
  const part = (name: string): Values => (isRecord(value) && isRecord(value[name]) ? { ...(value[name] as Values) } : {});
  return { values: part('values'), model: isRecord(value) ? String(value.model) : '', ofModel: part('ofModel') };
}

function valueOf(field: Field): string | boolean {
  return field.type === 'checkbox' ? (field as HTMLInputElement).checked : field.value;
}

/** As if the person had set it. What the field does not take is left. */
function setField(field: Field, value: unknown): void {
  if (value === valueOf(field)) return;
  const before = field.value;
  if (field.type === 'checkbox') (field as HTMLInputElement).checked = value === true;
  else field.value = String(value);
  if (field.value === '') field.value = before;
  for (const event of ['input', 'change']) field.dispatchEvent(new Event(event, { bubbles: true }));
}
