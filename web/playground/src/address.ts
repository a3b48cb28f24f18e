// SPDX-License-Identifier: Apache-2.0
// The page's state, and how it is written in the address: #world=sundial&technique=pcf&light=0.53&map=2048&...
// Whatever an address has, a state comes out of it: values that make no sense are left at their defaults.
import { clamp, lengthOf, subtract, type Camera, type Vec3 } from './vectors.ts';

export const kViews = ['shaded', 'mask', 'difference', 'truth'] as const;
export type View = (typeof kViews)[number];
export const kMapSizes = [0, 256, 512, 1024, 2048, 4096];

export interface PageState {
  /** The name of a built-in world. */
  world: string;
  /** Names of values of the choices, with + between: filter, partition, fit and so on. */
  technique: string;
  /** The sun's angular diameter, degrees, 0 to 10. */
  light: number;
  /** Texels on a side of a map; 0: the planner chooses. */
  map: number;
  /** Azimuth and height of the sun, degrees; nothing: the world's own. */
  sun: [number, number] | undefined;
  /** A camera, or the name of one of the world's; nothing: the first of these. */
  camera: Camera | string | undefined;
  /** Vertical field of view of a camera that is named, degrees; nothing: its own. */
  fov: number | undefined;
  view: View;
  /** The share of the picture's width where truth begins, 0 to 1. */
  split: number;
  /** Further options of the library, by their keys. */
  options: Record<string, string>;
}

export const kDefaults: PageState = {
  world: 'sundial', technique: 'auto', light: 0.53, map: 0, sun: undefined, camera: undefined, fov: undefined, view: 'shaded', split: 0.5, options: {},
};

const kFarthest_m = 1e4;

/** As many finite numbers as are wanted, or nothing. */
function numbersOf(text: string, least: number, most: number): number[] | undefined {
  const values = text.split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));
  return values.length >= least && values.length <= most && values.every(Number.isFinite) ? values : undefined;
}

function sunOf(text: string): [number, number] | undefined {
  const values = numbersOf(text, 2, 2);
  return values && [((values[0] % 360) + 360) % 360, clamp(values[1], 3, 90)];
}

function cameraOf(text: string): Camera | undefined {
  const v = numbersOf(text, 6, 7);
  if (!v || v.slice(0, 6).some((one) => Math.abs(one) > kFarthest_m)) {
    return undefined;
  }
  const eye: Vec3 = [v[0], v[1], v[2]];
  const target: Vec3 = [v[3], v[4], v[5]];
  const across = Math.hypot(eye[0] - target[0], eye[2] - target[2]);
  return lengthOf(subtract(eye, target)) > 0.01 && across > 1e-4 ? { eye, target, fov: clamp(v[6] ?? 45, 5, 100) } : undefined;
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** The state that an address's part after # stands for. */
export function readAddress(hash: string, worlds: readonly string[]): PageState {
  const state: PageState = { ...kDefaults, options: {} };
  for (const item of hash.replace(/^#/, '').split('&')) {
    const at = item.indexOf('=');
    const key = decoded(item.slice(0, Math.max(at, 0)));
    const text = decoded(item.slice(at + 1)).slice(0, 200);
    const number = text.trim() === '' ? NaN : Number(text);
    if (key === 'world' && worlds.includes(text)) {
      state.world = text;
    } else if (key === 'technique' && /^[a-z0-9.=+-]+$/.test(text)) {
      state.technique = text;
    } else if (key === 'light' && Number.isFinite(number)) {
      state.light = clamp(number, 0, 10);
    } else if (key === 'map' && kMapSizes.includes(number)) {
      state.map = number;
    } else if (key === 'sun') {
      state.sun = sunOf(text);
    } else if (key === 'camera') {
      state.camera = /^[a-z][a-z0-9_-]*$/.test(text) ? text : cameraOf(text);
    } else if (key === 'fov' && Number.isFinite(number)) {
      state.fov = clamp(number, 5, 100);
    } else if (key === 'view' && (kViews as readonly string[]).includes(text)) {
      state.view = text as View;
    } else if (key === 'split' && Number.isFinite(number)) {
      state.split = clamp(number, 0, 1);
    } else if (/^[a-z0-9-]+[.-][a-z0-9.-]+$/.test(key) && /^[a-z0-9.+-]{1,40}$/i.test(text)) {
      state.options[key] = text;
    }
  }
  return state;
}

const short = (value: number, digits: number): string => String(Number(value.toFixed(digits)));

/** The address's part after #, by which readAddress() finds the state again. */
export function writeAddress(state: PageState): string {
  const items = [`world=${state.world}`, `technique=${state.technique}`, `light=${short(state.light, 3)}`, `map=${state.map}`];
  if (state.sun) {
    items.push(`sun=${state.sun.map((one) => short(one, 1)).join(',')}`);
  }
  if (typeof state.camera === 'object') {
    const { eye, target, fov } = state.camera;
    items.push(`camera=${[...eye, ...target, fov].map((one) => short(one, 2)).join(',')}`);
  }
  if (typeof state.camera === 'string') {
    items.push(`camera=${state.camera}`);
  }
  if (state.fov !== undefined) {
    items.push(`fov=${short(state.fov, 2)}`);
  }
  items.push(`view=${state.view}`, `split=${short(state.split, 3)}`);
  for (const [key, value] of Object.entries(state.options)) {
    items.push(`${encodeURIComponent(key)}=${encodeURIComponent(value)}`);
  }
  return `#${items.join('&')}`;
}

/** A technique taken apart: one value for each choice that it names, and options that it sets. */
export function partsOf(technique: string, choices: readonly { choice: string; name: string }[]): Record<string, string> {
  const parts: Record<string, string> = {};
  for (const word of technique.split('+')) {
    const at = word.indexOf('=');
    if (at > 0) {
      parts[word.slice(0, at)] = word.slice(at + 1);
      continue;
    }
    // `auto` and `smoothies` are values of several choices: the first is meant, the filter.
    const row = choices.find((one) => one.name === word && one.choice === 'filter') ?? choices.find((one) => one.name === word);
    if (row && row.choice !== 'light') {
      parts[row.choice] = word;
    }
  }
  return parts;
}
