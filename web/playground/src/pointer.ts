// SPDX-License-Identifier: Apache-2.0
// The wishes of a pointer, a wheel or a key on the picture.

export interface Moves {
  /** The camera turns about its target, by degrees. */
  turn(across: number, upwards: number): void;
  /** The camera moves along the picture, by shares of its height. */
  pan(right: number, up: number): void;
  /** The camera's distance is multiplied. */
  nearer(by: number): void;
  /** The sun moves, by degrees. */
  sun(azimuth: number, height: number): void;
}

const kDegreesPerWidth = 180;
const kKey_deg = 3;

/** Listens to drags, wheels, fingers and keys on `element`. */
export function listen(element: HTMLElement, moves: Moves): void {
  const held = new Map<number, { x: number; y: number }>();
  let movesSun = false;
  let pans = false;
  element.addEventListener('contextmenu', (event) => event.preventDefault());
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    movesSun = event.shiftKey || event.button === 2;
    pans = event.ctrlKey || event.button === 1;
  });
  element.addEventListener('pointermove', (event) => {
    const last = held.get(event.pointerId);
    if (!last) {
      return;
    }
    const size = element.getBoundingClientRect();
    const dx = event.clientX - last.x;
    const dy = event.clientY - last.y;
    const angle = kDegreesPerWidth / size.width;
    if (held.size === 2) {
      const other = [...held].find(([id]) => id !== event.pointerId)![1];
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
      moves.nearer(before / Math.max(after, 1));
      moves.pan((-0.5 * dx) / size.height, (0.5 * dy) / size.height);
    } else if (movesSun) {
      moves.sun(dx * angle, -dy * angle);
    } else if (pans) {
      moves.pan(-dx / size.height, dy / size.height);
    } else {
      moves.turn(dx * angle, dy * angle);
    }
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  const release = (event: PointerEvent): void => void held.delete(event.pointerId);
  element.addEventListener('pointerup', release);
  element.addEventListener('pointercancel', release);
  element.addEventListener('wheel', (event) => {
    event.preventDefault();
    moves.nearer(Math.exp(0.001 * Math.max(-200, Math.min(200, event.deltaY))));
  }, { passive: false });
  element.addEventListener('keydown', (event) => {
    const across = { ArrowLeft: -kKey_deg, ArrowRight: kKey_deg }[event.key] ?? 0;
    const upwards = { ArrowUp: kKey_deg, ArrowDown: -kKey_deg }[event.key] ?? 0;
    const nearer = { '+': 1 / 1.1, '=': 1 / 1.1, '-': 1.1 }[event.key];
    if (across !== 0 || upwards !== 0) {
      event.preventDefault();
      (event.shiftKey ? moves.sun : moves.turn)(across, upwards);
    } else if (nearer) {
      moves.nearer(nearer);
    }
  });
}

/** Calls `moved` with a pointer's place within `element`, 0 to 1 from left and top, while it is held down there. */
export function drag(element: Element, within: Element, moved: (x: number, y: number) => void): void {
  const report = (event: PointerEvent): void => {
    const box = within.getBoundingClientRect();
    moved((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
  };
  element.addEventListener('pointerdown', (event) => {
    element.setPointerCapture((event as PointerEvent).pointerId);
    report(event as PointerEvent);
  });
  element.addEventListener('pointermove', (event) => {
    if (element.hasPointerCapture((event as PointerEvent).pointerId)) {
      report(event as PointerEvent);
    }
  });
}
