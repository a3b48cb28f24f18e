#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the plots of a comparison from its JSON.

usage: plot.py RESULT.json FOLDER
       plot.py RESULT.json NAME.svg|NAME.png [PLOT]

RESULT.json is what `gnomon compare --json` or a report has. The first form writes every plot that the result has:

- of a --sweep: sweep.svg, the error of every technique over the value, and NN_sweep.svg for each technique, where its error
  comes from (of a single technique, sweep.svg is that);
- of a --path: error.svg and change.svg, the error and how much it changes, over the frames.

The second form writes one of them, PLOT (default: the first). The documents' plots are drawn so
(tools/draw_doc_pictures.py); a report's page draws its own. Needs matplotlib (Debian: python3-matplotlib); exit status 3 without it. The same result gives the same bytes.
"""

import json
import math
import sys
from pathlib import Path

try:
    import matplotlib
    matplotlib.use("svg")
    from matplotlib import pyplot, patheffects, ticker
except ImportError:
    print("plot.py: there is no matplotlib (Debian: python3-matplotlib)", file=sys.stderr)
    sys.exit(3)

# M. Okabe, K. Ito, Color Universal Design, 2002, without their yellow, which vanishes on white. Dashes, markers and
# colours repeat after 4, 5 and 7 lines, so that 140 lines differ, and 20 without colour.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"]
DASHES = ["-", (0, (5, 2.5)), (0, (1.2, 1.6)), (0, (5, 1.8, 1.2, 1.8))]
MARKERS = ["o", "s", "^", "D", "P"]
MOST_MARKERS = 24
STYLE = {
    "svg.hashsalt": "gnomon",  # else element names are random
    "svg.fonttype": "none",    # text stays text
    "font.family": ["DejaVu Sans"],
    "axes.grid": True,
    "grid.color": "#d8d8d8",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "lines.linewidth": 1.6,
    "lines.markersize": 5,
    "axes.titleweight": "bold",
    "text.parse_math": False,
}


def text(words: str) -> str:
    """XML has no place for control characters."""
    return "".join(c if c.isprintable() else "\ufffd" for c in words)


def numbers(values: list, root: bool = False) -> list[float]:
    """null leaves a gap."""
    return [math.nan if v is None else math.sqrt(v) if root else v for v in values]


class Plot:
    def __init__(self, title: str, x_label: str, y_label: str, x: list[float], logarithmic: bool = False):
        self.figure, self.axes = pyplot.subplots(figsize=(9, 5), layout="constrained")
        self.figure.suptitle(text(title), x=0.01, horizontalalignment="left", fontweight="bold")
        self.axes.set_xlabel(x_label)
        self.axes.set_ylabel(y_label)
        self.x = x
        self.count = 0
        if logarithmic:
            self.axes.set_xscale("log")
        low, high = min(x), max(x)
        if low < high:  # gaps too have their place
            margin = (high / low) ** 0.03 if logarithmic else 0.03 * (high - low)
            self.axes.set_xlim(*((low / margin, high * margin) if logarithmic else (low - margin, high + margin)))
        if logarithmic and len(x) <= 12:  # each has its tick
            self.axes.xaxis.set_major_locator(ticker.FixedLocator(x))
            self.axes.xaxis.set_minor_locator(ticker.NullLocator())
        elif logarithmic:
            self.axes.xaxis.set_major_locator(ticker.LogLocator(subs=[1] if high >= 1000 * low else [1, 2, 5]))
        if logarithmic:
            self.axes.xaxis.set_major_formatter(lambda v, _: f"{v:.4g}")
            self.axes.xaxis.set_minor_formatter(ticker.NullFormatter())
        if all(v == int(v) for v in x) and not logarithmic:
            self.axes.xaxis.set_major_locator(ticker.MaxNLocator(integer=True))

    def line(self, name: str, values: list[float], **look) -> None:
        i = self.count
        self.count += 1
        name = text(name)
        every = max(1, len(self.x) // MOST_MARKERS)
        style = {"color": COLOURS[i % len(COLOURS)], "linestyle": DASHES[i % len(DASHES)],
                 "marker": MARKERS[i % len(MARKERS)], "markevery": (i % every, every), **look}
        self.axes.plot(self.x, values, label=name if len(name) <= 44 else name[:43] + "…", **style)

    def save(self, file: Path) -> None:
        self.axes.set_ylim(bottom=0)
        if self.count:
            self.axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize="small", handlelength=4)
        kind = file.suffix.lstrip(".")
        self.figure.savefig(file, format=kind, dpi=110, metadata={"Date": None} if kind == "svg" else None)


def sweep_plot(result: dict, title: str) -> Plot:
    sweep = result["sweep"]
    unit = f" ({sweep['unit']})" if sweep["unit"] else ""
    return Plot(title, sweep["key"] + unit, "root of the mean squared error", sweep["values"], sweep["logarithmic"])


def all_techniques(result: dict) -> Plot:
    plot = sweep_plot(result, f"{result['scene']}: error over {result['sweep']['key']}")
    for line in result["sweep"]["results"]:
        plot.line(line["technique"], numbers(line["rmse"]))
    return plot


def classes_of(result: dict, line: dict) -> Plot:
    """One technique's rmse, a wide pale band, and the root of each class's mean squared error."""
    key = result["sweep"]["key"]
    plot = sweep_plot(result, f"{result['scene']}, {line['technique']}: where the error over {key} comes from")
    plot.line("all (rmse)", numbers(line["rmse"]), color="#c8c8c8", linestyle="-", linewidth=8, marker=None)
    rim = [patheffects.Stroke(linewidth=3.2, foreground="#484848"), patheffects.Normal()]  # yellow vanishes on white
    for name, colour in result["sweep"]["class_colours"].items():
        look = {"linestyle": "-", "path_effects": rim} if name == "detached" else {}
        plot.line(name, numbers(line[name], root=True), color=colour, markeredgecolor="#484848", markeredgewidth=0.6,
                  **look)
    return plot


def over_frames(result: dict, title: str, y_label: str, key: str, start: int) -> Plot:
    frames = result["path"]["frames"]
    plot = Plot(f"{title}: {result['scene']} along {result['path']['name']}", "frame", y_label,
                list(range(frames["first"] + start, frames["last"] + 1)))
    for line in result["results"]:
        plot.line(line["technique"], numbers(line["over_frames"][key])[start:])
    return plot


def plots_of(result: dict) -> dict:
    """How to draw each plot, by the name of its file without the ending."""
    if "sweep" in result:
        lines = result["sweep"]["results"]
        if len(lines) == 1:
            return {"sweep": lambda: classes_of(result, lines[0])}
        ofs = {f"{i:02}_sweep": lambda line=line: classes_of(result, line) for i, line in enumerate(lines, 1)}
        return {"sweep": lambda: all_techniques(result), **ofs}
    if "path" not in result:
        return {}
    plots = {"error": lambda: over_frames(result, "Error", "rmse", "rmse", 0)}
    if result["path"]["frames"]["first"] != result["path"]["frames"]["last"]:
        plots["change"] = lambda: over_frames(result, "Unsteadiness", "mean |D|", "mean_abs_change", 1)
    return plots


def main(arguments: list[str]) -> int:
    if len(arguments) not in (2, 3):
        print(__doc__.split("\n\n")[1], file=sys.stderr)
        return 2
    plots = plots_of(json.loads(Path(arguments[0]).read_text(encoding="utf-8")))
    target = Path(arguments[1])
    if not plots or (len(arguments) == 3 and arguments[2] not in plots):
        print(f"plot.py: {arguments[0]} has "
              + (f"no plot {arguments[2]}; it has {', '.join(plots)}" if plots else
                 "no plots: those of compare --sweep and --path have; error against time is on a report's page"),
              file=sys.stderr)
        return 2
    with matplotlib.rc_context(STYLE):
        if target.suffix in (".svg", ".png"):
            plots[arguments[2] if len(arguments) == 3 else next(iter(plots))]().save(target)
            return 0
        for name, draw in plots.items():
            draw().save(target / f"{name}.svg")
            pyplot.close("all")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
