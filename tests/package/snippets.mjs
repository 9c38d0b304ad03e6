// The snippets of documents, as programs.

/** The fenced blocks of a page: `{ language, words, text }`, `words` being what follows the language. */
export function blocksOf(markdown) {
  return [...markdown.matchAll(/^```(\w+)[ ]*([^\n]*)\n([^]*?)^```$/gm)].map(([, language, words, text]) => ({ language, words, text }));
}

/** Imports as statements that may stand in a block. */
const withoutImports = (text) =>
  text
    .replace(/^import \* as (\w+) from ('[^']+');.*$/gm, 'const $1 = await import($2);')
    .replace(/^import (\{[^}]+\}) from ('[^']+');.*$/gm, 'const $1 = await import($2);');

/** What a line is said to print is compared with what it would. */
const withFacts = (text) =>
  text.replace(/^(\s*)console\.log\((.*)\); \/\/ → (.*)$/gm, (_, indent, found, expected) => `${indent}same([${found}], [${expected}]);`);

/**
 * The blocks one after the other as a module. Each sees the names of those before it, and may use them anew. A shape that one frees at its end
 * is there for those after it: it is freed at last. `facts` are checked in the scope of the last.
 */
export function programOf(blocks, facts = '') {
  const frees = /^shape\.free\(\);.*$/gm;
  const bodies = blocks.map(({ text }) => withFacts(withoutImports(text.replace(frees, ''))));
  const freed = blocks.some(({ text }) => text.match(frees)) ? 'shape.free();' : '';
  return [
    "import assert from 'node:assert/strict';",
    'const plain = (value) => (ArrayBuffer.isView(value) ? Array.from(value, (x) => (Object.is(x, -0) ? 0 : x)) : value);',
    'const same = (found, expected) => assert.deepEqual(found.map(plain), expected);',
    ...bodies.map((body) => `{\n${body}`),
    facts,
    freed,
    '}'.repeat(bodies.length),
  ].join('\n');
}

/** The commands of shell blocks that are the package's own, a line each. */
export const commandsOf = (blocks) =>
  blocks.filter(({ language }) => language === 'sh').flatMap(({ text }) => text.trimEnd().split('\n').filter((line) => line.includes('npx fast-winding')));
