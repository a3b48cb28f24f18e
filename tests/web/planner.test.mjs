// SPDX-License-Identifier: Apache-2.0
// The planner in node: plans are those of the library that was compiled for this machine, and wrong calls are told.
// usage: CASES=FOLDER node --test planner.test.mjs, where gnomon-shadows is installed.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {BufferKind, GnomonError, LightType, Outcome, PassKind, loadGnomon, loadShaders} from 'gnomon-shadows';
import {compare, objectsOf, plannerOf} from './scene.mjs';

const folder = process.env['CASES'];
const {scene, cases} = JSON.parse(readFileSync(`${folder}/cases.json`, 'utf8'));
const planned = JSON.parse(readFileSync(`${folder}/planned.json`, 'utf8'));
const gnomon = await loadGnomon();
// C libraries differ in the last bits of sines and powers.
const MOST_APART = 1e-9;

function frameOf(objects, lights, more = {}) {
    return {camera: scene.camera, widthPx: scene.widthPx, heightPx: scene.heightPx, objects, lights, ...more};
}
function small() {
    const objects = gnomon.makeObjects();
    objects.add({min: [-20, -0.1, -20], max: [20, 0, 20]});
    const box = objects.add({min: [-1, 0, -1], max: [1, 2, 1]});
    return {objects, box, planner: plannerOf(gnomon, {filter: 'pcf', 'map-size': 256, partition: 'cascades'}), sun: {directionWs: [0.6, -0.8, 0]}};
}

for (const {options, settings, frames} of planned) {
    test(`${frames.length} frames with ${options}`, () => {
        const objects = objectsOf(gnomon, [{min: [-30, 0, -30], max: [30, 0, 30]}]);
        const moving = objects.add({min: [-1, 0, -1], max: [1, 2, 1]});
        objects.add({min: [2, 0, -3], max: [5, 1, -1.5]});
        const planner = plannerOf(gnomon, settings);
        const all = {numbers: 0, differ: 0, farthest: 0};
        frames.forEach((frame, index) => {
            if (frame.moved) {
                objects.move(moving, frame.moved);
            }
            planner.plan(frameOf(objects, frame.lights, {camera: frame.camera, index}));
            const told = compare(JSON.parse(planner.json()), JSON.parse(frame.plan));
            assert.deepEqual(told.others, [], `frame ${index}`);
            assert.ok(told.farthest <= MOST_APART, `frame ${index}: numbers are ${told.farthest} apart`);
            all.numbers += told.numbers;
            all.differ += told.differ;
            all.farthest = Math.max(all.farthest, told.farthest);
        });
        console.log(`${options}: ${all.differ} of ${all.numbers} numbers differ, by ${all.farthest} at most`);
        planner.free();
        objects.free();
    });
}

test('cases have the plans that were drawn', () => {
    for (const one of cases) {
        const objects = objectsOf(gnomon, scene.bounds);
        const planner = plannerOf(gnomon, one.settings);
        planner.plan(frameOf(objects, one.lights));
        const told = compare(JSON.parse(planner.json()), JSON.parse(readFileSync(`${folder}/${one.name}.json`, 'utf8')));
        assert.deepEqual(told.others, [], one.name);
        assert.ok(told.farthest <= MOST_APART, `${one.name}: numbers are ${told.farthest} apart`);
    }
});

test('a plan has what its JSON says', () => {
    const {objects, planner, sun} = small();
    const plan = planner.plan(frameOf(objects, [sun], {index: 7}));
    const told = JSON.parse(planner.json());
    assert.equal(plan.frame, 7n);
    assert.equal(plan.views.length, told.views.length);
    assert.equal(plan.lights[0].outcome, Outcome.planned);
    assert.deepEqual(plan.passes.map(one => one.kind), [PassKind.maps, PassKind.mask]);
    assert.equal(plan.pages[0].filter, 'pcf');
    plan.views.forEach((view, i) => {
        const rows = [0, 1, 2, 3].map(row => [0, 1, 2, 3].map(column => view.clipFromWorld[4 * column + row]));
        assert.deepEqual(rows, told.views[i].clip_from_world_rows);
        assert.deepEqual([...plan.casters.subarray(view.firstCaster, view.firstCaster + view.casterCount)], told.views[i].casters);
    });
});

test('buffers and rows', () => {
    const {objects, planner, sun} = small();
    const plan = planner.plan(frameOf(objects, [sun]));
    assert.equal(planner.fillBuffer(BufferKind.lights).byteLength, 80);
    assert.equal(planner.fillBuffer(BufferKind.constants, 0, {subPixelBits: 8}).byteLength, 768);
    assert.equal(planner.fillBuffer(BufferKind.views).byteLength, 6 * 256);
    const rows = planner.writeCasterRows(0, Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0));
    assert.equal(rows.length, plan.views[0].casterRows * 4);
    [0, 1].forEach(row => [0, 1, 2, 3].forEach(
        column => assert.equal(rows[4 * row + column], Math.fround(plan.views[0].clipFromWorld[4 * column + row]))));
});

test('what stands still is not drawn again', () => {
    const {objects, box, planner, sun} = small();
    const redrawn = () => planner.plan(frameOf(objects, [sun])).views.filter(view => view.redraw !== 0).length;
    assert.equal(redrawn(), 4);
    assert.equal(redrawn(), 0);
    objects.touch(box);
    assert.ok(redrawn() > 0);
    objects.remove(box);
    assert.ok(redrawn() > 0);
    planner.loseAllMaps();
    assert.ok(redrawn() > 0);
});

test('wrong calls are told and change nothing', () => {
    const {objects, box, planner, sun} = small();
    const refused = (body, found) => assert.throws(body, error => {
        assert.ok(error instanceof GnomonError, String(error));
        assert.match(error.message, found);
        assert.ok(error.tried && error.found);
        return true;
    });
    refused(() => planner.set('filter', 'fog'), /"fog" is not/);
    refused(() => planner.set('fog', '1'), /no option "fog"/);
    refused(() => planner.json(), /no plan/);
    refused(() => planner.fillBuffer(9), /no plan|buffer is 9/);
    refused(() => objects.add({min: [0, 0], max: [1, 1, 1]}), /3 numbers, and 2/);
    refused(() => objects.add({low: [0, 0, 0]}), /it has no low/);
    refused(() => objects.move({index: 99, generation: 1}, {min: [0, 0, 0], max: [1, 1, 1]}), /./);
    refused(() => planner.plan(frameOf(objects, [sun], {camera: undefined})), /no camera/);
    refused(() => planner.plan(frameOf(null, [sun])), /no objects/);
    refused(() => planner.plan(frameOf(objects, [{type: -1}])), /whole number/);
    refused(() => planner.plan(frameOf(objects, [{type: 7}])), /type/);
    refused(() => planner.plan(frameOf(objects, [{...sun, directionWs: 'down'}])), /3 numbers/);
    planner.plan(frameOf(objects, [sun]));
    refused(() => planner.writeCasterRows(99, new Float32Array(12)), /view is 99/);
    refused(() => planner.writeCasterRows(0, new Float32Array(11)), /11 floats/);
    refused(() => planner.writeCasterRows(0, new Float32Array(12).fill(NaN)), /finite/);
    const odd = planner.plan(frameOf(objects, [{...sun, directionWs: [NaN, Infinity, 0]}, sun]));
    assert.equal(odd.lights[0].outcome, Outcome.degenerate);
    assert.equal(odd.lights[1].outcome, Outcome.planned);
    objects.remove(box);
    refused(() => objects.remove(box), /./);
    planner.free();
    refused(() => planner.set('filter', 'pcf'), /freed/);
    objects.free();
    refused(() => objects.add({min: [0, 0, 0], max: [1, 1, 1]}), /freed/);
});

test('memory grows and is given back', () => {
    const many = gnomon.makeObjects();
    for (let i = 0; i < 20000; ++i) {
        many.add({min: [i, 0, 0], max: [i + 1, 1, 1]});
    }
    const planner = plannerOf(gnomon, {filter: 'pcf', 'map-size': 64, partition: 'single'});
    const plan = planner.plan(frameOf(many, [{directionWs: [0, -1, 0]}]));
    assert.equal(plan.lights.length, 1);
    many.free();
    planner.free();
});

test('options and refusals of combinations', () => {
    const options = gnomon.options();
    assert.ok(options.length > 50);
    assert.ok(options.some(one => one.key === 'filter' && one.choices.includes('pcf')));
    const planner = plannerOf(gnomon, {partition: 'cascades'});
    planner.check(LightType.directional);
    assert.throws(() => planner.check(LightType.point), GnomonError);
    planner.set('filter', 'esm', 1);
    assert.equal(planner.get('filter', 1), 'esm');
    assert.equal(planner.get('partition', 0), 'cascades');
});

test('the shaders are there', async () => {
    const shaders = await loadShaders();
    assert.match(shaders.get('mask_pcf.frag').files.any, /@fragment/);
    assert.throws(() => shaders.get('fog.frag'), GnomonError);
});
