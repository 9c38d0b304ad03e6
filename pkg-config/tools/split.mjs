// Splits functions off a WebAssembly module into a second one that shares its memory, tables and globals and can be loaded
// later: in the first, a stub takes the place of each, which calls it through the table, after asking for it if need be.
import { readFileSync, writeFileSync } from 'node:fs';
import { withOwnCallees } from './calls.mjs';
import { npmTool } from './npm.mjs';
import { KIND, SECTION, contentOf, moduleOf, name, sectionsOf, signed, unsigned, vector } from './module.mjs';
import { StepFailed, run } from './run.mjs';

/** Under this name the second module imports what it uses of the first. */
const MAIN = 'main';
/** Exports of the first by their kind and index. */
const LETTERS = { [KIND.function]: 'f', [KIND.table]: 't', [KIND.memory]: 'm', [KIND.global]: 'g', [KIND.tag]: 'x' };
/** Exported global of the first that is 1 once the second is in place. */
const IS_PLACED = 'isPlaced';
const FUNCREF = 0x70;

const limits = ({ flags, min, max }) => [flags, ...unsigned(min), ...(max === undefined ? [] : unsigned(max))];

/** The second module's import of an item of the first. */
function importOf(kind, item, index) {
  const types = {
    [KIND.function]: () => unsigned(item.type),
    [KIND.table]: () => [item.element, ...limits({ flags: 0, min: 0 })],
    [KIND.memory]: () => limits({ ...item, min: 1 }),
    [KIND.global]: () => [item.type, item.isMutable],
    [KIND.tag]: () => [0, ...unsigned(item.type)],
  };
  return [...name(MAIN), ...name(LETTERS[kind] + index), kind, ...types[kind]()];
}

/**
 * The moved functions as a module of their own. Indices in their code stay valid, as it imports everything of the first in
 * the same order; it exports them too, so that calls among them can be tied to them.
 */
function movedModule(sections, content, moved, base) {
  const kinds = [[KIND.function, 'functions'], [KIND.table, 'tables'], [KIND.memory, 'memories'], [KIND.global, 'globals'], [KIND.tag, 'tags']];
  const imports = kinds.flatMap(([kind, list]) => content[list].map((item, index) => importOf(kind, item, index)));
  const count = content.functions.length;
  const imported = content.functions.length - content.bodies.length;
  const own = moved.map((_, k) => unsigned(count + k));
  const bodies = moved.map((index) => content.bodies[index - imported]);
  const section = (id, bytes) => ({ id, bytes: Buffer.from(bytes) });
  return moduleOf([
    sections.find(({ id }) => id === SECTION.type),
    section(SECTION.import, vector(imports)),
    section(SECTION.function, vector(moved.map((index) => unsigned(content.functions[index].type)))),
    section(SECTION.export, vector(moved.map((index, k) => [...name(`f${index}`), KIND.function, ...own[k]]))),
    section(SECTION.element, [1, 0, 0x41, ...signed(base), 0x0b, ...vector(own)]),
    section(SECTION.code, vector(bodies.map((body) => [...unsigned(body.length), ...body]))),
    sections.find(({ title }) => title === 'target_features'),
  ]);
}

/** A function that calls the table's entry `slot`, which it asks for first where it is not yet in place. */
function stub(parameters, type, slot, isPlaced, ask) {
  const code = [0x23, ...unsigned(isPlaced), 0x45, 0x04, 0x40, 0x10, ...unsigned(ask), 0x0b];
  for (let k = 0; k < parameters; k++) code.push(0x20, ...unsigned(k));
  return [0, ...code, 0x41, ...signed(slot), 0x11, ...unsigned(type), 0, 0x0b];
}

/** The first module, with stubs, a longer table, and the exports the second needs. */
function mainModule(sections, content, moved, base, needed) {
  const imported = content.functions.length - content.bodies.length;
  const ask = content.imports.filter(({ kind }) => kind === KIND.function).findIndex((i) => /placeMore/.test(i.name));
  if (ask < 0) throw new StepFailed('the module does not import what puts its second part in place');
  const isPlaced = content.globals.length;
  const slots = new Map(moved.map((index, k) => [index, base + k]));
  const body = (code, k) => {
    const slot = slots.get(imported + k);
    const { type } = content.functions[imported + k];
    const bytes = slot === undefined ? code : stub(content.parameters[type], type, slot, isPlaced, ask);
    return [...unsigned(bytes.length), ...bytes];
  };
  const tables = content.tables.map((table, k) => {
    const more = k === 0 ? moved.length : 0;
    const longer = { flags: table.flags, min: table.min + more, max: table.max === undefined ? undefined : table.max + more };
    return [table.element, ...limits(longer)];
  });
  const globals = sections.find(({ id }) => id === SECTION.global).bytes;
  const count = content.globals.length - content.imports.filter(({ kind }) => kind === KIND.global).length;
  const exports = [...content.exports, ...needed, [...name(IS_PLACED), KIND.global, ...unsigned(isPlaced)]];
  const replaced = {
    [SECTION.table]: () => vector(tables),
    [SECTION.global]: () => [...unsigned(count + 1), ...globals.subarray(unsigned(count).length), 0x7f, 1, 0x41, 0, 0x0b],
    [SECTION.export]: () => vector(exports),
    [SECTION.code]: () => vector(content.bodies.map(body)),
  };
  return moduleOf(sections.map(({ id, bytes }) => ({ id, bytes: replaced[id] ? Buffer.from(replaced[id]()) : bytes })));
}

/** Everything the second module imports, as exports of the first. */
function exportsFor(second) {
  return contentOf(sectionsOf(second)).imports.map((item) => {
    if (item.module !== MAIN) throw new StepFailed(`the second part imports ${item.module}.${item.name}`);
    return [...name(item.name), item.kind, ...unsigned(Number(item.name.slice(1)))];
  });
}

/**
 * Splits the module in the file `main`: functions whose names match `isMoved`, and those that only these call, go to the file `second`,
 * optimised already, as `options` of wasm-opt say.
 */
export async function split(main, second, isMoved, options) {
  const sections = sectionsOf(readFileSync(main));
  const content = contentOf(sections);
  const imported = content.functions.length - content.bodies.length;
  const named = [...content.names].filter(([index, name]) => index >= imported && isMoved.test(name)).map(([index]) => index);
  const moved = await withOwnCallees(sections, named, content, second);
  if (named.length === 0) throw new StepFailed(`no function of ${main} has a name like ${isMoved}`);
  const [table] = content.tables;
  if (table?.element !== FUNCREF) throw new StepFailed(`the first table of ${main} holds no functions`);
  writeFileSync(second, movedModule(sections, content, moved, table.min));
  // Calls of a moved function by another become direct ones; then only the table holds them.
  await run('node', [npmTool('binaryen', 'wasm-merge'), second, MAIN, '-o', second]);
  const features = sections.find(({ title }) => title === 'target_features');
  const merged = sectionsOf(readFileSync(second)).filter(({ id, title }) => id !== SECTION.export && title !== 'target_features');
  writeFileSync(second, moduleOf([...merged, features]));
  await run('node', [npmTool('binaryen', 'wasm-opt'), ...options, second, '-o', second]);
  writeFileSync(main, mainModule(sections, content, moved, table.min, exportsFor(readFileSync(second))));
}
