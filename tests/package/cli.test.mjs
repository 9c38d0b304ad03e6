// The command line as a shell has it: `fast-winding` of the installed package. What it writes is held against the package's own calls.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { setTimeout as sleep } from 'node:timers/promises';
import { install } from './install.mjs';
import { box, boxObj, sphere, torus, volume } from './shapes.mjs';

const { folder, load } = install();
const program = join(folder, 'node_modules', '.bin', 'fast-winding');
const fw = await (await load('node/sync.js')).init();

const write = (name, bytes) => writeFileSync(join(folder, name), bytes);
const read = (name) => readFileSync(join(folder, name));
const stl = (arrays) => fw.Soup.from(arrays).export('stl');
/** Half of a face is missing, so that inside and outside are doubtful; or one triangle of very many. */
const opened = box(0, 10);
const pricked = torus(60);
write('box.obj', boxObj());
write('block.stl', stl(box(0, 10)));
write('hole.stl', stl(box(4, 16)));
write('open.stl', stl({ ...opened, indices: opened.indices.slice(3) }));
write('pricked.stl', stl({ ...pricked, indices: pricked.indices.slice(3) }));
write('torus.stl', stl(torus(300)));
const ball = sphere(600, 10);
write('scan.xyz', Array.from({ length: 600 }, (_, i) => ball.points.slice(3 * i, 3 * i + 3).join(' ')).join('\n'));
write('bad.obj', 'v 0 0 0\nv 1 oops 0\nf 1 1 1\n');
const open = (name) => fw.open(read(name), { orient: 'auto' });

/** Runs the command line: its exit code and what it says. */
function cli(words, options = {}) {
  const { status, stdout, stderr } = spawnSync(program, words.split(' '), { cwd: folder, maxBuffer: 1 << 28, ...options });
  return { code: status, out: String(stdout), err: String(stderr), bytes: stdout };
}
const done = (words) => {
  const result = cli(words);
  assert.deepEqual([result.code, result.err], [0, ''], words);
  return result;
};
/** The same without a process of its own: for what is said before any work begins. */
async function said(words) {
  const { main } = await load('cli/run.js');
  const told = { out: '', err: '' };
  const real = [process.stdout.write, process.stderr.write];
  const at = process.cwd();
  process.chdir(folder);
  process.stdout.write = (text, done) => ((told.out += text), done?.(), true);
  process.stderr.write = (text) => ((told.err += text), true);
  try {
    return { code: await main(words.split(' ')), ...told };
  } finally {
    [process.stdout.write, process.stderr.write] = real;
    process.chdir(at);
  }
}
/** Files that are there now; none of them half written. */
const files = (under = '.') => readdirSync(join(folder, under)).filter((name) => name !== 'node_modules').sort();

test('help lists every command, and each command’s help its options and examples', async () => {
  const { out } = done('--help');
  const names = ['info', 'check', 'repair', 'orient', 'surface', 'slice', 'voxelize', 'boolean', 'offset', 'hollow', 'texture', 'distance'];
  assert.deepEqual([...out.split('Commands\n')[1].split('\n\n')[0].matchAll(/^ {2}(\w+)/gm)].map(([, name]) => name), names);
  for (const name of names) {
    const { code, out: own } = await said(`${name} --help`);
    assert.equal(code, 0);
    assert.match(own, new RegExp(`^fast-winding ${name} .*FILE`));
    assert.match(own, new RegExp(`\\n  fast-winding ${name} `));
    assert.match(own, /--json/);
    assert.ok(own.split('\n').every((line) => line.length <= 100));
  }
  const { out: slicing } = await said('slice --help');
  assert.match(slicing, /--layer-height MM/);
  assert.equal((await said('help slice')).out, slicing);
  assert.equal(done('--version').out, '0.1.0\n');
});

test('wrong use is said, and nothing is done', async () => {
  const before = files();
  const wrong = {
    '--json': /a command comes first/,
    'chekc box.obj': /"chekc" is no command: info, check/,
    check: /no file is named/,
    'check --bde 1,2,3 box.obj': /Unknown option '--bde'/,
    'check --bed 1,2 box.obj': /--bed is "1,2": 3 numbers/,
    'surface --resolution many box.obj': /--resolution is "many": a number/,
    'surface --resolution 1.5 box.obj': /--resolution is 1.5: a whole number/,
    'surface --resolution 8 --spacing 1 box.obj': /one of --resolution and --spacing/,
    'orient --method magic box.obj': /--method is "magic": one of parity/,
    'offset box.obj -o out.stl': /--distance is missing/,
    'boolean unite box.obj block.stl': /OPERATION is "unite": one of union/,
    'boolean union box.obj': /2 files at least/,
    'repair box.obj -o out.docx': /its ending is none of stl, obj/,
    'repair box.obj -o out.stl --format ply': /its ending is stl, and ply/,
    'slice --separate box.obj -o out --format dxf': /these options write svg/,
    'info box.obj -o out.json': /info writes no file/,
    'repair box.obj --force': /about what -o writes/,
    'repair box.obj block.stl -o -': /one result only/,
    'repair box.obj block.stl -o box.obj': /is a file: many results need a folder/,
    'check box.obj --json -o -': /both --json and the result/,
    'check - -': /only once/,
    'texture box.obj -o - --format obj': /beside obj there is mtl and png/,
    'texture box.obj --image wood.gif -o out.glb': /a \.png or \.jpg file is needed/,
    'texture box.obj --offset 1 --one-piece': /one of --offset and --one-piece/,
    'check box.obj --jobs 0': /--jobs is 0/,
    'repair box.obj ./box.obj -o out': /would both be written to out/,
  };
  for (const [words, message] of Object.entries(wrong)) {
    const { code, out, err } = await said(words);
    assert.deepEqual([code, out], [2, ''], words);
    assert.match(err, message);
    assert.match(err, /See fast-winding .*--help\n$/);
  }
  assert.deepEqual([files(), cli('check').code], [before, 2]);
});

test('a check says whether it prints, by its exit code too', () => {
  const clean = done('check box.obj');
  assert.match(clean.out, /^box\.obj: clean: prints as it is\n/);
  assert.match(clean.out, /\n {2}solid +1,000 mm³\n/);
  const codes = (words) => ['box.obj', 'pricked.stl', 'open.stl'].map((name) => cli(`${words} ${name}`).code);
  assert.deepEqual([codes('check'), codes('check --strict')], [[0, 0, 3], [0, 3, 3]]);
  const large = cli('check --bed 5,5,5 box.obj');
  assert.deepEqual([large.code, large.err], [3, '']);
  assert.match(large.out, /does not fit/);
  assert.deepEqual([cli('check --bed 5,5,5 box.obj --quiet').out, cli('check box.obj --unit inch --bed 200,200,200').code], ['', 3]);
  const report = JSON.parse(done('check --json pricked.stl --limit 2').out);
  const { verdict, boundary, edges } = open('pricked.stl').check({ limit: 2 });
  assert.deepEqual([report.prints, report.verdict, report.edges, report.boundary.loops.list[0].vertices], [true, verdict, edges, [...boundary.loops.list[0].vertices]]);
  done('check box.obj -o report.json');
  assert.equal(JSON.parse(read('report.json')).triangles, 12);
});

test('one bad file of many does not stop the others, and is named with the reason', () => {
  const { code, out, err } = cli('check --json box.obj bad.obj missing.stl scan.xyz open.stl node_modules --jobs 3');
  assert.equal(code, 1);
  const reports = out.trimEnd().split('\n').map((line) => JSON.parse(line));
  assert.deepEqual(reports.map(({ file, ok }) => [file, ok]), [
    ['box.obj', true], ['bad.obj', false], ['missing.stl', false], ['scan.xyz', false], ['open.stl', true], ['node_modules', false],
  ]);
  const errors = reports.filter(({ ok }) => !ok).map(({ error }) => error);
  assert.deepEqual(errors.map((error) => error.code), ['ParseError', 'ENOENT', 'InvalidArgument', 'EISDIR']);
  assert.equal(errors[0].details.line, 2);
  const lines = err.trimEnd().split('\n');
  assert.equal(lines.length, 4);
  assert.match(lines[0], /^fast-winding: bad\.obj: ParseError: .*line 2.*'oops'/);
  assert.match(lines[1], /^fast-winding: missing\.stl: ENOENT: .*no such file/);
  const text = cli('info box.obj bad.obj open.stl');
  assert.deepEqual([text.code, [...text.out.matchAll(/^(\S.*?):/gm)].map(([, name]) => name)], [1, ['box.obj', 'open.stl']]);
  assert.match(cli('boolean union box.obj bad.obj').err, /^fast-winding: box\.obj, bad\.obj: ParseError: bad\.obj: /);
});

test('what is written is what the package gives', () => {
  const soup = open('block.stl');
  const written = (words, name) => {
    done(`${words} -o ${name}`);
    return new Uint8Array(read(name));
  };
  const layers = soup.slice({ layerHeight: 0.5 });
  for (const format of ['svg', 'dxf', 'json']) {
    assert.deepEqual(written('slice --layer-height 0.5 block.stl', `layers.${format}`), fw.exportLayers(layers, format));
  }
  assert.deepEqual(written('slice --layer-height 0.5 block.stl', 'layers.3mf'), fw.exportLayers(layers, '3mf', soup.geometry()));
  write('printer.json', JSON.stringify({ bedWidth: 150, bedDepth: 150, settings: { density: 0.4, perimeters: 3 } }));
  const lines = fw.toolpaths(layers, { density: 0.1, perimeters: 3 });
  assert.deepEqual(
    written('slice --layer-height 0.5 --density 0.1 --profile printer.json block.stl', 'print.gcode'),
    fw.gcode(lines, { bedWidth: 150, bedDepth: 150 }).bytes,
  );
  const voxels = soup.voxelBricks({ resolution: 20 });
  assert.deepEqual(written('voxelize --resolution 20 block.stl', 'voxels.vox'), fw.exportVoxels(voxels, 'vox'));
  assert.deepEqual(written('voxelize --resolution 20 --raw block.stl', 'voxels.nrrd'), fw.exportVoxels(voxels, 'nrrd', { raw: true }));
  assert.deepEqual(written('repair open.stl', 'fixed.ply'), open('open.stl').repair().soup.export('ply'));
  const { soup: rest } = soup.boolean('difference', open('hole.stl'));
  assert.deepEqual(written('boolean difference block.stl hole.stl', 'rest.off'), rest.export('off'));
  const cloud = fw.open(read('scan.xyz'));
  cloud.orient();
  assert.deepEqual(written('orient scan.xyz', 'oriented.ply'), cloud.export('ply'));
  const turned = open('open.stl');
  turned.orient();
  assert.deepEqual(written('orient open.stl', 'turned.obj'), turned.export('obj'));
});

test('meshes made anew lie where the shape is', () => {
  const far = box(1e5, 1e5 + 10);
  write('far.ply', fw.Soup.from(far).export('ply'));
  const meshes = {
    'surface --resolution 32': (soup) => soup.surface({ resolution: 32 }),
    'offset --distance -1 --resolution 32': (soup) => soup.offset({ distance: -1, resolution: 32 }),
    'hollow --thickness 2 --resolution 32 --drain 100005,100005,99999,0,0,1,1': (soup) =>
      soup.hollow({ thickness: 2, resolution: 32, drains: [{ at: [100005, 100005, 99999], direction: [0, 0, 1], radius: 1 }] }),
  };
  for (const [words, make] of Object.entries(meshes)) {
    const { out } = cli(`${words} far.ply -o made.obj --force --json`);
    const { triangles, written } = JSON.parse(out);
    const mesh = make(fw.open(read('far.ply')));
    const made = fw.open(read('made.obj'));
    assert.deepEqual([triangles, made.count, written, made.prepare().boundaryEdges], [mesh.indices.length / 3, mesh.indices.length / 3, ['made.obj'], 0]);
    assert.ok(Math.abs(made.check({ resolution: 0, selfIntersections: false }).volume - volume(mesh)) < 1e-2, words);
    assert.ok(made.bounds.min.every((x) => Math.abs(x - 1e5) < 1.5));
  }
});

/** What a GLB file holds: its description, and the part of its binary that is a view of it. */
function glb(bytes) {
  const length = bytes.readUInt32LE(12);
  assert.deepEqual([bytes.toString('latin1', 0, 4), bytes.readUInt32LE(8), length % 4], ['glTF', bytes.length, 0]);
  const description = JSON.parse(bytes.toString('utf8', 20, 20 + length));
  const view = (k) => {
    const { byteOffset, byteLength } = description.bufferViews[k];
    return Uint8Array.from(bytes.subarray(28 + length + byteOffset)).slice(0, byteLength);
  };
  return { description, view };
}

test('textures are written with their picture', () => {
  const options = { offset: 1, resolution: 24, steps: 40 };
  const words = 'texture --offset 1 --resolution 24 --steps 40 block.stl -o textured/block';
  const texture = JSON.parse(done(`${words}.obj --json`).out);
  const made = open('block.stl').texture(options);
  assert.deepEqual(texture.mapping, made.report.mapping);
  const { obj, mtl } = made.export('obj', { name: 'block' });
  assert.deepEqual([new Uint8Array(read('textured/block.obj')), new Uint8Array(read('textured/block.mtl'))], [obj, mtl]);
  assert.deepEqual(texture.written, ['mtl', 'png', 'obj'].map((ending) => `textured/block.${ending}`));
  assert.match(cli(`${words}.obj`).err, /EEXIST: textured\/block\.obj exists/);
  assert.equal(spawnSync('rm', ['textured/block.obj'], { cwd: folder }).status, 0);
  assert.match(cli(`${words}.obj`).err, /EEXIST: textured\/block\.mtl exists/);
  done(`${words}.glb --image textured/block.png`);
  const { description, view } = glb(read('textured/block.glb'));
  assert.deepEqual([Buffer.from(view(3)).equals(read('textured/block.png')), description.images[0].mimeType], [true, 'image/png']);
  const { uvs } = made.geometry();
  assert.deepEqual(new Float32Array(view(2).buffer), uvs.map((value, k) => (k % 2 ? 1 - value : value)));
  const { min, max, count } = description.accessors[0];
  assert.deepEqual([count, min, max], [36, [-5, -5, -5], [5, 5, 5]]);
  assert.deepEqual(description.nodes[0].translation, [0.005, 0.005, -0.005], 'y is up');
});

test('distances, at points and over a lattice', () => {
  const points = new Float64Array([5, 5, 5, 5, 5, 12, -3, 5, 5]);
  write('places.xyz', '5 5 5\n5 5 12\n-3 5 5\n');
  done('distance --at places.xyz block.stl -o far.csv');
  const rows = String(read('far.csv')).trimEnd().split('\n').map((row) => row.split(','));
  assert.deepEqual(rows[0], ['x', 'y', 'z', 'distance']);
  assert.deepEqual(rows.slice(1).flatMap((row) => row.slice(0, 3).map(Number)), [...points]);
  assert.deepEqual(rows.slice(1).map((row) => Number(row[3])), [-5, 2, 3]);
  assert.deepEqual(JSON.parse(done('distance --json --at places.xyz block.stl').out).distances, [-5, 2, 3]);
  done('distance --resolution 10 --padding 2 block.stl -o far.nrrd');
  const bytes = read('far.nrrd');
  const end = bytes.indexOf('\n\n') + 2;
  const header = bytes.subarray(0, end).toString();
  const lattice = open('block.stl').signedDistance({ resolution: 10, padding: 2 });
  assert.match(header, /^NRRD0004\ntype: float\ndimension: 3\n/);
  assert.ok(header.includes(`sizes: ${lattice.counts.join(' ')}\n`) && header.includes(`space origin: (${lattice.origin.join(',')})\n`));
  assert.deepEqual(new Float32Array(Uint8Array.from(bytes.subarray(end)).buffer), lattice.values);
});

test('layers one by one are a file each', () => {
  const { out } = done('slice --separate --layer-height 2 block.stl box.obj -o layers');
  const names = ['block', 'box'].flatMap((stem) => [1, 2, 3, 4, 5].map((layer) => `${stem}-000${layer}.svg`));
  assert.deepEqual(files('layers'), names);
  assert.match(out, /block\.stl: 5 layers, 5 contours\n/);
  assert.deepEqual(new Uint8Array(read('layers/block-0003.svg')), fw.exportLayer(open('block.stl').slice({ layerHeight: 2 })[2], 'svg'));
  assert.equal(cli('slice --separate --layer-height 2 block.stl -o layers').code, 1, 'they are there');
});

test('standard input and output take the place of files', () => {
  const input = read('open.stl');
  const piped = cli('repair - -o - --format ply', { input });
  assert.deepEqual([piped.code, new Uint8Array(piped.bytes)], [0, open('open.stl').repair().soup.export('ply')]);
  assert.match(piped.err, /^-: repaired: 12 triangles, closed\n/, 'the report is elsewhere');
  assert.deepEqual([cli('repair - -o - -q', { input }).err, cli('check -', { input }).code], ['', 3]);
  assert.match(cli('check -', { input: '' }).err, /^fast-winding: -: EmptyInput: /);
});

test('files are not overwritten, unless forced, and leave nothing half written', () => {
  mkdirSync(join(folder, 'kept'));
  write('kept/fixed.stl', 'precious');
  const refused = cli('repair box.obj -o kept/fixed.stl');
  assert.equal(refused.code, 1);
  assert.match(refused.err, /^fast-winding: box\.obj: EEXIST: kept\/fixed\.stl exists: --force overwrites it\n$/);
  assert.equal(String(read('kept/fixed.stl')), 'precious');
  done('repair box.obj -o kept/fixed.stl --force');
  assert.equal(fw.open(read('kept/fixed.stl')).count, 12);
  const failed = cli('repair box.obj -o box.obj/below/fixed.stl');
  assert.deepEqual([failed.code, /cannot be written/.test(failed.err)], [1, true]);
  done('repair box.obj -o made/on/the/way/fixed.stl');
  assert.deepEqual([files('kept'), files('made/on/the/way')], [['fixed.stl'], ['fixed.stl']]);
});

test('many files go to a folder, under their names and in their format, by as many engines as one likes', () => {
  const names = Array.from({ length: 9 }, (_, i) => `many-${i}.${i % 2 ? 'obj' : 'stl'}`);
  names.forEach((name, i) => write(name, i % 2 ? boxObj() : stl(box(0, 10 + i))));
  for (const jobs of [1, 4]) {
    const { out } = done(`repair --json --jobs ${jobs} ${names.join(' ')} -o out-${jobs}/`);
    const reports = out.trimEnd().split('\n').map((line) => JSON.parse(line));
    assert.deepEqual(reports.map(({ file, written }) => [file, ...written]), names.map((name) => [name, `out-${jobs}/${name}`]));
  }
  for (const name of names) assert.deepEqual(read(`out-1/${name}`), read(`out-4/${name}`));
  done(`repair many-0.stl many-1.obj -o as3mf --format 3mf`);
  assert.deepEqual(files('as3mf'), ['many-0.3mf', 'many-1.3mf']);
});

test('the same bits come of any number of threads', () => {
  const made = [0, 1, 2].map((threads) => {
    done(`surface --resolution 40 --threads ${threads} torus.stl -o torus-${threads}.stl`);
    return read(`torus-${threads}.stl`);
  });
  assert.deepEqual(made[0], made[1]);
  assert.deepEqual(made[1], made[2]);
});

for (const [signal, code] of [['SIGINT', 130], ['SIGTERM', 143]]) {
  for (const threads of [0, 2]) {
    test(`${signal} stops the work on ${threads} threads and leaves no file`, async () => {
      const at = mkdtempSync(join(folder, 'stopped-'));
      const words = ['voxelize', '--resolution', '1500', '--threads', String(threads), 'torus.stl', '-o', join(at, 'big.nrrd')];
      const child = spawn(program, words, { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
      const said = { stdout: '', stderr: '' };
      for (const stream of ['stdout', 'stderr']) child[stream].on('data', (data) => (said[stream] += data));
      await sleep(1000);
      child.kill(signal);
      const ended = await new Promise((resolve) => child.on('close', (...how) => resolve(how)));
      assert.deepEqual([ended, said, readdirSync(at)], [[code, null], { stdout: '', stderr: '' }, []]);
    });
  }
}

test('a reader that goes away is no error', () => {
  const many = Array.from({ length: 30 }, () => 'box.obj').join(' ');
  const script = `'${program}' info ${many} | head -n 1; echo "\${PIPESTATUS[0]}"`;
  const { stdout, stderr } = spawnSync('bash', ['-c', script], { cwd: folder, encoding: 'utf8' });
  assert.equal(stderr, '');
  assert.match(stdout, /^box\.obj: OBJ, 12 triangles\n(0|141)\n$/);
});

test('progress is one line, on terminals alone', async () => {
  const { Progress } = await load('cli/progress.js');
  const said = [];
  const real = process.stderr.write;
  process.stderr.write = (text) => (said.push(text), true);
  try {
    const quiet = new Progress(1, false);
    quiet.tell('part.stl', 0.5, 'voxels');
    quiet.clear();
    assert.deepEqual(said, []);
    const shown = new Progress(3, true);
    shown.finish();
    shown.tell('part.stl', 0.5, 'voxels');
    shown.tell('part.stl', 0.51, 'voxels');
    shown.clear();
    shown.clear();
  } finally {
    process.stderr.write = real;
  }
  assert.deepEqual(said, ['\r1/3 ████████████░░░░░░░░░░░░  50 % part.stl: voxels\x1b[K', '\r\x1b[K']);
});
