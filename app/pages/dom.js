// SPDX-License-Identifier: Apache-2.0
// Shared by all scripts of a report's page: its data, elements, numbers, and the choices made.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const frames = JSON.parse(document.getElementById("pictures").textContent) || [];
const result = data.result;

/// An element; children and values are texts, never HTML. "on..." are listeners; null, undefined and false: none.
function el(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (name.startsWith("on")) {
      element.addEventListener(name.slice(2), value);
    } else if (value !== null && value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? "" : value);
    }
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

function number(value, decimals) {
  return Number.isFinite(value) ? value.toFixed(decimals) : "\u2013";
}

/// Milliseconds as text, with only as many digits as are meaningful.
function ms(value) {
  return Number.isFinite(value) ? (value < 10 ? value.toFixed(2) : value < 100 ? value.toFixed(1) : value.toFixed(0)) + " ms" : "\u2013";
}

const chosen = { technique: 0, against: -1, frame: 0, shaded: true }; // against -1: the truth
const watchers = [];

/// Calls `watcher` now and whenever what is chosen has changed.
function whenChosen(watcher) {
  watchers.push(watcher);
  watcher();
}

function choose(what) {
  Object.assign(chosen, what);
  watchers.forEach((watcher) => watcher());
}

/// A row of radio buttons that looks like one switch. `options`: [value, text] each.
function choice(name, label, options, value, onchange) {
  const group = el("fieldset", { class: "choice" }, el("legend", { class: "unseen" }, label));
  for (const [one, text] of options) {
    const input = el("input", { type: "radio", name, value: String(one), onchange: () => onchange(one) });
    input.checked = one === value;
    group.append(el("label", null, input, text));
  }
  return group;
}

/// Puts text where the user can paste it from. Pages of files need not have the newer way.
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = el("textarea", { class: "unseen", readonly: true });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

function copyButton(textNow, text, label) {
  const button = el("button", { type: "button", class: "copy", "aria-label": label || null }, text);
  button.addEventListener("click", async (event) => {
    event.stopPropagation();
    const done = await copyText(textNow());
    button.textContent = done ? "Copied" : "Not copied";
    button.classList.toggle("done", done);
    setTimeout(() => {
      button.textContent = text;
      button.classList.remove("done");
    }, 1600);
  });
  return button;
}

/// A technique's name that breaks between its parts.
function nameParts(name) {
  return el("span", { class: "parts" }, ...name.split("+").map((part, i) => el("span", null, i > 0 ? `+${part}` : part)));
}

/// A command line with its button; each word stays together where it can.
function commandBox(command) {
  const words = command.split(" ").flatMap((word, i) => [i > 0 ? " " : "", el("span", null, word)]);
  return el("div", { class: "command" }, el("code", null, ...words), copyButton(() => command, "Copy command"));
}

/// The techniques that have both numbers and to which no other is at least as good in both and better in one: by time.
function paretoFront(points) {
  const known = points.filter((p) => Number.isFinite(p.time) && Number.isFinite(p.error));
  known.sort((a, b) => a.time - b.time || a.error - b.error);
  const front = [];
  for (const point of known) {
    if (front.length === 0 || point.error < front[front.length - 1].error) {
      front.push(point);
    }
  }
  return front;
}

function pointsOfTechniques() {
  return result.results.map((one, index) => ({
    index, name: data.names[index], time: one.time_ms?.frame ?? NaN, error: one.error?.rmse ?? NaN
  }));
}
