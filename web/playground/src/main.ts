// SPDX-License-Identifier: Apache-2.0
// The playground: a world under a movable sun, with Gnomon's shadows beside the truth. Its state is in the address.
import { kDefaults, partsOf, readAddress, writeAddress, type PageState } from './address.ts';
import { Controls, element, type Choice } from './controls.ts';
import { drag, listen } from './pointer.ts';
import { Renderer } from './renderer.ts';
import { kStandIn, type Drawn } from './shadows.ts';
import { Truth } from './truth.ts';
import { clamp, degrees, dolly, lengthOf, orbit, pan, subtract, sunDirection, sunPlace, type Camera } from './vectors.ts';
import { fetchWorld, readWorld, type World } from './world.ts';
import { openDevice, showWithout } from './without.ts';

const kWorlds = ['sundial', 'rts', 'canopies'];
const kLeastHeight_deg = 3;
const kSoftware = { width: 640, height: 360 };
const kLargest = { width: 1280, height: 720 };

// The dial with the house behind it, which none of the world's own cameras shows.
const kFirstCameras: Record<string, Camera> = { sundial: { eye: [4.6, 3.3, 3.4], target: [-1.2, 1.25, -1.6], fov: 45 } };

/** A camera of a world by its name; else the one that visitors see first. */
function cameraOf(world: World, name: string | undefined, fov: number | undefined): Camera {
  const named = world.views.find((one) => one.name === name);
  if (!named && world.name in kFirstCameras) {
    return kFirstCameras[world.name];
  }
  const view = named ?? world.views[0];
  return { eye: view.eye, target: view.target, fov: fov ?? degrees(view.fov_y_rad) };
}

class Page {
  private state: PageState;
  private world: World | undefined;
  private readonly controls: Controls;
  private readonly truth: Truth;
  private readonly canvas = element<HTMLCanvasElement>('canvas');
  private drawing = false; // a frame is asked for
  private anew = true; // and its shadows, too
  private reading = false;
  private mask: Uint8Array | undefined; // of the frame that is shown
  private loading = '';
  private toTrace: ArrayBuffer | undefined; // a world that is not traced before its shadows have been seen

  constructor(private readonly renderer: Renderer, private readonly choices: Choice[], private readonly software: boolean) {
    this.state = this.stateOf(location.hash);
    renderer.shown = (what) => this.shown(what);
    renderer.shadows.compiled = () => this.redraw(true);
    this.truth = new Truth(() => this.redraw(false));
    this.controls = new Controls(choices, renderer.shadows.options(), kWorlds, (parts) => this.change(parts), () => this.state);
    this.listen();
  }

  /** The state of an address; a size of maps in its technique becomes the setting. */
  private stateOf(hash: string): PageState {
    const state = readAddress(hash, kWorlds);
    const size = Number(partsOf(state.technique, this.choices)['map-size']);
    if (size > 0) {
      state.technique = state.technique.split('+').filter((word) => !word.startsWith('map-size=')).join('+') || 'auto';
      state.map = clamp(2 ** Math.round(Math.log2(size)), 256, 4096);
    }
    return state;
  }

  private listen(): void {
    const camera = (next: (camera: Camera) => Camera): void => void (this.camera && this.change({ camera: next(this.camera) }));
    const limits = (): [number, number] => [0.5, 4 * (this.renderer.radius || 1)];
    listen(this.canvas, {
      turn: (across, upwards) => camera((one) => orbit(one, across, upwards)),
      pan: (right, up) => camera((one) => pan(one, right, up)),
      nearer: (by) => camera((one) => dolly(one, by, ...limits())),
      sun: (azimuth, height) => this.moveSun((this.state.sun ?? [0, 45])[0] + azimuth, (this.state.sun ?? [0, 45])[1] + height),
    });
    const dial = element<SVGElement>('dial');
    drag(dial, dial, (x, y) => {
      const [right, ahead] = [2 * x - 1, 1 - 2 * y];
      const out = Math.min(1, Math.hypot(right, ahead) / 0.92);
      this.moveSun(this.heading + degrees(Math.atan2(right, ahead)), 90 * (1 - out));
    });
    const divider = element('divider');
    drag(divider, element('picture'), (x) => this.change({ split: clamp(x, 0, 1) }));
    divider.addEventListener('keydown', (event) => {
      const by = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
      if (by) {
        event.preventDefault();
        this.change({ split: clamp(this.state.split + by, 0, 1) });
      }
    });
    element('controls').addEventListener('reset', (event) => {
      event.preventDefault();
      this.replace({ ...kDefaults, options: {} });
    });
    element('copy').addEventListener('click', () => void navigator.clipboard?.writeText(location.href).then(() => this.say('The address is copied.')));
    window.addEventListener('hashchange', () => {
      if (location.hash !== writeAddress(this.state)) {
        this.replace(this.stateOf(location.hash));
      }
    });
    new ResizeObserver(() => this.resize()).observe(element('picture'));
  }

  /** The camera, once there is a world. */
  private get camera(): Camera | undefined {
    return typeof this.state.camera === 'object' ? this.state.camera : undefined;
  }

  /** The camera's heading: degrees from -z, clockwise from above. */
  private get heading(): number {
    const [x, , z] = this.camera ? subtract(this.camera.target, this.camera.eye) : [0, 0, -1];
    return degrees(Math.atan2(x, -z));
  }

  private moveSun(azimuth: number, height: number): void {
    this.change({ sun: [((azimuth % 360) + 360) % 360, clamp(height, kLeastHeight_deg, 90)] });
  }

  private say(text: string): void {
    element('said').textContent = text;
  }

  private resize(): void {
    const width = element('picture').clientWidth * Math.min(devicePixelRatio, 2);
    const size = this.software || width <= kSoftware.width ? kSoftware : width <= 960 ? { width: 960, height: 540 } : kLargest;
    if (this.canvas.width !== size.width) {
      Object.assign(this.canvas, size);
      this.redraw(true);
    }
  }

  private change(parts: Partial<PageState>): void {
    this.replace({ ...this.state, ...parts });
  }

  private replace(next: PageState): void {
    const last = this.state;
    this.state = next;
    if (next.world !== this.world?.name) {
      this.load(next.world).catch((error: unknown) => this.say(String(error)));
      return;
    }
    this.complete();
    const looks = (one: PageState): string => JSON.stringify([one.technique, one.light, one.map, one.sun, one.camera, one.options]);
    this.redraw(looks(last) !== looks(this.state));
    this.show();
  }

  /** Camera and sun are the world's own where the address has none. */
  private complete(): void {
    if (this.world) {
      if (!this.camera) {
        this.state.camera = cameraOf(this.world, this.state.camera as string | undefined, this.state.fov);
        this.state.fov = undefined;
      }
      this.state.sun ??= sunPlace(this.world.sun.direction);
    }
  }

  /** Loads a world and shows it. `begun`: it is being fetched. */
  async load(name: string, begun?: Promise<ArrayBuffer>): Promise<void> {
    if (this.loading === name) {
      return;
    }
    this.loading = name;
    element('waiting').textContent = 'Loading the world …';
    const bytes = await (begun ?? fetchWorld(name));
    if (this.state.world !== name) {
      return; // another one was asked for
    }
    this.loading = '';
    this.world = readWorld(bytes);
    this.renderer.setWorld(this.world);
    this.truth.stop();
    this.toTrace = bytes;
    this.complete();
    this.controls.setCameras(this.world.views.map((view) => view.name), (index) => {
      this.change({ camera: this.world!.views[index].name });
    });
    this.resize();
    this.redraw(true);
    this.show();
  }

  /** Asks for a frame; `anew`: with other shadows. */
  private redraw(anew: boolean): void {
    if (anew) {
      this.anew = true;
      this.mask = undefined;
    }
    if (!this.drawing) {
      this.drawing = true;
      requestAnimationFrame(() => this.draw());
    }
  }

  private draw(): void {
    this.drawing = false;
    const { world, state, camera } = this;
    if (!world || !camera || !state.sun) {
      return;
    }
    const { width, height } = this.canvas;
    const sight = { camera, sun: sunDirection(...state.sun) };
    const anew = this.anew;
    if (anew) {
      this.anew = false;
      const view = { width, height, camera: sight.camera, sun: sight.sun, light: state.light };
      if (JSON.stringify(view) !== JSON.stringify(this.truth.view)) {
        this.truth.restart(view);
      }
    }
    this.renderer.setTruth(this.truth.visibility);
    this.say(this.renderer.draw(state, sight, anew));
    if (!this.mask && this.renderer.shadows.drawn === 'shadows') {
      void this.readMask();
    }
    this.showNumbers();
  }

  /** A picture is on the canvas. */
  private shown(what: Drawn): void {
    document.body.dataset.shown = what;
    element('waiting').textContent = what === 'shadows' ? '' : what === 'nothing' ? 'Compiling shaders of shadows …'
      : `Shadows by ${kStandIn} until shaders of ${this.state.technique} are compiled …`;
    if (this.toTrace && what === 'shadows') {
      this.truth.setWorld(this.toTrace);
      this.toTrace = undefined;
    }
  }

  /** Fetches the mask that is shown, to be held against the truth. */
  private async readMask(): Promise<void> {
    if (this.reading) {
      return;
    }
    this.reading = true;
    const mask = await this.renderer.readMask();
    this.reading = false;
    if (!this.anew && !this.drawing) {
      this.mask = mask;
      this.showNumbers();
    } else {
      this.redraw(false);
    }
  }

  private showNumbers(): void {
    const rmse = this.mask && this.truth.rmseOf(this.mask);
    element('rmse').textContent = rmse === undefined ? '–' : rmse.toFixed(4);
    element('rays').textContent = this.truth.samples > 0 ? String(this.truth.samples) : '–';
    if (this.renderer.shadows.drawn !== 'shadows') { // numbers are of the filter that was asked for
      element('rmse').textContent = element('maps').textContent = element('texels').textContent = '–';
      return;
    }
    const { maps, texels } = this.renderer.shadows.counts;
    element('maps').textContent = String(maps);
    element('texels').textContent = texels >= 2 ** 20 ? `${(texels / 2 ** 20).toFixed(1)} Mi` : `${Math.round(texels / 1024)} Ki`;
  }

  /** Shows the state in settings, on the picture and in the address. */
  private show(): void {
    const { state, world, camera } = this;
    const at = world?.views.findIndex((view) => camera && lengthOf(subtract(view.eye, camera.eye)) < 0.01) ?? -1;
    this.controls.show(state, at + 1);
    const divider = element('divider');
    const divided = state.view === 'shaded' || state.view === 'mask';
    divider.hidden = !divided;
    divider.style.left = `${100 * state.split}%`;
    divider.setAttribute('aria-valuenow', String(Math.round(100 * state.split)));
    const compares = state.view === 'difference';
    element('tag-left').hidden = !(divided && state.split > 0.12) && !compares;
    element('tag-left').textContent = compares ? 'orange: too light, blue: too dark' : 'Gnomon';
    element('tag-right').hidden = compares || (divided && state.split > 0.88);
    const [azimuth, height] = state.sun ?? [0, 45];
    const turn = ((azimuth - this.heading) * Math.PI) / 180;
    const out = 46 * (1 - height / 90);
    element('dial-sun').setAttribute('transform', `translate(${out * Math.sin(turn)} ${-out * Math.cos(turn)})`);
    history.replaceState(null, '', writeAddress(state));
  }
}

async function main(): Promise<void> {
  const name = readAddress(location.hash, kWorlds).world;
  const begun = fetchWorld(name);
  begun.catch(() => undefined); // load() says it
  try {
    const [found, answer] = await Promise.all([openDevice(), fetch('choices.json')]);
    if (typeof found === 'string') {
      showWithout(found);
      return;
    }
    void found.device.lost.then((info) => info.reason !== 'destroyed' && showWithout('The browser has lost the graphics device. Reload the page to try again.'));
    const choices = (await answer.json()) as Choice[];
    const renderer = await Renderer.make(found.device, element<HTMLCanvasElement>('canvas'), choices, found.software);
    await new Page(renderer, choices, found.software).load(name, begun);
  } catch (error) {
    showWithout(error instanceof Error ? error.message : String(error));
  }
}

void main();
