// SPDX-License-Identifier: Apache-2.0
// The device, and the page where there is none: a sentence and pictures.
import { wantedFeatures } from 'gnomon-shadows';
import { element } from './controls.ts';

const kPictures = [
  ['filter-raymarch', 'raymarch: rays to points of the light, through the map'],
  ['filter-pcss', 'pcss: a penumbra as wide as the blocker’s distance asks'],
  ['filter-hard', 'hard: one depth comparison a pixel'],
  ['filter-evsm', 'evsm: moments of two exponential warps'],
  ['truth-gate', 'the truth: traced'],
  ['truth-dial', 'the truth: traced'],
];

/** A device, or the sentence that says why there is none. */
export async function openDevice(): Promise<{ device: GPUDevice; software: boolean } | string> {
  if (!navigator.gpu) {
    return 'This browser has no WebGPU, which the playground draws with. Here are pictures instead.';
  }
  const adapter = await navigator.gpu.requestAdapter();
  if (!adapter) {
    return 'This browser has WebGPU but found no graphics device for it. Here are pictures instead.';
  }
  try {
    const device = await adapter.requestDevice({ requiredFeatures: wantedFeatures(adapter) });
    const { architecture, description, isFallbackAdapter } = adapter.info;
    return { device, software: isFallbackAdapter || /swiftshader|llvmpipe/i.test(`${architecture} ${description}`) };
  } catch (error) {
    return `The graphics device could not be opened (${error instanceof Error ? error.message : error}). Here are pictures instead.`;
  }
}

/** Shows pictures instead of the playground, and why. */
export function showWithout(why: string): void {
  document.querySelector('main')!.classList.add('without');
  element('without').hidden = false;
  element('why').textContent = why;
  element('pictures').replaceChildren(...kPictures.map(([name, caption]) => {
    const figure = document.createElement('figure');
    const image = new Image(400, 225);
    image.src = `pictures/${name}.jpg`;
    image.alt = caption;
    const text = document.createElement('figcaption');
    text.textContent = caption;
    figure.append(image, text);
    return figure;
  }));
}
