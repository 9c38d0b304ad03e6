// WebAssembly modules as lists of sections, as far as splitting one needs to look into them.

/** Kinds of what is imported and exported. */
export const KIND = { function: 0, table: 1, memory: 2, global: 3, tag: 4 };
export const SECTION = {
  custom: 0, type: 1, import: 2, function: 3, table: 4, memory: 5, global: 6, export: 7, element: 9, code: 10, tag: 13,
};
const HEADER = 8;

/** An unsigned number in LEB128. */
export function unsigned(value) {
  const bytes = [];
  do {
    bytes.push((value & 127) | (value > 127 ? 128 : 0));
    value = Math.floor(value / 128);
  } while (value > 0);
  return bytes;
}

/** A signed number of 32 bits in LEB128. */
export function signed(value) {
  const bytes = [];
  for (;;) {
    const byte = value & 127;
    value >>= 7;
    if ((value === 0 && !(byte & 64)) || (value === -1 && byte & 64)) return [...bytes, byte];
    bytes.push(byte | 128);
  }
}

export const name = (text) => [...unsigned(Buffer.byteLength(text)), ...Buffer.from(text)];
export const vector = (items) => [unsigned(items.length), ...items].flatMap((item) => [...item]);

class Reader {
  at = 0;

  constructor(bytes) {
    this.bytes = bytes;
  }

  byte() {
    return this.bytes[this.at++];
  }

  unsigned() {
    for (let value = 0, scale = 1; ; scale *= 128) {
      const byte = this.byte();
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
  }

  take(count) {
    return this.bytes.subarray(this.at, (this.at += count));
  }

  text() {
    return Buffer.from(this.take(this.unsigned())).toString();
  }

  vector(item) {
    return Array.from({ length: this.unsigned() }, item);
  }

  limits() {
    const flags = this.byte();
    return { flags, min: this.unsigned(), max: flags & 1 ? this.unsigned() : undefined };
  }

  table() {
    return { element: this.byte(), ...this.limits() };
  }

  global() {
    return { type: this.byte(), isMutable: this.byte() };
  }

  tag() {
    this.byte();
    return { type: this.unsigned() };
  }

  /** Passes over an initial value. */
  constant() {
    const skip = { 0x41: () => this.unsigned(), 0x42: () => this.unsigned(), 0x43: () => this.take(4), 0x44: () => this.take(8) };
    Object.assign(skip, { 0x23: () => this.unsigned(), 0xd0: () => this.byte(), 0xd2: () => this.unsigned() });
    for (let code = this.byte(); code !== 0x0b; code = this.byte()) {
      if (!skip[code]) throw new Error(`an initial value has the instruction ${code}, which is not expected`);
      skip[code]();
    }
  }

  import() {
    const from = { module: this.text(), name: this.text(), kind: this.byte() };
    const of = [() => ({ type: this.unsigned() }), () => this.table(), () => this.limits(), () => this.global(), () => this.tag()];
    return { ...from, ...of[from.kind]() };
  }
}

/** The sections of a module, in their order: `{ id, bytes, title }`, the title that of a custom one. */
export function sectionsOf(module) {
  const reader = new Reader(module.subarray(HEADER));
  const sections = [];
  while (reader.at < reader.bytes.length) {
    const id = reader.byte();
    const bytes = reader.take(reader.unsigned());
    sections.push({ id, bytes, title: id === SECTION.custom ? new Reader(bytes).text() : undefined });
  }
  return sections;
}

/** A module made of sections. */
export function moduleOf(sections) {
  const parts = sections.map(({ id, bytes }) => Buffer.from([id, ...unsigned(bytes.length)].concat([...bytes])));
  return Buffer.concat([Buffer.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]), ...parts]);
}

/** Names of functions, by index. */
function functionNames(sections) {
  const section = sections.find(({ title }) => title === 'name');
  if (!section) return new Map();
  const reader = new Reader(section.bytes);
  reader.text();
  while (reader.at < reader.bytes.length) {
    const kind = reader.byte();
    const part = new Reader(reader.take(reader.unsigned()));
    if (kind === 1) return new Map(part.vector(() => [part.unsigned(), part.text()]));
  }
  return new Map();
}

/** What a module holds, as far as it is needed here; lists count imported items first, as indices in code do. */
export function contentOf(sections) {
  const items = (id, item) => {
    const section = sections.find((s) => s.id === id);
    if (!section) return [];
    const reader = new Reader(section.bytes);
    return reader.vector(() => item(reader));
  };
  const imports = items(SECTION.import, (r) => r.import());
  const all = (kind, defined) => [...imports.filter((i) => i.kind === kind), ...defined];
  const global = (r) => {
    const global = r.global();
    r.constant();
    return global;
  };
  const parameters = (r) => {
    r.byte();
    const count = r.unsigned();
    r.take(count);
    r.take(r.unsigned());
    return count;
  };
  return {
    imports,
    parameters: items(SECTION.type, parameters),
    functions: all(KIND.function, items(SECTION.function, (r) => ({ type: r.unsigned() }))),
    tables: all(KIND.table, items(SECTION.table, (r) => r.table())),
    memories: all(KIND.memory, items(SECTION.memory, (r) => r.limits())),
    globals: all(KIND.global, items(SECTION.global, global)),
    tags: all(KIND.tag, items(SECTION.tag, (r) => r.tag())),
    exports: items(SECTION.export, (r) => {
      const text = r.text();
      return [...name(text), r.byte(), ...unsigned(r.unsigned())];
    }),
    bodies: items(SECTION.code, (r) => r.take(r.unsigned())),
    names: functionNames(sections),
  };
}
