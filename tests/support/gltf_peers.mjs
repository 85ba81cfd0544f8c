// Holds glTF files beside Khronos's validator and three.js's GLTFLoader: node gltf_peers.mjs MODULES FILE TRIANGLES LINES POINTS...
// Prints what is wrong; exits 1 when anything is.
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

for (let i = 0; i < cases.length; i += 4) {
  const [file, triangles, lines, points] = cases.slice(i, i + 4);
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
  } catch (error) {
    complain(file, `three.js refuses it: ${error}`);
  }
}
console.log(`${cases.length / 4} files, ${wrong} complaints`);
process.exit(wrong ? 1 : 0);
