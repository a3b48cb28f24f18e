// SPDX-License-Identifier: Apache-2.0
// Charts of a bench: where a frame's time goes, beside the frame without shadows.
"use strict";

function benchRows() {
  return [{ name: "no shadows", one: result.baseline }, ...result.results.map((one, i) => ({ name: data.names[i], one }))];
}

/// Passes by name, in the order in which frames have them; what of a frame no pass explains comes last.
function passNames(rows) {
  const names = [];
  for (const { one } of rows) {
    one.passes.forEach((pass, i) => {
      if (!names.includes(pass.name)) {
        const before = one.passes.slice(0, i).map((other) => other.name).reverse().find((name) => names.includes(name));
        names.splice(before === undefined ? 0 : names.indexOf(before) + 1, 0, pass.name);
      }
    });
  }
  return names;
}

function passBars() {
  const rows = benchRows();
  const names = passNames(rows);
  const of = (one, name) => one.passes.filter((pass) => pass.name === name).reduce((sum, pass) => sum + (pass.ms ?? 0), 0);
  const outside = (one) => Math.max(0, (one.time_ms.frame ?? 0) - one.passes.reduce((sum, pass) => sum + (pass.ms ?? 0), 0));
  const config = () => {
    const sets = names.map((name, i) => ({ label: name, data: rows.map(({ one }) => of(one, name)),
      backgroundColor: i < 7 ? colour(`series-${i + 1}`) : translucent(colour(`series-${(i % 7) + 1}`), i < 14 ? 0.6 : 0.3) }));
    sets.push({ label: "outside of passes", data: rows.map(({ one }) => outside(one)), backgroundColor: translucent(colour("faint"), 0.3) });
    return {
      type: "bar", data: { labels: rows.map((row) => row.name), datasets: sets },
      options: {
        indexAxis: "y",
        scales: { x: axis("median milliseconds of a frame", { stacked: true, beginAtZero: true }),
          y: { stacked: true, grid: { display: false }, ticks: rowTicks() } },
        plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } },
          tooltip: { mode: "index", filter: (item) => item.raw > 0, callbacks: { label: (item) => `${item.dataset.label}: ${number(item.raw, 3)} ms` } } },
        onClick: (_, hits) => {
          if (hits.length > 0 && hits[0].index > 0) {
            choose({ technique: hits[0].index - 1 });
          }
        }
      }
    };
  };
  return chartPanel({ title: "Where a frame\u2019s time goes", wide: true, height: 130 + 34 * rows.length, note: ["Every map drawn anew in every frame; the first bar is the frame without shadows.", ...(result.not_measured ?? [])].join(" "),
    label: `Passes of ${rows.length} frames, stacked. The tables have all numbers.` }, config);
}

/// The same frames when maps, and then masks too, are kept while they hold.
function keptBars() {
  const ways = [["all drawn anew", "frame_ratio"], ["maps kept while they hold", "static_frame_ratio"], ["masks kept, too", "still_frame_ratio"]]
    .filter(([, key]) => result.results.some((one) => Number.isFinite(one[key])));
  return chartPanel({ title: "What keeping maps saves", wide: true, height: 140 + 40 * data.names.length, note: "Median frame divided by the frame without shadows; 1 costs nothing.",
    label: "Ratio of each technique's frame to the frame without shadows, with maps drawn anew and kept. The table has all numbers." }, () => ({
    type: "bar",
    data: { labels: data.names, datasets: ways.map(([label, key], i) => ({ label, data: result.results.map((one) => one[key]), backgroundColor: colour(`series-${i + 1}`) })) },
    options: { indexAxis: "y", scales: { x: axis("times the frame without shadows", { beginAtZero: true }), y: { grid: { display: false }, ticks: rowTicks() } },
      plugins: { legend: { position: "bottom", labels: { boxWidth: 14 } } } }
  }));
}

/// The fastest technique, the frame without shadows, and the command of the one that is chosen.
function benchCards() {
  const times = result.results.map((one) => one.time_ms.frame ?? NaN);
  const fastest = least(times);
  const box = el("div", { class: "card panel", "aria-live": "polite", id: "chosen" });
  whenChosen(() => {
    const one = result.results[chosen.technique];
    box.replaceChildren(el("span", { class: "what" }, "Chosen"), el("span", { class: "who" }, nameParts(data.names[chosen.technique])),
      el("span", { class: "how" }, `${ms(one.time_ms.frame ?? NaN)}, interquartile range ${ms(one.iqr_ms.frame ?? NaN)}, ${number(one.frame_ratio ?? NaN, 2)} \u00d7 without shadows`),
      commandBox(one.command));
  });
  return el("div", { class: "winners across" },
    fastest < 0 ? null : card("Fastest", fastest, `${ms(times[fastest])}, ${number(result.results[fastest].frame_ratio ?? NaN, 2)} \u00d7 without shadows`, true),
    el("div", { class: "card panel" }, el("span", { class: "what" }, "The frame without shadows"), el("span", { class: "who" }, ms(result.baseline.time_ms.frame ?? NaN)),
      el("span", { class: "how" }, `interquartile range ${ms(result.baseline.iqr_ms.frame ?? NaN)}`)), box);
}
