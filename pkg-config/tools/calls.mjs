// Which functions of a WebAssembly module call which, as binaryen sees it.
import { rmSync, writeFileSync } from 'node:fs';
import { npmTool } from './npm.mjs';
import { moduleOf } from './module.mjs';
import { run } from './run.mjs';

/**
 * The calls of a module's own functions, by index: `callers`, the functions that call each of them directly, and `isOpen`, whether one
 * can be called from elsewhere, through the table or as an export.
 */
async function callsOf(sections, imported, scratch) {
  // Without names binaryen numbers the module's own functions from 0.
  writeFileSync(scratch, moduleOf(sections.filter(({ title }) => title !== 'name')));
  const graph = await run('node', [npmTool('binaryen', 'wasm-opt'), '--all-features', scratch, '--print-call-graph', '-o', scratch], { quiet: true });
  rmSync(scratch);
  const callers = new Map();
  const isOpen = new Set();
  const index = (digits) => Number(digits) + imported;
  for (const [, from, to] of graph.matchAll(/^ {2}"(\d+)" -> "(\d+)"/gm)) {
    if (!callers.has(index(to))) callers.set(index(to), new Set());
    callers.get(index(to)).add(index(from));
  }
  for (const [, own, style, colour] of graph.matchAll(/^ {2}"(\d+)" \[style="(.*?)"(?:, fillcolor="(.*?)")?\]/gm)) {
    if (style.includes('rounded') || colour === 'gray') isOpen.add(index(own));
  }
  return { callers, isOpen };
}

/** `chosen` functions of a module, and all that only these call; `scratch` is a file that may be written. */
export async function withOwnCallees(sections, chosen, { functions, bodies }, scratch) {
  const imported = functions.length - bodies.length;
  const { callers, isOpen } = await callsOf(sections, imported, scratch);
  const found = new Set(chosen);
  for (let before = -1; before !== found.size; ) {
    before = found.size;
    for (const [index, from] of callers) {
      if (!isOpen.has(index) && [...from].every((caller) => caller === index || found.has(caller))) found.add(index);
    }
  }
  return [...found].sort((a, b) => a - b);
}
