// SPDX-License-Identifier: Apache-2.0
// Puts the pictures and charts of a report into its page.
"use strict";

function fill(id, ...elements) {
  document.getElementById(id)?.replaceWith(...elements.filter(Boolean));
}

function chartSection(title, boxes) {
  const shown = boxes.filter(Boolean);
  return shown.length === 0 ? null : el("section", { "aria-label": title }, el("h2", null, title), el("div", { class: "charts" }, ...shown));
}

function fillCompare() {
  fill("look", el("div", { class: "first" }, viewer(), el("div", { class: "winners" }, ...winners(), chosenCard())));
  fill("panes", pictures());
  const boxes = [scatter(), classBars("Where the error comes from", data.names, result.results.map((one) => one.error))];
  fill("charts", chartSection("All techniques", [...boxes, ...(result.path ? pathCharts() : [])]));
  const table = document.getElementById("techniques");
  for (const point of paretoFront(pointsOfTechniques())) {
    table.tBodies[0].rows[point.index].classList.add("front");
  }
  enliven(table, result.results.map((one) => one.command));
}

/// The least error of all, and where.
function sweepCard() {
  let best = null;
  result.sweep.results.forEach((line, i) => line.rmse.forEach((rmse, k) => {
    if (Number.isFinite(rmse) && (!best || rmse < best.rmse)) {
      best = { rmse, name: data.names[i], value: result.sweep.values[k] };
    }
  }));
  return best && el("div", { class: "card panel first-prize" }, el("span", { class: "what" }, "Nearest to the truth"), el("span", { class: "who" }, best.name),
    el("span", { class: "how" }, `rmse ${number(best.rmse, 4)} at ${result.sweep.key} ${best.value}`));
}

function fillSweep() {
  const frame = frames[0];
  const canvas = el("canvas", { role: "img", "aria-label": "The frame with the truth's shadows" });
  const shown = el("figure", { class: "panel" }, addPane(el("div", { class: "pane" }, el("div", { class: "layer" }, canvas))),
    el("figcaption", null, el("b", null, "The frame"), el("span", null, "With the shadows of the truth.")));
  shown.querySelector(".pane").style.aspectRatio = `${result.size_px[0]} / ${result.size_px[1]}`;
  fill("look", el("div", { class: "first" }, sweepChart(), el("div", { class: "winners" }, sweepCard(), frame ? shown : null)));
  if (frame) {
    showMask(canvas, frame, frame.truth, true);
  }
  fill("panes");
  fill("charts", chartSection("Every technique by itself", sweepClassCharts()));
  enliven(document.getElementById("techniques"), result.sweep.results.flatMap((line) => line.commands));
}

function fillBench() {
  fill("look", benchCards());
  fill("charts", chartSection("Passes", [passBars(), keptBars()]));
  enliven(document.getElementById("techniques"), result.results.map((one) => one.command));
  enliven(document.getElementById("passes"), null);
}

function fillScenes() {
  fill("charts", chartSection("All scenes", [sceneBars(), sceneClasses()]));
  [...result.scenes.map((one) => one.name), "mean"].forEach((name) => kBestIsLeast.add(name));
  enliven(document.getElementById("techniques"), null);
}

({ compare: fillCompare, sweep: fillSweep, bench: fillBench, scenes: fillScenes })[document.body.dataset.kind]();
if (panes.size > 0) {
  showView();
}
drawCharts();
