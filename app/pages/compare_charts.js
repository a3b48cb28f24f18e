// SPDX-License-Identifier: Apache-2.0
// Charts of a comparison: error against time, classes of the error, frames of a path, values of a sweep.
"use strict";

function scatter() {
  const points = pointsOfTechniques().filter((p) => Number.isFinite(p.time) && Number.isFinite(p.error));
  if (points.length === 0) {
    return null;
  }
  const front = paretoFront(points);
  const rest = points.filter((p) => !front.includes(p));
  const times = points.map((p) => p.time);
  const logarithmic = Math.max(...times) > 5 * Math.min(...times) && Math.min(...times) > 0;
  const place = (p, label) => ({ x: p.time, y: p.error, index: p.index, label });
  const config = () => ({
    type: "scatter",
    data: { datasets: [
      { label: "Pareto front", data: front.map((p, i) => place(p, String(i + 1))), showLine: true, stepped: "before", borderColor: colour("accent"),
        borderWidth: 2, borderDash: [5, 4], backgroundColor: colour("accent"), pointRadius: 9, pointHoverRadius: 12 },
      { label: "another is nearer and faster", data: rest.map((p) => place(p)), borderColor: colour("faint"),
        backgroundColor: translucent(colour("faint"), 0.35), pointRadius: 5, pointHoverRadius: 8 },
      { label: "chosen", data: points.filter((p) => p.index === chosen.technique).map((p) => place(p)), borderColor: colour("ink"), borderWidth: 2.5,
        backgroundColor: "transparent", pointRadius: 13, pointHoverRadius: 13 }] },
    options: {
      scales: {
        x: axis("median frame, milliseconds", logarithmic ? { type: "logarithmic", min: Math.min(...times) / 1.15, max: Math.max(...times) * 1.15, ticks: { callback: fewTicks, maxRotation: 0 } } : { beginAtZero: true }),
        y: axis("rmse: distance from the truth", { grace: "12%" })
      },
      plugins: { legend: { position: "bottom", labels: { usePointStyle: true } },
        tooltip: { callbacks: { label: (item) => `${data.names[item.raw.index]}: rmse ${number(item.raw.y, 4)}, ${ms(item.raw.x)}` } } },
      onClick: (_, hits, chart) => {
        if (hits.length > 0) {
          choose({ technique: chart.data.datasets[hits[0].datasetIndex].data[hits[0].index].index });
        }
      }
    },
    plugins: [pointLabels]
  });
  const box = chartPanel({ title: "Error against time", height: 400,
    note: "Down is nearer to the truth, left is faster. Of the techniques on the front none is beaten in both.",
    label: `Error against time of ${points.length} techniques. On the Pareto front, fastest first: ${front.map((p) => p.name).join(", ")}. The table has all numbers.` }, config);
  box.append(frontList(front));
  whenChosen(() => {
    if (box.entry.chart) {
      box.entry.chart.data.datasets[2].data = points.filter((p) => p.index === chosen.technique).map((p) => place(p));
      box.entry.chart.update();
    }
  });
  return box;
}

/// The names of the points that have a number, each a way to choose it.
function frontList(front) {
  return el("ol", { class: "front-list" }, ...front.map((p) => {
    const button = el("button", { type: "button", onclick: () => choose({ technique: p.index }) }, nameParts(p.name));
    whenChosen(() => button.setAttribute("aria-pressed", String(chosen.technique === p.index)));
    return el("li", null, button, el("span", null, `${number(p.error, 4)} in ${ms(p.time)}`));
  }));
}

/// A bar for each name, made of the classes of `errors`. As mean squares, which add up to the square of rmse, or shares.
function classBars(title, names, errors) {
  if (!errors.some((error) => Number.isFinite(error?.rmse))) {
    return null;
  }
  let shares = false;
  const values = (name) => errors.map((error) => {
    const total = kClasses.reduce((sum, one) => sum + (error?.[one] ?? NaN), 0);
    return shares ? (total > 0 ? (100 * error[name]) / total : 0) : (error?.[name] ?? 0);
  });
  const config = () => ({
    type: "bar",
    data: { labels: names, datasets: kClasses.map((name) => ({ label: name, data: values(name), backgroundColor: data.legends.classes[name],
      borderColor: translucent(colour("ink"), 0.35), borderWidth: 0.5 })) },
    options: {
      indexAxis: "y",
      scales: {
        x: axis(shares ? "per cent of the squared error" : "mean squared error", { stacked: true, max: shares ? 100 : undefined, ticks: { callback: shortNumber, maxRotation: 0 } }),
        y: { stacked: true, grid: { display: false }, ticks: rowTicks() }
      },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } },
        tooltip: { mode: "index", callbacks: { label: (item) => `${item.dataset.label}: ${shares ? `${number(item.raw, 1)} %` : item.raw.toExponential(2)}` } } },
      onClick: (_, hits) => {
        if (hits.length > 0 && names === data.names) {
          choose({ technique: hits[0].index });
        }
      }
    }
  });
  const box = chartPanel({ title, height: Math.max(220, 90 + 22 * names.length), note: null,
    label: `Classes of the error of ${names.length} rows: edge, acne, detached, bleeding, terminator. The table has their shares.` }, config);
  box.querySelector("h3").after(choice(`amount-${charts.length}`, "Amount or share", [[false, "Amount"], [true, "Share"]], false, (wanted) => {
    shares = wanted;
    drawChart(box.entry);
  }));
  return box;
}

/// Lines over x, of which a click on a name takes one away.
function lines({ title, note, label, height, wide }, { x, x_axis, y_title, series }) {
  return chartPanel({ title, note, label, height, wide }, () => ({
    type: "line",
    data: { labels: x, datasets: series.map((one, i) => ({ label: one.name, data: one.values.map((value, k) => ({ x: x[k], y: value })),
      spanGaps: false, ...seriesLook(i), ...(x.length > 40 ? { pointRadius: 0 } : {}), ...(one.look || {}) })) },
    options: {
      interaction: { mode: "index", intersect: false },
      scales: { x: { type: "linear", ...x_axis() }, y: axis(y_title, { beginAtZero: true }) },
      plugins: { legend: { position: "bottom", labels: { usePointStyle: true } },
        tooltip: { itemSort: (a, b) => b.raw.y - a.raw.y, callbacks: { label: (item) => `${item.dataset.label}: ${number(item.raw.y, 4)}` } } }
    }
  }));
}

function pathCharts() {
  const { first, last } = result.path.frames;
  const x = Array.from({ length: last - first + 1 }, (_, i) => first + i);
  const series = (key) => result.results.map((one, i) => ({ name: data.names[i], values: one.over_frames[key] }));
  const x_axis = () => axis("frame", { min: first, max: last, ticks: { precision: 0 } });
  const about = `${data.names.length} techniques over frames ${first} to ${last}`;
  const error = lines({ title: "Error over the frames", height: 380, wide: true, note: null, label: `Error of ${about}.` },
    { x, x_axis, y_title: "rmse", series: series("rmse") });
  return first === last ? [error] : [error, lines({ title: "Steadiness over the frames", height: 380, wide: true,
    note: "How much the error changes from one frame to the next, at the same points: level is steady, peaks are pops.", label: `Change of the error of ${about}.` },
    { x, x_axis, y_title: "mean change of the error", series: series("mean_abs_change") })];
}

function sweepAxis() {
  const sweep = result.sweep;
  const more = sweep.logarithmic ? { type: "logarithmic", ticks: { callback: (value) => (sweep.values.length > 12 ? fewTicks(value) : String(value)) } } : {};
  if (sweep.logarithmic && sweep.values.length <= 12) {
    more.afterBuildTicks = (scale) => { scale.ticks = [...sweep.values].sort((a, b) => a - b).map((value) => ({ value })); };
  }
  return { ...axis(sweep.key + (sweep.unit ? ` (${sweep.unit})` : ""), {}), min: Math.min(...sweep.values), max: Math.max(...sweep.values), ...more };
}

function sweepChart() {
  const sweep = result.sweep;
  return lines({ title: `Error over ${sweep.key}`, height: 460, note: "The distance from the truth at every value. A click on a name takes its line away.",
    label: `Error of ${data.names.length} techniques over ${sweep.key}. The table has all numbers.` },
    { x: sweep.values, x_axis: sweepAxis, y_title: "rmse", series: sweep.results.map((line, i) => ({ name: data.names[i], values: line.rmse })) });
}

/// Where the error of each technique comes from at each value: roots, so that they are on rmse's scale.
function sweepClassCharts() {
  const sweep = result.sweep;
  return sweep.results.map((line, i) => lines({ title: `${data.names[i]}: where its error comes from`, note: null, height: 340,
    label: `Classes of the error of ${data.names[i]} over ${sweep.key}.` }, { x: sweep.values, x_axis: sweepAxis, y_title: "root of the mean squared error",
    series: [{ name: "all", values: line.rmse, look: { borderWidth: 8, pointRadius: 0, borderColor: translucent(colour("faint"), 0.4), backgroundColor: translucent(colour("faint"), 0.4) } },
      ...kClasses.map((name) => ({ name, values: line[name].map((value) => (value === null ? null : Math.sqrt(value))),
        look: { borderColor: data.legends.classes[name], backgroundColor: data.legends.classes[name], pointBorderColor: colour("ink"), pointBorderWidth: 0.6, borderDash: [] } }))] }));
}

/// A group of bars for each technique, a bar for each scene.
function sceneBars() {
  const names = data.names;
  const scenes = result.scenes.map((one) => one.name);
  return chartPanel({ title: "Error in every scene", height: Math.max(260, 90 + names.length * (14 * scenes.length + 10)), wide: true,
    note: "The techniques with the least mean first. A click on a scene takes its bars away.",
    label: `Error of ${names.length} techniques in ${scenes.join(", ")}. The table has all numbers.` }, () => ({
    type: "bar",
    data: { labels: names, datasets: scenes.map((scene, k) => ({ label: scene, data: result.techniques.map((one) => one.rmse[k]),
      ...seriesLook(k), borderWidth: 0, borderDash: [] })) },
    options: {
      indexAxis: "y",
      scales: { x: axis("rmse: distance from the truth", { beginAtZero: true }), y: { grid: { display: false }, ticks: rowTicks() } },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } },
        tooltip: { mode: "index", callbacks: { label: (item) => `${item.dataset.label}: ${number(item.raw, 4)}` } } },
      onClick: (_, hits) => {
        if (hits.length > 0) {
          choose({ technique: hits[0].index });
        }
      }
    }
  }));
}

/// Where the error of the chosen technique comes from in each scene.
function sceneClasses() {
  const errors = result.scenes.map(() => null);
  const find = () => result.scenes.forEach((scene, k) => {
    const technique = result.techniques[chosen.technique].technique;
    errors[k] = scene.result.results.find((one) => one.technique === technique)?.error ?? null;
  });
  find();
  const box = classBars("Where the error comes from", result.scenes.map((one) => one.name), errors);
  const name = el("p");
  box?.querySelector("h3").after(name);
  whenChosen(() => {
    find();
    name.replaceChildren("Of ", nameParts(data.names[chosen.technique]), ". A row of the table chooses another technique.");
    if (box?.entry.chart) {
      drawChart(box.entry);
    }
  });
  return box;
}
