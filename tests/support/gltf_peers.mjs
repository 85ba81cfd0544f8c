// Holds glTF files beside Khronos's validator and three.js's GLTFLoader: node gltf_peers.mjs MODULES CASE..., each case
// being FILE TRIANGLES LINES POINTS BITS BOUNDS. Bounds: six numbers as a JSON array, "-" for a file that holds nothing;
// bits: of positions, 0 for floats. Prints what is wrong; exits 1 when anything is.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, ...cases] = process.argv.slice(2);
const require = createRequire(join(modules, 'index.js'));
const validator = require('gltf-validator');
const url = (path) => pathToFileURL(join(modules, 'node_modules', path));
globalThis.ProgressEvent ??= class extends Event {};
globalThis.self ??= globalThis;
const { Box3 } = await import(url('three/build/three.module.js'));
const { GLTFLoader } = await import(url('three/examples/jsm/loaders/GLTFLoader.js'));

let wrong = 0;
function complain(file, text) {
  console.log(`${file}: ${text}`);
  wrong++;
}

async function validate(file, bytes) {
  const report = await validator.validateBytes(new Uint8Array(bytes), { uri: file });
  for (const message of report.issues.messages) {
    if (message.severity < 2) {
      complain(file, `the validator says ${message.code} at ${message.pointer}: ${message.message}`);
    }
  }
}

// Elements that the loader's scene draws.
function count(scene) {
  const found = { triangles: 0, lines: 0, points: 0 };
  scene.traverse((object) => {
    if (!object.geometry) return;
    const size = (object.geometry.index ?? object.geometry.attributes.position).count;
    if (object.isLineSegments) found.lines += size / 2;
    else if (object.isLine) found.lines += size - 1;
    else if (object.isPoints) found.points += size;
    else if (object.isMesh) found.triangles += size / 3;
  });
  return found;
}

// Where the loader puts the vertices, through the nodes' transforms: within half a step, and what floats round.
function measure(file, scene, expected, bits) {
  const box = new Box3().setFromObject(scene, true);
  const extent = Math.max(...[0, 1, 2].map((k) => expected[k + 3] - expected[k]));
  const error = extent * ((bits ? 0.5 / (2 ** bits - 1) : 0) + 1e-6);
  const found = [...box.min.toArray(), ...box.max.toArray()];
  if (!found.every((number, k) => Math.abs(number - expected[k]) <= error)) {
    complain(file, `three.js puts it within ${found}, expected ${expected} within ${error}`);
  }
}

const WIDTH = 6;
for (let i = 0; i < cases.length; i += WIDTH) {
  const [file, triangles, lines, points, bits, bounds] = cases.slice(i, i + WIDTH);
  const buffer = readFileSync(file);
  const bytes = buffer.buffer.slice(buffer.byteOffset, buffer.byteOffset + buffer.byteLength);
  await validate(file, bytes);
  if (triangles === '-') continue; // compressed: the loader's decoder needs a browser's workers
  try {
    const loaded = await new GLTFLoader().parseAsync(bytes, '');
    const found = count(loaded.scene);
    for (const [kind, expected] of Object.entries({ triangles, lines, points })) {
      if (found[kind] !== Number(expected)) complain(file, `three.js draws ${found[kind]} ${kind}, expected ${expected}`);
    }
    if (bounds !== '-') measure(file, loaded.scene, JSON.parse(bounds), Number(bits));
  } catch (error) {
    complain(file, `three.js refuses it: ${error}`);
  }
}
console.log(`${cases.length / WIDTH} files, ${wrong} complaints`);
process.exit(wrong ? 1 : 0);
