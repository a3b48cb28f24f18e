// SPDX-License-Identifier: Apache-2.0
// The first look: a picture with its slider, who has won, and what is chosen; and below, all pictures of one technique.
"use strict";

const kClasses = ["edge", "acne", "detached", "bleeding", "terminator"];

function nameOf(technique) {
  return technique < 0 ? "truth" : data.names[technique];
}

function maskUri(technique) {
  const frame = frames[chosen.frame];
  return technique < 0 ? frame.truth : frame.techniques[technique].mask;
}

function techniqueSelect(label, key, with_truth) {
  const select = el("select", { onchange: () => choose({ [key]: Number(select.value) }) });
  if (with_truth) {
    select.append(el("option", { value: "-1" }, "ray-traced truth"));
  }
  data.names.forEach((name, i) => select.append(el("option", { value: String(i) }, name)));
  whenChosen(() => { select.value = String(chosen[key]); });
  return el("label", null, label, select);
}

/// A native slider; and the divider in the picture, which can be dragged too.
function slider(stage) {
  const input = el("input", { type: "range", class: "slide", min: "0", max: "100", step: "0.1", value: "50",
    "aria-label": "Divider between the left and the right picture" });
  const show = () => {
    stage.style.setProperty("--split", `${input.value}%`);
    stage.querySelector(".over").style.clipPath = `inset(0 ${100 - Number(input.value)}% 0 0)`;
    input.setAttribute("aria-valuetext", `${Math.round(input.value)} % ${nameOf(chosen.technique)}, the rest ${nameOf(chosen.against)}`);
  };
  input.addEventListener("input", show);
  const divider = el("div", { class: "divider", "aria-hidden": "true" });
  divider.addEventListener("pointerdown", (event) => {
    if (event.isPrimary) { // a second finger is the picture's, to pinch
      event.stopPropagation();
      divider.setPointerCapture(event.pointerId);
    }
  });
  divider.addEventListener("pointermove", (event) => {
    if (divider.hasPointerCapture(event.pointerId)) {
      input.value = String(100 * placeIn(stage, event).x);
      show();
    }
  });
  stage.append(divider);
  whenChosen(show);
  return input;
}

/// The line that shows the masks' values under the pointer.
function readout(stage) {
  const kHint = "Click a picture, then wheel, drag, pinch, or + \u2212 0 and arrow keys: all pictures move together.";
  const line = el("div", { class: "readout" }, kHint);
  let values = null;
  whenChosen(async () => {
    values = null;
    const wanted = [maskUri(chosen.technique), maskUri(chosen.against)];
    const [left, right] = await Promise.all(wanted.map(pixelsOf));
    if (wanted[0] === maskUri(chosen.technique) && wanted[1] === maskUri(chosen.against)) {
      values = { left, right };
    }
  });
  stage.addEventListener("pointermove", (event) => {
    if (!values) {
      return;
    }
    const place = placeIn(stage, event);
    const x = Math.floor(((place.x - view.x) / view.scale) * values.left.width);
    const y = Math.floor(((place.y - view.y) / view.scale) * values.left.height);
    if (x < 0 || y < 0 || x >= values.left.width || y >= values.left.height) {
      return;
    }
    const at = 4 * (y * values.left.width + x);
    const left = values.left.data[at] / 255;
    const right = values.right.data[at] / 255;
    const difference = left - right;
    line.textContent = `pixel ${x}, ${y}: ${nameOf(chosen.technique)} ${left.toFixed(2)}, ${nameOf(chosen.against)} ` +
      `${right.toFixed(2)}, difference ${difference > 0 ? "+" : ""}${difference.toFixed(2)}`;
  });
  stage.addEventListener("pointerleave", () => { line.textContent = kHint; });
  return line;
}

function frameChoice() {
  return frames.length < 2 ? null : choice("frame", "Frame of the path", frames.map((frame, i) => [i, `frame ${frame.frame}`]), 0,
    (frame) => choose({ frame }));
}

function viewer() {
  const left = el("canvas", { "aria-hidden": "true" });
  const right = el("canvas", { "aria-hidden": "true" });
  const tags = [el("span", { class: "tag left" }), el("span", { class: "tag right" })];
  const stage = el("div", { class: "pane stage", role: "group" },
    el("div", { class: "layer" }, right), el("div", { class: "layer over" }, left), ...tags);
  stage.style.aspectRatio = `${result.size_px[0]} / ${result.size_px[1]}`;
  addPane(stage);
  const input = slider(stage);
  whenChosen(() => {
    const frame = frames[chosen.frame];
    showMask(left, frame, maskUri(chosen.technique), chosen.shaded);
    showMask(right, frame, maskUri(chosen.against), chosen.shaded);
    [chosen.technique, chosen.against].forEach((one, i) => { tags[i].replaceChildren(nameParts(nameOf(one))); });
    stage.setAttribute("aria-label", `Shadows of ${nameOf(chosen.technique)} on the left, of ${nameOf(chosen.against)} on the right. ` +
      "Plus and minus zoom, 0 shows all, arrow keys move.");
  });
  const bar = el("div", { class: "bar" }, techniqueSelect("Left", "technique", false), techniqueSelect("Right", "against", true),
    choice("shaded", "What is shown", [[true, "Picture"], [false, "Mask"]], true, (shaded) => choose({ shaded })), frameChoice());
  return el("div", { class: "viewer panel" }, bar, stage, input, el("div", { class: "below" }, readout(stage), zoomButtons()));
}

function card(what, index, how, first_prize) {
  return el("button", { type: "button", class: `card panel${first_prize ? " first-prize" : ""}`, onclick: () => choose({ technique: index }) },
    el("span", { class: "what" }, what), el("span", { class: "who" }, nameParts(data.names[index])), el("span", { class: "how" }, how));
}

function least(values) {
  let best = -1;
  values.forEach((value, i) => {
    if (Number.isFinite(value) && (best < 0 || value < values[best])) {
      best = i;
    }
  });
  return best;
}

function frontCard() {
  const points = pointsOfTechniques();
  const front = paretoFront(points);
  const chips = el("div", { class: "chips" });
  for (const point of front) {
    const chip = el("button", { type: "button", onclick: () => choose({ technique: point.index }) }, nameParts(point.name));
    whenChosen(() => chip.setAttribute("aria-pressed", String(chosen.technique === point.index)));
    chips.append(chip);
  }
  return front.length === 0 ? null : el("div", { class: "card panel" },
    el("span", { class: "what" }, `Worth their time: ${front.length} of ${points.length}. No other is both nearer to the truth and faster.`), chips);
}

function winners() {
  const points = pointsOfTechniques();
  const cards = [];
  const nearest = least(points.map((p) => p.error));
  if (nearest >= 0) {
    cards.push(card("Nearest to the truth", nearest, `rmse ${number(points[nearest].error, 4)} in ${ms(points[nearest].time)}`, true));
  }
  const steadiest = least(result.results.map((one) => one.stability?.shimmer ?? NaN));
  if (steadiest >= 0) {
    cards.push(card("Steadiest along the path", steadiest, `shimmer ${number(result.results[steadiest].stability.shimmer, 4)}`, false));
  }
  const fastest = least(points.map((p) => p.time));
  if (fastest >= 0) {
    cards.push(card("Fastest", fastest, `${ms(points[fastest].time)}, rmse ${number(points[fastest].error, 4)}`, false));
  }
  return [...cards, frontCard()];
}

/// Where the squared error of a technique comes from: shares that add up to 1, or nothing.
function classShares(error) {
  const total = kClasses.reduce((sum, name) => sum + (error?.[name] ?? NaN), 0);
  return total > 0 ? kClasses.map((name) => error[name] / total) : null;
}

function classLegend(shares) {
  return el("ul", { class: "legend" }, ...kClasses.map((name, i) => {
    const swatch = el("i", { "aria-hidden": "true" });
    swatch.style.background = data.legends.classes[name];
    return shares && shares[i] < 0.0005 ? null : el("li", null, swatch, shares ? `${name} ${number(100 * shares[i], 1)} %` : name);
  }));
}

/// The technique that is chosen: its numbers, where its error comes from, and the command that has it again.
function chosenCard() {
  const box = el("div", { class: "card panel", "aria-live": "polite", id: "chosen" });
  whenChosen(() => {
    const one = result.results[chosen.technique];
    const shares = classShares(one.error);
    const bar = el("div", { class: "shares", "aria-hidden": "true" });
    (shares || []).forEach((share, i) => {
      const part = el("span");
      part.style.cssText = `flex: ${share} 0 0; background: ${data.legends.classes[kClasses[i]]}`;
      bar.append(part);
    });
    box.replaceChildren(el("span", { class: "what" }, `Chosen: ${chosen.technique + 1} of ${result.results.length}, best first`),
      el("span", { class: "who" }, nameParts(data.names[chosen.technique])),
      el("span", { class: "how" }, `rmse ${number(one.error?.rmse ?? NaN, 4)}, ${ms(one.time_ms?.frame ?? NaN)}, ${number(one.frame_ratio ?? NaN, 2)} \u00d7 without shadows`),
      shares ? bar : "", shares ? classLegend(shares) : "",
      commandBox(one.command));
  });
  return box;
}

function scaleLegend(colours, ends) {
  const bar = el("span", { class: "scale", "aria-hidden": "true" });
  bar.style.background = `linear-gradient(to right, ${colours.join(", ")})`;
  return el("div", null, bar, el("div", { class: "ends" }, ...ends.map((text) => el("span", null, text))));
}

/// A pane whose picture is the light that the technique's mask lets through.
function shadedPane() {
  const canvas = el("canvas", { "aria-hidden": "true" });
  const pane = addPane(el("div", { class: "pane", role: "group" }, el("div", { class: "layer" }, canvas)));
  pane.style.aspectRatio = `${result.size_px[0]} / ${result.size_px[1]}`;
  whenChosen(() => {
    showMask(canvas, frames[chosen.frame], maskUri(chosen.technique), true);
    pane.setAttribute("aria-label", `Picture with the shadows of ${nameOf(chosen.technique)}`);
  });
  return el("figure", { class: "panel" }, pane, el("figcaption", null, el("b", null, "Picture"),
    el("span", null, "Between the picture without this light and the one with all of it, by the mask.")));
}

/// A pane with its caption; `uri` gives what it shows, or nothing where there is no such picture.
function picture(title, about, legend, uri) {
  const image = el("img", { alt: "", draggable: "false" });
  const pane = addPane(el("div", { class: "pane", role: "group" }, el("div", { class: "layer" }, image)));
  pane.style.aspectRatio = `${result.size_px[0]} / ${result.size_px[1]}`;
  const box = el("figure", { class: "panel" }, pane, el("figcaption", null, el("b", null, title), about ? el("span", null, about) : null, legend));
  image.addEventListener("load", showView);
  whenChosen(() => {
    const shown = uri();
    box.hidden = !shown;
    if (shown) {
      image.src = shown;
      image.alt = `${title} of ${nameOf(chosen.technique)}`;
      pane.setAttribute("aria-label", image.alt);
    }
  });
  return box;
}

function truthPane() {
  return picture("Truth", "Traced with rays. White is lit, black is in shadow.", null, () => frames[chosen.frame].truth);
}

/// All that one technique's pictures show, moved together.
function pictures() {
  const of = (key) => () => frames[chosen.frame].techniques[chosen.technique][key];
  const title = el("h2", { id: "panes-heading" });
  whenChosen(() => { title.replaceChildren("The same place in every picture: ", nameParts(data.names[chosen.technique])); });
  const smaller = frames[0].reduction > 1 ? ` Shown at 1/${frames[0].reduction} of their size, for all would make the page too large: the files beside it have every pixel.` : "";
  return el("section", { "aria-labelledby": "panes-heading" },
    el("div", { class: "heading" }, title, el("p", null, `They zoom and move with the one above.${smaller}`)),
    el("div", { class: "grid" }, shadedPane(), picture("Mask", "White is lit, black is in shadow.", null, of("mask")), truthPane(),
      picture("Error", null, scaleLegend(data.legends.error, ["too dark \u22121", "0", "+1 too bright"]), of("error")),
      picture("Classes of the error", null, classLegend(null), of("classes")),
      picture("Shadow texels per pixel", "A white line passes through 1.", scaleLegend(data.legends.density, ["1/16 blocky", "1", "16 finer than pixels"]),
        () => frames[chosen.frame].densities[frames[chosen.frame].techniques[chosen.technique].density])));
}
