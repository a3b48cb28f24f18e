// SPDX-License-Identifier: Apache-2.0
// Charts in the page's colours, by Chart.js.
"use strict";

const charts = []; // {canvas, config, chart}: made anew where the colours change

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function translucent(hex, alpha) {
  return `color-mix(in srgb, ${hex} ${100 * alpha}%, transparent)`;
}

/// The colour of the i-th line; after seven they come again, with other dashes and points.
function seriesLook(i) {
  const shade = colour(`series-${(i % 7) + 1}`);
  return {
    borderColor: shade, backgroundColor: shade, borderWidth: 2, pointRadius: 3, pointHoverRadius: 6,
    borderDash: [[], [8, 4], [2, 3], [8, 3, 2, 3]][Math.floor(i / 7) % 4],
    pointStyle: ["circle", "rect", "triangle", "rectRot"][i % 4]
  };
}

function drawChart(entry) {
  entry.chart?.destroy();
  Chart.defaults.color = colour("faint");
  Chart.defaults.borderColor = colour("line");
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  Chart.defaults.font.size = 12;
  const config = entry.config();
  config.options = { animation: false, responsive: true, maintainAspectRatio: false, ...config.options };
  entry.chart = new Chart(entry.canvas, config);
}

/// A panel with a chart. `config` is asked for whenever colours change; `label` says in words what is seen.
function chartPanel({ title, note, label, height, wide }, config) {
  const canvas = el("canvas", { role: "img", "aria-label": label });
  const frame = el("div", { class: "canvas" }, canvas);
  frame.style.height = `${height}px`;
  const entry = { canvas, config, chart: null };
  charts.push(entry);
  const box = el("div", { class: `chart panel${wide ? " wide" : ""}` }, el("h3", null, title), note ? el("p", null, note) : null, frame);
  box.entry = entry;
  return box;
}

/// Once they are in the page, which gives them their size.
function drawCharts() {
  charts.forEach(drawChart);
  for (const medium of ["(prefers-color-scheme: dark)", "print"]) {
    matchMedia(medium).addEventListener("change", () => charts.forEach(drawChart));
  }
}

/// Labels of a logarithmic axis: 1, 2 and 5 of each power of ten.
function fewTicks(value) {
  const first = Number(Number(value).toExponential()[0]);
  return [1, 2, 5].includes(first) && Math.abs(value / 10 ** Math.floor(Math.log10(value) + 1e-9) - first) < 1e-6 ? String(value) : "";
}

function shortNumber(value) {
  return value !== 0 && Math.abs(value) < 1e-3 ? value.toExponential(0) : String(Number(value.toPrecision(3)));
}

function axis(text, more) {
  return { title: { display: true, text }, grid: { color: colour("line"), borderColor: colour("line") }, ...more };
}

/// Names of rows; of what is too long for the chart, both ends.
function rowTicks() {
  return {
    autoSkip: false, color: colour("ink"),
    callback(value) {
      const name = this.getLabelForValue(value);
      const half = Math.max(8, Math.floor(this.chart.width / 40));
      return name.length > 2 * half + 1 ? `${name.slice(0, half)}\u2026${name.slice(-half)}` : name;
    }
  };
}

/// Writes a point's `label` into it.
const pointLabels = {
  id: "pointLabels",
  afterDatasetsDraw(chart) {
    const context = chart.ctx;
    context.save();
    context.font = `700 11px ${Chart.defaults.font.family}`;
    context.fillStyle = colour("on-accent");
    context.textAlign = "center";
    context.textBaseline = "middle";
    chart.data.datasets.forEach((set, s) => chart.getDatasetMeta(s).data.forEach((point, i) => {
      if (set.data[i].label) {
        context.fillText(set.data[i].label, point.x, point.y + 0.5);
      }
    }));
    context.restore();
  }
};
