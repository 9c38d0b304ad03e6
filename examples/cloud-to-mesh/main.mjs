import { readFile, writeFile } from 'node:fs/promises';
import { init } from 'fast-winding';

const [scan, out = 'mesh.stl'] = process.argv.slice(2);
const fw = await init();
const cloud = scan ? await fw.Cloud.parse(await readFile(scan)) : await fw.Cloud.from({ points: bumpyBall(4000) });
if (!cloud.hasNormals) await cloud.orient();
const { positions, indices, origin } = await cloud.surface();
const mesh = await fw.Soup.from({ positions: Float64Array.from(positions, (x, i) => x + origin[i % 3]), indices });
await writeFile(out, await mesh.export('stl'));

const { boundaryEdges } = await mesh.prepare();
console.log(`${cloud.count} points, ${mesh.count} triangles, ${boundaryEdges} open edges: ${out}`);
fw.dispose();

/** Points spread over a ball of 30 mm. */
function bumpyBall(count) {
  const points = new Float64Array(3 * count);
  for (let i = 0; i < count; i++) {
    const z = 1 - (2 * i + 1) / count;
    const angle = 2.399963 * i;
    const ring = Math.sqrt(1 - z * z);
    const radius = 30 + 2 * Math.sin(5 * angle) * ring ** 3;
    points.set([radius * ring * Math.cos(angle), radius * ring * Math.sin(angle), radius * z], 3 * i);
  }
  return points;
}
