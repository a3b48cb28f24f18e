// SPDX-License-Identifier: Apache-2.0
// The page's settings: what they show, and what they change of the state.
import type { Option } from 'gnomon-shadows';
import { kMapSizes, kViews, partsOf, type PageState } from './address.ts';

/** A row of the library's table of choices. */
export interface Choice {
  choice: string;
  name: string;
  summary: string;
}

// The techniques that visitors are offered; any other may stand in the address.
const kOffered = {
  filter: ['auto', 'raymarch', 'pcss', 'pcf', 'hard', 'vsm', 'evsm', 'msm', 'esm', 'lvsm'],
  partition: ['auto', 'single', 'cascades', 'multi'],
  fit: ['auto', 'uniform', 'lispsm', 'lispsm-simple', 'tsm', 'psm', 'scene'],
} as const;
type Part = keyof typeof kOffered;
const kParts = Object.keys(kOffered) as Part[];

const kAverages = ['blur', 'blur.sigma', 'bleeding.linstep', 'msaa'];
/** Options that matter most, by filter. */
const kOptionsOf: Record<string, string[]> = {
  pcf: ['pcf.kernel', 'pcf.radius'], vsm: [...kAverages, 'penumbra'], msm: [...kAverages, 'penumbra'], evsm: kAverages, esm: [...kAverages, 'esm.exponent'],
  lvsm: [...kAverages, 'lvsm.layers'], raymarch: ['mask-size'], pcss: ['mask-size'],
};

const kLargestLight_deg = 10;
/** Small lights have most of the slider's way: the angle is its cube. */
const lightOf = (place: number): number => Number((kLargestLight_deg * place ** 3).toPrecision(3));
const placeOf = (light: number): number => Math.cbrt(light / kLargestLight_deg);

/** The element of an id, which the page has. */
export function element<T extends Element = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) {
    throw new Error(`The page has no ${id}`);
  }
  return found as unknown as T;
}

function fillSelect(select: HTMLSelectElement, values: readonly string[], texts: (value: string) => string): void {
  select.replaceChildren(...values.map((value) => new window.Option(texts(value), value)));
}

/** A technique with another value of one choice; auto is left out but of the filter. */
export function withPart(technique: string, choices: readonly Choice[], part: string, value: string): string {
  const parts: Record<string, string> = { ...partsOf(technique, choices), [part]: value };
  const named = Object.entries(parts).filter(([key, name]) => key !== 'filter' && name !== 'auto');
  return [parts.filter ?? 'auto', ...named.map(([key, name]) => (choices.some((one) => one.choice === key) ? name : `${key}=${name}`))].join('+');
}

export class Controls {
  private readonly form = element<HTMLFormElement>('controls');

  /** `change` gets the parts of the state that a visitor changed. */
  constructor(private readonly choices: readonly Choice[], private readonly options: readonly Option[], worlds: readonly string[],
              private readonly change: (parts: Partial<PageState>) => void, private state: () => PageState) {
    for (const part of kParts) {
      const select = element<HTMLSelectElement>(part);
      select.onchange = () => change({ technique: withPart(state().technique, choices, part, select.value), ...(part === 'filter' ? { options: {} } : {}) });
    }
    fillSelect(element('map'), kMapSizes.map(String), (size) => (size === '0' ? 'chosen by the planner' : `${size} × ${size}`));
    fillSelect(element('world'), worlds, (name) => name);
    const onNumber = (id: string, take: (value: number) => Partial<PageState>): void => {
      const field = element<HTMLInputElement | HTMLSelectElement>(id);
      field.addEventListener('input', () => change(take(Number(field.value))));
    };
    onNumber('light', (place) => ({ light: lightOf(place) }));
    onNumber('map', (map) => ({ map }));
    const sun = (): [number, number] => state().sun ?? [0, 45];
    onNumber('azimuth', (azimuth) => ({ sun: [azimuth, sun()[1]] }));
    onNumber('height', (height) => ({ sun: [sun()[0], height] }));
    element<HTMLSelectElement>('world').onchange = (event) => change({ world: (event.target as HTMLSelectElement).value, sun: undefined, camera: undefined });
    element('views').replaceChildren(...kViews.map((view) => {
      const label = document.createElement('label');
      label.innerHTML = `<input type="radio" name="view" value="${view}">${view}`;
      label.firstElementChild!.addEventListener('change', () => change({ view }));
      return label;
    }));
  }

  /** Calls `choose` with the place of a camera in the list. */
  setCameras(names: readonly string[], choose: (index: number) => void): void {
    const select = element<HTMLSelectElement>('place');
    fillSelect(select, ['', ...names], (name) => name || 'your own');
    select.onchange = () => select.selectedIndex > 0 && choose(select.selectedIndex - 1);
  }

  private showPart(part: Part, value: string): void {
    const select = element<HTMLSelectElement>(part);
    const offered: readonly string[] = kOffered[part];
    fillSelect(select, offered.includes(value) ? offered : [...offered, value], (name) => name);
    select.value = value;
    const says = this.choices.find((one) => one.choice === part && one.name === value)?.summary ?? '';
    const isName = this.choices.some((one) => one.name === says.split(/[ ,]/)[0]); // which is written as it is
    element(`${part}-says`).textContent = says && `${isName ? says[0] : says[0].toUpperCase()}${says.slice(1)}.`;
  }

  /** Shows the state. `camera`: the place in the list of cameras, 0 for one's own. */
  show(state: PageState, camera: number): void {
    const parts = partsOf(state.technique, this.choices);
    kParts.forEach((part) => this.showPart(part, parts[part] ?? 'auto'));
    const set = (id: string, value: number | string, text?: string): void => {
      const field = element<HTMLInputElement | HTMLSelectElement>(id);
      if (field.value !== String(value)) {
        field.value = String(value);
      }
      if (text !== undefined) {
        element(`${id}-value`).textContent = text;
        field.setAttribute('aria-valuetext', text);
      }
    };
    set('light', placeOf(state.light), `${state.light}°`);
    set('map', state.map);
    set('world', state.world);
    const [azimuth, height] = state.sun ?? [0, 45];
    set('azimuth', azimuth, `${Math.round(azimuth)}°`);
    set('height', height, `${height.toFixed(1)}°`);
    element<HTMLSelectElement>('place').selectedIndex = camera;
    for (const radio of this.form.querySelectorAll<HTMLInputElement>('input[name=view]')) {
      radio.checked = radio.value === state.view;
    }
    this.showOptions(parts.filter ?? 'auto', state);
  }

  /** A field for each option that matters with this filter. */
  private showOptions(filter: string, state: PageState): void {
    const wanted = kOptionsOf[filter === 'auto' ? 'raymarch' : filter] ?? [];
    const place = element('options');
    if (place.dataset.filter !== filter) {
      place.dataset.filter = filter;
      place.replaceChildren(...this.options.filter((one) => wanted.includes(one.key)).map((option) => this.fieldOf(option)));
    }
    for (const field of place.querySelectorAll<HTMLInputElement | HTMLSelectElement>('[data-key]')) {
      if (field !== document.activeElement) {
        field.value = state.options[field.dataset.key!] ?? '';
      }
    }
  }

  private fieldOf(option: Option): HTMLElement {
    const box = document.createElement('div');
    box.className = 'field';
    const id = `option-${option.key}`;
    const field = document.createElement(option.choices ? 'select' : 'input');
    if (field instanceof HTMLSelectElement) {
      fillSelect(field, ['', ...option.choices.split(' ')], (name) => name || `default (${option.defaultValue || 'by the filter'})`);
    } else {
      Object.assign(field, { type: 'number', min: String(option.min), max: String(option.max), step: 'any', placeholder: option.defaultValue || 'by the filter' });
    }
    field.id = id;
    field.dataset.key = option.key;
    field.addEventListener('change', () => {
      const options = { ...this.state().options };
      delete options[option.key];
      this.change({ options: field.value === '' ? options : { ...options, [option.key]: field.value } });
    });
    const label = document.createElement('label');
    label.htmlFor = id;
    label.textContent = option.unit ? `${option.key}, ${option.unit}` : option.key;
    const says = document.createElement('p');
    says.id = `${id}-says`;
    says.textContent = option.doc;
    field.setAttribute('aria-describedby', says.id);
    box.append(label, field, says);
    return box;
  }
}
