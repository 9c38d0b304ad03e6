import { readFile, writeFile } from 'node:fs/promises';
import { init } from 'fast-winding';

const [model = '../models/house.obj', out = 'house.gcode'] = process.argv.slice(2);
const fw = await init();
const shape = await fw.open(await readFile(model));
const layers = await shape.slice({ layerHeight: 0.2, simplify: 0.01 });
const paths = await fw.toolpaths(layers, { perimeters: 2, infill: 'gyroid', density: 0.15 });
const { bytes, estimate, warnings } = await fw.gcode(paths, { bedWidth: 220, bedDepth: 220, nozzleDiameter: 0.4, placement: 'centered' });
await writeFile(out, bytes);

for (const { message } of [...shape.warnings, ...paths.warnings, ...warnings]) console.log(`warning: ${message}`);
console.log(`${layers.length} layers, ${Math.round(estimate.seconds / 60)} minutes, ${estimate.filamentMass.toFixed(1)} g: ${out}`);
fw.dispose();
