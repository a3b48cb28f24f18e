// SPDX-License-Identifier: Apache-2.0
// Panes that show the same place of their pictures: wheel, drag, pinch and keys move all of them.
"use strict";

// A point p of the picture is at x + scale * p of a pane, both from 0 to 1.
const view = { scale: 1, x: 0, y: 0 };
const kLargestScale = 40;
const panes = new Set();
const viewWatchers = [];

function showView() {
  view.x = Math.min(0, Math.max(1 - view.scale, view.x));
  view.y = Math.min(0, Math.max(1 - view.scale, view.y));
  for (const pane of panes) {
    for (const picture of pane.querySelectorAll(".layer > *")) {
      picture.style.transform = `translate(${100 * view.x}%, ${100 * view.y}%) scale(${view.scale})`;
      const pixels = picture.naturalWidth || picture.width;
      pane.classList.toggle("near", pixels > 0 && (view.scale * pane.clientWidth) / pixels >= 2.5);
    }
  }
  document.body.classList.toggle("zoomed", view.scale > 1);
  viewWatchers.forEach((watcher) => watcher());
}

/// (x, y) of a pane stays where it is.
function zoomAt(factor, x, y) {
  const scale = Math.min(kLargestScale, Math.max(1, view.scale * factor));
  view.x = x - ((x - view.x) * scale) / view.scale;
  view.y = y - ((y - view.y) * scale) / view.scale;
  view.scale = scale;
  showView();
}

function moveBy(x, y) {
  view.x += x;
  view.y += y;
  showView();
}

function resetView() {
  Object.assign(view, { scale: 1, x: 0, y: 0 });
  showView();
}

function placeIn(pane, event) {
  const box = pane.getBoundingClientRect();
  return { x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height };
}

const kKeys = {
  "+": () => zoomAt(1.4, 0.5, 0.5), "=": () => zoomAt(1.4, 0.5, 0.5), "-": () => zoomAt(1 / 1.4, 0.5, 0.5), "0": resetView,
  ArrowLeft: () => moveBy(0.1, 0), ArrowRight: () => moveBy(-0.1, 0), ArrowUp: () => moveBy(0, 0.1), ArrowDown: () => moveBy(0, -0.1)
};

/// Fingers and buttons that are down on a pane: one drags, two pinch.
function followPointers(pane) {
  const down = new Map();
  const middle = () => {
    const all = [...down.values()];
    const x = all.reduce((sum, p) => sum + p.x, 0) / all.length;
    const y = all.reduce((sum, p) => sum + p.y, 0) / all.length;
    return { x, y, apart: all.length < 2 ? 0 : Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y) };
  };
  pane.addEventListener("pointerdown", (event) => {
    if (event.button === 0) {
      down.set(event.pointerId, placeIn(pane, event));
      pane.setPointerCapture(event.pointerId);
    }
  });
  pane.addEventListener("pointermove", (event) => {
    if (!down.has(event.pointerId)) {
      return;
    }
    const before = middle();
    down.set(event.pointerId, placeIn(pane, event));
    const now = middle();
    if (before.apart > 0 && now.apart > 0) {
      zoomAt(now.apart / before.apart, before.x, before.y);
    }
    moveBy(now.x - before.x, now.y - before.y);
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
    pane.addEventListener(end, (event) => down.delete(event.pointerId));
  }
}

/// Makes an element one of the panes. A wheel that nobody gave to a pane by a click scrolls the page.
function addPane(pane) {
  panes.add(pane);
  pane.tabIndex = 0;
  pane.addEventListener("wheel", (event) => {
    const meant = event.ctrlKey || event.metaKey || pane.contains(document.activeElement) || view.scale > 1;
    if (!meant || (view.scale === 1 && event.deltaY > 0 && !event.ctrlKey)) {
      return;
    }
    event.preventDefault();
    const place = placeIn(pane, event);
    zoomAt(Math.exp(-event.deltaY * (event.deltaMode === 0 ? 0.0016 : 0.05)), place.x, place.y);
  }, { passive: false });
  pane.addEventListener("dblclick", (event) => {
    const place = placeIn(pane, event);
    zoomAt(2, place.x, place.y);
  });
  pane.addEventListener("keydown", (event) => {
    const does = event.ctrlKey || event.metaKey || event.altKey ? undefined : kKeys[event.key];
    if (does && event.target === pane && (view.scale > 1 || !event.key.startsWith("Arrow"))) {
      event.preventDefault();
      does();
    }
  });
  followPointers(pane);
  return pane;
}

function zoomButtons() {
  const scale = el("output", { "aria-label": "Zoom" });
  viewWatchers.push(() => { scale.textContent = `${view.scale < 10 ? view.scale.toFixed(1) : view.scale.toFixed(0)}\u00d7`; });
  const button = (label, text, onclick) => el("button", { type: "button", "aria-label": label, title: label, onclick }, text);
  return el("span", { class: "zoom", role: "group", "aria-label": "Zoom of all pictures" },
    button("Zoom out", "\u2212", () => zoomAt(1 / 1.6, 0.5, 0.5)), scale,
    button("Zoom in", "+", () => zoomAt(1.6, 0.5, 0.5)), button("Whole picture", "Fit", resetView));
}

// Pictures, decoded once; the oldest are forgotten.
const decoded = new Map();
const kMostDecoded = 40;

function decode(uri) {
  if (!decoded.has(uri)) {
    const image = new Image();
    image.src = uri;
    decoded.set(uri, image.decode().then(() => image));
    if (decoded.size > kMostDecoded) {
      decoded.delete(decoded.keys().next().value);
    }
  }
  return decoded.get(uri);
}

async function pixelsOf(uri) {
  const image = await decode(uri);
  const canvas = el("canvas", { width: image.naturalWidth, height: image.naturalHeight });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

// sRGB, IEC 61966-2-1.
const kLinear = Float32Array.from({ length: 256 }, (_, i) => (i <= 10 ? i / 255 / 12.92 : ((i / 255 + 0.055) / 1.055) ** 2.4));
const kEncoded = Uint8ClampedArray.from({ length: 4096 }, (_, i) => {
  const v = i / 4095;
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
});

/// The frame as it looks with a mask: between the picture without light and the one with all of it, as light mixes.
async function shadedPixels(frame, mask_uri) {
  const [lit, unlit, mask] = await Promise.all([pixelsOf(frame.lit), pixelsOf(frame.unlit), pixelsOf(mask_uri)]);
  const out = new ImageData(lit.width, lit.height);
  for (let i = 0; i < out.data.length; i += 4) {
    const share = mask.data[i] / 255;
    for (let c = i; c < i + 3; ++c) {
      const dark = kLinear[unlit.data[c]];
      out.data[c] = kEncoded[Math.round(4095 * (dark + (kLinear[lit.data[c]] - dark) * share))];
    }
    out.data[i + 3] = 255;
  }
  return out;
}

/// Shows a mask in a canvas, as it is or as the light that it lets through. The last call's mask stays.
async function showMask(canvas, frame, mask_uri, shaded) {
  const wanted = Symbol("picture");
  canvas.wanted = wanted;
  const pixels = shaded ? await shadedPixels(frame, mask_uri) : await pixelsOf(mask_uri);
  if (canvas.wanted !== wanted) {
    return;
  }
  if (canvas.width !== pixels.width || canvas.height !== pixels.height) {
    canvas.width = pixels.width;
    canvas.height = pixels.height;
  }
  canvas.getContext("2d").putImageData(pixels, 0, 0);
  canvas.dataset.shows = "yes";
  showView();
}
