// SPDX-License-Identifier: Apache-2.0
// The playground's parts that need no browser: rays against every triangle, penumbrae against circles' segments, addresses.
//
// usage: node units.mjs ROOT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';

const root = resolve(process.argv[2]);
const { build } = createRequire(join(root, 'build/playground_npm/package.json'))('esbuild');

async function load(name) {
  const made = await build({ entryPoints: [join(root, `web/playground/src/${name}.ts`)], bundle: true, format: 'esm', write: false });
  return import(`data:text/javascript;base64,${Buffer.from(made.outputFiles[0].contents).toString('base64')}`);
}

const { Tracer } = await load('tracer');
const { PixelTruth } = await load('pixel_truth');
const { bandsOf } = await load('truth_messages');
const { kDefaults, partsOf, readAddress, writeAddress } = await load('address');
const { clipFromWorld, inverseOfMatrix, orbit, sunDirection, sunPlace } = await load('vectors');

/** Numbers in [0, 1) that are the same each time. */
function randoms(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** A world of meshes { triangles: [[x, y, z] x 3], places: rows, material }, each with vertices of its own. */
function worldOf(meshes, materials = [], images = { side: 1, bytes: new Uint8Array(4) }) {
  const vertices = meshes.flatMap((mesh) => mesh.triangles.flat());
  const bytes = new Uint8Array(vertices.length * 24);
  const view = new DataView(bytes.buffer);
  vertices.forEach(([x, y, z, u = 0, v = 0], i) => {
    [x, y, z].forEach((one, k) => view.setFloat32(24 * i + 4 * k, one, true));
    view.setUint32(24 * i + 16, 0xffffffff, true);
    [u, v].forEach((one, k) => view.setUint16(24 * i + 20 + 2 * k, one === 1 ? 0x3c00 : 0, true)); // halves of 0 and 1
  });
  let first = 0;
  let place = 0;
  const listed = meshes.map((mesh) => {
    const count = mesh.triangles.length * 3;
    const one = { first_vertex: first, first_index: first, indices: count, first_place: place, places: mesh.places.length, material: mesh.material ?? -1, casts: mesh.casts ?? true };
    first += count;
    place += mesh.places.length;
    return one;
  });
  return {
    meshes: listed, materials, vertices: first, indices: first, places: place, images: 1, image_side: images.side, vertexBytes: bytes,
    indexValues: Uint32Array.from(meshes.flatMap((mesh) => mesh.triangles.flatMap((_, i) => [3 * i, 3 * i + 1, 3 * i + 2]))),
    placeValues: Float32Array.from(meshes.flatMap((mesh) => mesh.places.flat())), imageBytes: images.bytes,
  };
}

const kHere = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Where a ray meets a triangle, worked out by the plane and three edges. */
function met([a, b, c], o, d) {
  const minus = (p, q) => p.map((one, k) => one - q[k]);
  const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const n = cross(minus(b, a), minus(c, a));
  const t = dot(n, minus(a, o)) / dot(n, d);
  const p = o.map((one, k) => one + t * d[k]);
  const inside = [[a, b], [b, c], [c, a]].every(([from, to]) => dot(n, cross(minus(to, from), minus(p, from))) >= 0);
  return t > 0 && inside ? t : Infinity;
}

test('rays meet what every triangle in turn says', () => {
  const random = randoms(7);
  const point = (size) => [0, 1, 2].map(() => (random() - 0.5) * size);
  const triangles = Array.from({ length: 300 }, () => {
    const middle = point(8);
    return [0, 1, 2].map(() => middle.map((one) => one + (random() - 0.5)));
  });
  const places = [kHere, [0, 0, 2, 3, 0, 1, 0, -2, -2, 0, 0, 1]]; // as it is; turned, twice as large and elsewhere
  const tracer = new Tracer(worldOf([{ triangles, places }]));
  const there = places.flatMap((m) => triangles.map((one) => one.map((p) => [0, 4, 8].map((r) => m[r] * Math.fround(p[0]) + m[r + 1] * Math.fround(p[1]) + m[r + 2] * Math.fround(p[2]) + m[r + 3]))));
  let hits = 0;
  for (let i = 0; i < 2000; ++i) {
    const o = point(16);
    const d = point(2);
    const nearest = Math.min(...there.map((one) => met(one, o, d)));
    assert.equal(tracer.blocked(...o, ...d, Infinity), nearest < Infinity, `ray ${i}`);
    assert.equal(tracer.blocked(...o, ...d, 0.999 * nearest), false, `ray ${i}, before what it meets`);
    hits += nearest < Infinity ? 1 : 0;
  }
  assert.ok(hits > 200 && hits < 1900, `${hits} hits: rays and triangles must both meet and miss`);
});

test('a camera sees fronts, and normals face it', () => {
  const triangle = [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]; // its front is to +z
  const tracer = new Tracer(worldOf([{ triangles: [triangle], places: [kHere] }]));
  assert.ok(tracer.meets(0, 0, 2, 0, 0, -1));
  assert.equal(tracer.t, 2);
  assert.deepEqual([...tracer.normal].map(Math.round), [0, 0, 1]);
  assert.equal(tracer.meets(0, 0, -2, 0, 0, 1), false);
  assert.ok(tracer.blocked(0, 0, -2, 0, 0, 1, Infinity), 'it casts from both sides');
});

test('holes of a material let rays through', () => {
  const bytes = Uint8Array.from({ length: 16 * 16 * 4 }, (_, i) => (i % 4 === 3 && (i >> 2) % 16 < 8 ? 0 : 255)); // the left half is a hole
  const material = { name: '', colour: [1, 1, 1, 1], image: 0, cutoff: 0.5, double_sided: true };
  const quad = [[[0, 0, 0, 0, 0], [1, 0, 0, 1, 0], [1, 1, 0, 1, 1]], [[0, 0, 0, 0, 0], [1, 1, 0, 1, 1], [0, 1, 0, 0, 1]]];
  const tracer = new Tracer(worldOf([{ triangles: quad, places: [kHere], material: 0 }], [material], { side: 16, bytes }));
  assert.equal(tracer.blocked(0.25, 0.5, 1, 0, 0, -1, Infinity), false);
  assert.equal(tracer.blocked(0.75, 0.5, 1, 0, 0, -1, Infinity), true);
});

test('a half plane’s penumbra is a circle’s segment', () => {
  const quad = (x0, x1, y) => [[[x0, y, 60], [x1, y, 60], [x1, y, -60]], [[x0, y, 60], [x1, y, -60], [x0, y, -60]]];
  const height = 10;
  const tracer = new Tracer(worldOf([{ triangles: [...quad(-60, 60, 0), ...quad(-60, 0, height)], places: [kHere] }]));
  const view = { width: 200, height: 4, camera: { eye: [0, 5, 0.001], target: [0, 0, 0], fov: 10 }, sun: [0, -1, 0], light: 5 };
  const truth = new PixelTruth(tracer, view);
  const radius = height * Math.tan((2.5 * Math.PI) / 180);
  const rays = 256;
  let between = 0;
  for (let x = 0; x < view.width; ++x) {
    const pixel = 2 * view.width + x;
    assert.ok(truth.surface(pixel));
    for (let i = 0; i < rays; ++i) {
      truth.addRay(pixel, i);
    }
    const tall = Math.tan((5 * Math.PI) / 180);
    const across = ((2 * (x + 0.5)) / view.width - 1) * tall * (view.width / view.height) * 5;
    const c = Math.max(-1, Math.min(1, across / radius)); // from the edge, in radii of what the sun spreads to
    const lit = 1 - (Math.acos(c) - c * Math.sqrt(1 - c * c)) / Math.PI;
    assert.ok(Math.abs(truth.sums[pixel] / rays - lit) < 0.03, `column ${x}: ${truth.sums[pixel] / rays}, not ${lit}`);
    between += lit > 0.05 && lit < 0.95 ? 1 : 0;
  }
  assert.ok(between >= 4, `${between} columns are in the penumbra`);
});

test('workers share all rows', () => {
  for (const workers of [1, 3, 8]) {
    const bands = Array.from({ length: workers }, (_, i) => bandsOf(90, i, workers)).flat().sort((a, b) => a - b);
    assert.deepEqual(bands, Array.from({ length: 23 }, (_, i) => 4 * i));
  }
});

const kWorlds = ['sundial', 'rts'];

test('an address gives back its state', () => {
  const state = {
    ...kDefaults, world: 'rts', technique: 'pcf+cascades+lispsm', light: 2.5, map: 1024, sun: [120.5, 33], view: 'difference', split: 0.25,
    camera: { eye: [1.25, 2, -3.5], target: [0, 1, 0], fov: 40 }, options: { 'pcf.kernel': '5x5', 'mask-size': 'half' },
  };
  assert.deepEqual(readAddress(writeAddress(state), kWorlds), state);
  const named = { ...kDefaults, camera: 'camp', fov: 11 };
  assert.deepEqual(readAddress(writeAddress(named), kWorlds), named);
});

test('nonsense in an address is left out', () => {
  const random = randoms(3);
  const words = ['world', 'technique', 'light', 'map', 'sun', 'camera', 'view', 'split', '=', '&', '%', '%zz', 'NaN', '1e999', '-1', '<b>', ',', 'rts', '#', '__proto__', 'pcf.kernel'];
  for (let i = 0; i < 3000; ++i) {
    const text = Array.from({ length: Math.floor(random() * 20) }, () => words[Math.floor(random() * words.length)]).join('');
    const state = readAddress(`#${text}`, kWorlds);
    assert.ok(kWorlds.includes(state.world) && state.light >= 0 && state.light <= 10 && state.split >= 0 && state.split <= 1);
    assert.deepEqual(readAddress(writeAddress(state), kWorlds), state, text);
  }
  assert.deepEqual(readAddress('#light=&camera=1,2,3&sun=x,y&map=7&camera=0,5,0,0,0,0', kWorlds), kDefaults);
});

test('a technique comes apart', () => {
  const choices = [{ choice: 'partition', name: 'auto' }, { choice: 'filter', name: 'auto' }, { choice: 'filter', name: 'pcf' }, { choice: 'light', name: 'spot' }, { choice: 'fit', name: 'tsm' }];
  assert.deepEqual(partsOf('pcf+tsm+spot+map-size=64+what', choices), { filter: 'pcf', fit: 'tsm', 'map-size': '64' });
  assert.deepEqual(partsOf('auto', choices), { filter: 'auto' });
});

test('cameras and suns', () => {
  const camera = { eye: [3, 4, 5], target: [0, 1, 0], fov: 50 };
  const m = clipFromWorld(camera, 16 / 9, 0.1);
  const inverse = inverseOfMatrix(m);
  for (let i = 0; i < 16; ++i) {
    const sum = [0, 1, 2, 3].reduce((all, k) => all + m[4 * k + (i & 3)] * inverse[(i & ~3) + k], 0);
    assert.ok(Math.abs(sum - (i % 5 === 0 ? 1 : 0)) < 1e-9);
  }
  const place = sunPlace(sunDirection(250, 40));
  assert.ok(Math.abs(place[0] - 250) < 1e-9 && Math.abs(place[1] - 40) < 1e-9);
  const turned = orbit(orbit(camera, 30, 0), -30, 0);
  turned.eye.forEach((one, k) => assert.ok(Math.abs(one - camera.eye[k]) < 1e-9));
});
