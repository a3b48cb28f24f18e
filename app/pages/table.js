// SPDX-License-Identifier: Apache-2.0
// Tables that sort by a column, show the rows that one asks for, and choose a technique by its row.
"use strict";

const kComparison = /^(.+?)(<=|>=|<|>|=)(-?[0-9.]+)$/;

function cellNumber(text) {
  return /^[+-]?\d/.test(text) ? Number(text) : NaN;
}

function cellTexts(row) {
  return [...row.cells].filter((cell) => !cell.classList.contains("act")).map((cell) => (cell.dataset.text ?? cell.textContent).trim());
}

/// Words that a row must have, and comparisons such as ms<20 of its numbers. A column that there is not never holds.
function matcher(query, columns) {
  const tests = query.trim().toLowerCase().split(/\s+/).filter(Boolean).map((word) => {
    const parts = kComparison.exec(word);
    const column = parts ? columns.findIndex((name) => name.toLowerCase() === parts[1]) : -1;
    if (column < 0) {
      return (texts) => texts.some((text) => text.toLowerCase().includes(word));
    }
    const bound = Number(parts[3]);
    return (texts) => {
      const value = cellNumber(texts[column]);
      return { "<": value < bound, ">": value > bound, "<=": value <= bound, ">=": value >= bound, "=": value === bound }[parts[2]];
    };
  });
  return (texts) => tests.every((test) => test(texts));
}

/// Numbers by size, what has none last, in both directions; texts by the alphabet.
function compareTexts(a, b, ascending) {
  const [x, y] = [cellNumber(a), cellNumber(b)];
  if (Number.isNaN(x) !== Number.isNaN(y)) {
    return Number.isNaN(x) ? 1 : -1;
  }
  const order = Number.isNaN(x) ? a.localeCompare(b) : x - y;
  return ascending ? order : -order;
}

function sortBy(table, column, ascending) {
  const body = table.tBodies[0];
  const rows = [...body.rows];
  const before = new Map(rows.map((row) => [row, Number(row.dataset.row)]));
  rows.sort((a, b) => compareTexts(cellTexts(a)[column], cellTexts(b)[column], ascending) || before.get(a) - before.get(b));
  body.append(...rows);
  [...table.tHead.rows[0].cells].forEach((head, i) => {
    if (i === column) {
      head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
    } else {
      head.removeAttribute("aria-sort");
    }
  });
}

/// As they came.
function sortBack(table) {
  const body = table.tBodies[0];
  body.append(...[...body.rows].sort((a, b) => Number(a.dataset.row) - Number(b.dataset.row)));
  [...table.tHead.rows[0].cells].forEach((head) => head.removeAttribute("aria-sort"));
}

/// The next click on a column's name turns it round. A larger ssim is the better one, so it begins with the largest.
function sortFrom(table, column, name) {
  const now = table.tHead.rows[0].cells[column].getAttribute("aria-sort");
  sortBy(table, column, now ? now === "descending" : name !== "ssim");
}

const kBestIsLeast = new Set(["rmse", "shimmer", "pop", "mae", "flip", "ratio", "ms", "MiB", "equal", "frame", "static ratio", "still ratio"]);

/// Marks the best number of each column whose best one is known.
function markBest(table, columns) {
  const rows = [...table.tBodies[0].rows].filter((row) => row.dataset.baseline === undefined);
  columns.forEach((name, column) => {
    const value = { ssim: (v) => -v, bias: Math.abs }[name] ?? (kBestIsLeast.has(name) ? (v) => v : null);
    if (!value || rows.length < 2) {
      return;
    }
    const values = rows.map((row) => value(cellNumber(cellTexts(row)[column])));
    const best = Math.min(...values.filter((v) => !Number.isNaN(v)));
    rows.forEach((row, i) => row.cells[column].classList.toggle("best", values[i] === best));
  });
}

/// A row's name becomes a button that chooses it; a click elsewhere in the row does, too.
function makePickable(table) {
  for (const row of table.tBodies[0].rows) {
    const index = Number(row.dataset.row);
    if (index >= data.names.length) {
      row.dataset.baseline = "yes";
      continue;
    }
    const head = row.cells[0];
    const name = head.textContent;
    head.dataset.text = name;
    head.replaceChildren(el("button", { type: "button", "aria-label": `Show ${name}` }, nameParts(name)));
    row.addEventListener("click", () => choose({ technique: index }));
    whenChosen(() => {
      const picked = chosen.technique === index;
      row.toggleAttribute("data-picked", picked);
      head.firstChild.setAttribute("aria-pressed", String(picked));
    });
  }
}

/// A last column with the command of each row.
function addCommands(table, commands) {
  table.tHead.rows[0].append(el("th", { role: "columnheader", scope: "col", class: "act" }, el("span", { class: "unseen" }, "command")));
  for (const row of table.tBodies[0].rows) {
    const command = commands[Number(row.dataset.row)];
    const cell = el("td", { role: "cell", class: "act" });
    if (command) {
      const button = copyButton(() => command, "Copy command", `Copy the command that repeats ${cellTexts(row)[0]}`);
      button.title = command;
      cell.append(button);
    }
    row.append(cell);
  }
}

/// Puts the tools of a table above it. `commands`: one for each row, or none at all.
function enliven(table, commands) {
  const heads = [...table.tHead.rows[0].cells];
  const columns = heads.map((head) => head.textContent);
  if (table.dataset.picks) {
    makePickable(table);
  }
  markBest(table, columns);
  if (commands) {
    addCommands(table, commands);
  }
  heads.forEach((head, column) => {
    const button = el("button", { type: "button", onclick: () => sortFrom(table, column, columns[column]) }, columns[column]);
    if (head.title) {
      button.title = head.title;
    }
    head.replaceChildren(button);
  });
  const count = el("span", { class: "count", role: "status" });
  const search = el("input", { type: "search", placeholder: `Filter: pcf ${columns.includes("ms") ? "ms<20" : columns[1] + "<20"}`,
    "aria-label": "Show rows with these words, or numbers such as rmse<0.1" });
  const front = el("input", { type: "checkbox" });
  const has_front = table.querySelector("tr.front") !== null;
  const filter = () => {
    const holds = matcher(search.value, columns);
    const rows = [...table.tBodies[0].rows];
    rows.forEach((row) => { row.hidden = !holds(cellTexts(row)) || (front.checked && !row.classList.contains("front")); });
    const shown = rows.filter((row) => !row.hidden).length;
    count.textContent = shown === rows.length ? `${rows.length} rows` : `${shown} of ${rows.length} rows`;
  };
  search.addEventListener("input", filter);
  front.addEventListener("change", filter);
  const by = el("select", { "aria-label": "Sort by", onchange: () => {
    sortBack(table);
    if (by.value !== "") {
      sortFrom(table, Number(by.value), columns[by.value]);
    }
  } }, el("option", { value: "" }, "as they came"), ...columns.map((name, i) => el("option", { value: String(i) }, `sort by ${name}`)));
  table.closest(".table-frame").before(el("div", { class: "tools" }, search,
    has_front ? el("label", null, front, "only the front") : null, el("span", { class: "by" }, by), count));
  filter();
}
