// SPDX-License-Identifier: Apache-2.0
// The scene of cases.json (draw_cases.cpp), planned: what node and the browser have in common.

/** A planner with options by their keys. */
export function plannerOf(gnomon, settings) {
    const planner = gnomon.makePlanner();
    Object.entries(settings).forEach(([key, value]) => planner.set(key, value));
    return planner;
}

export function objectsOf(gnomon, bounds) {
    const objects = gnomon.makeObjects();
    bounds.forEach(box => objects.add(box));
    return objects;
}

/** Differences of two plans' JSON: how many numbers differ, by how much of their size at most, and other differences by their places. */
export function compare(found, wanted) {
    const told = {numbers: 0, differ: 0, farthest: 0, others: []};
    const walk = (a, b, place) => {
        if (typeof a === 'number' && typeof b === 'number') {
            ++told.numbers;
            if (!Object.is(a, b) && a !== b) {
                ++told.differ;
                told.farthest = Math.max(told.farthest, Math.abs(a - b) / Math.max(Math.abs(a), Math.abs(b), 1));
            }
        } else if (a !== null && b !== null && typeof a === 'object' && typeof b === 'object') {
            for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) {
                walk(a[key], b[key], `${place}.${key}`);
            }
        } else if (a !== b) {
            told.others.push(`${place}: ${a} and not ${b}`);
        }
    };
    walk(found, wanted, 'plan');
    return told;
}
