// SPDX-License-Identifier: Apache-2.0
// A tree of boxes, parted where the surface area heuristic says so.
// Based on: I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binning).

/** Node i has the box bounds[6 i ...] (least x, y, z, then largest). links[2 i + 1] items from order[links[2 i]] where that is
 * not 0; else two children, at links[2 i] and the node after it. Node 0 is the root. */
export interface Bvh {
  bounds: Float32Array;
  links: Int32Array;
  order: Uint32Array;
}

const kBins = 12;
const kLeaf = 4; // items that are not parted

function grow(into: Float64Array, boxes: Float32Array | Float64Array, at: number): void {
  for (let k = 0; k < 3; ++k) {
    into[k] = Math.min(into[k], boxes[at + k]);
    into[k + 3] = Math.max(into[k + 3], boxes[at + k + 3]);
  }
}

const kEmpty = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
const emptyBox = (): Float64Array => new Float64Array(kEmpty);
const parts = Array.from({ length: kBins }, emptyBox); // working memory of cheapest()

function halfArea(box: Float64Array): number {
  const [x, y, z] = [box[3] - box[0], box[4] - box[1], box[5] - box[2]];
  return x >= 0 ? x * y + y * z + z * x : 0;
}

/** The bin of an item's middle along an axis. */
function binOf(boxes: Float32Array, item: number, axis: number, low: number, high: number): number {
  const middle = 0.5 * (boxes[6 * item + axis] + boxes[6 * item + axis + 3]);
  return Math.min(kBins - 1, Math.floor(((middle - low) / (high - low)) * kBins));
}

/** The cheapest plane between bins along one axis: what lies before it, and its cost. */
function cheapest(boxes: Float32Array, items: Uint32Array, axis: number, low: number, high: number): { bin: number; cost: number } {
  const counts = new Uint32Array(kBins);
  parts.forEach((box) => box.set(kEmpty));
  for (const item of items) {
    const bin = binOf(boxes, item, axis, low, high);
    ++counts[bin];
    grow(parts[bin], boxes, 6 * item);
  }
  const after = new Float64Array(kBins);
  let all = emptyBox();
  let count = 0;
  for (let i = kBins - 1; i > 0; --i) {
    grow(all, parts[i], 0);
    count += counts[i];
    after[i] = count * halfArea(all);
  }
  let best = { bin: -1, cost: Infinity };
  all = emptyBox();
  count = 0;
  for (let i = 0; i + 1 < kBins; ++i) {
    grow(all, parts[i], 0);
    count += counts[i];
    const cost = count * halfArea(all) + after[i + 1];
    if (count > 0 && count < items.length && cost < best.cost) {
      best = { bin: i, cost };
    }
  }
  return best;
}

/** Moves items before the best plane to the front of `items`; how many they are, or 0 where the node is better left whole. */
function part(boxes: Float32Array, items: Uint32Array, box: Float64Array): number {
  const middles = emptyBox();
  for (const item of items) {
    for (let k = 0; k < 3; ++k) {
      const middle = 0.5 * (boxes[6 * item + k] + boxes[6 * item + k + 3]);
      middles[k] = Math.min(middles[k], middle);
      middles[k + 3] = Math.max(middles[k + 3], middle);
    }
  }
  let best = { bin: -1, cost: items.length <= 4 * kLeaf ? items.length * halfArea(box) : Infinity, axis: -1 };
  for (let axis = 0; axis < 3; ++axis) {
    if (middles[axis + 3] > middles[axis]) {
      const found = cheapest(boxes, items, axis, middles[axis], middles[axis + 3]);
      best = found.cost < best.cost ? { ...found, axis } : best;
    }
  }
  if (best.axis < 0) {
    return 0;
  }
  let front = 0;
  for (let i = 0; i < items.length; ++i) {
    const item = items[i];
    if (binOf(boxes, item, best.axis, middles[best.axis], middles[best.axis + 3]) <= best.bin) {
      items[i] = items[front];
      items[front++] = item;
    }
  }
  return front;
}

/** The tree over boxes of six floats each: least x, y, z, then largest. */
export function buildBvh(boxes: Float32Array): Bvh {
  const count = boxes.length / 6;
  const order = Uint32Array.from({ length: count }, (_, i) => i);
  const bounds = new Float32Array(6 * Math.max(1, 2 * count));
  const links = new Int32Array(2 * Math.max(1, 2 * count));
  let nodes = 1;
  const open: [number, number, number][] = [[0, 0, count]];
  for (let next = open.pop(); next; next = open.pop()) {
    const [node, first, end] = next;
    const box = emptyBox();
    const items = order.subarray(first, end);
    for (const item of items) {
      grow(box, boxes, 6 * item);
    }
    bounds.set(box, 6 * node);
    const front = items.length > kLeaf ? part(boxes, items, box) : 0;
    if (front === 0) {
      links.set([first, end - first], 2 * node);
      continue;
    }
    links.set([nodes, 0], 2 * node);
    open.push([nodes, first, first + front], [nodes + 1, first + front, end]);
    nodes += 2;
  }
  return { bounds: bounds.slice(0, 6 * nodes), links: links.slice(0, 2 * nodes), order };
}
