import { readFile, writeFile } from 'node:fs/promises';
import { init } from 'fast-winding';

const fw = await init();
const open = async (name) => fw.open(await readFile(new URL(`../models/${name}.obj`, import.meta.url)));
const [house, notch] = [await open('house'), await open('notch')];
const { soup: closed } = await house.repair();
const higher = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1];
const { soup, operands, warnings } = await closed.boolean('difference', notch, { transform: higher });
await writeFile('rest.3mf', await soup.export('3mf'));

const { volume, verdict } = await soup.check();
const cut = operands.filter((operand) => operand === 1).length;
for (const { message } of warnings) console.log(`warning: ${message}`);
console.log(`${volume.toFixed(1)} mm³ in ${soup.count} triangles, ${cut} of them along the wedge; ${verdict.rating}: rest.3mf`);
fw.dispose();
