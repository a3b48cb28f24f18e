#!/usr/bin/env python3
"""Prints a Markdown table of what Mesa's compiler for AMD makes of the library's main pipelines.

usage: tools/compiled_table.py [--before FILE] [FILE]

FILE is a record of test_compiled (tests/compiled/recorded.json). With --before each cell says what the figure was in an
older record, and what it is now. Columns: vector registers, waves that fit in a SIMD, instructions.
"""
import argparse
import json
import pathlib

RECORD = pathlib.Path(__file__).resolve().parent.parent / "tests" / "compiled" / "recorded.json"
FIGURES = ("VGPRs", "waves", "instructions")
CHIPS = ("NAVI21", "VEGA10")
# One light with one map, and any number of lights and maps; sampling 1 is bilinear, flags are the filter's own.
FILTERS = ("hard", "pcf", "pcss", "raymarch", "esm", "vsm", "evsm", "lvsm", "msm", "id", "depth_id")
OTHERS = ("caster_orthographic.vert to D32", "caster_perspective.vert + caster_depth.frag to D32",
          "vertex of caster_perspective.vert + caster_depth.frag to D32", "depth_blocks.comp", "blur_moments_samples.comp",
          "blur.comp", "mip.comp", "soften.frag to R8", "converge.frag", "mask_spread.frag")


def rows(stages):
    """(label, name of the stage) of each row; the first stage in the order of the file that fits."""
    def first(prefix, *words):
        fitting = [name for name in stages if name.startswith(prefix) and all(word in name for word in words)]
        return min(fitting, key=len, default=None)
    for name in FILTERS:
        for words, label in ((["orthographic 1"], "one sun, one map"), (["orthographic 1", "settles 1"], "what blocks settle"),
                             ([], "one light, one map")):
            yield f"`{name}`, {label}", first(f"mask_{name}.frag to R8", "views 1", *words)
        for words, label in ((["orthographic 1"], "any suns"), ([], "any lights")):
            found = first(f"mask_{name}.frag to RGBA8", *words)
            yield f"`{name}`, {label}", found if name not in ("id", "depth_id") else None
    for name in OTHERS:
        found = name if name in stages else first(name)
        yield f"`{name}`", found


def cell(now, before, index):
    value = now[index] if index < len(now) else 0
    if before is None:
        return str(value)
    old = before[index] if index < len(before) else 0
    return str(value) if old == value else f"{old} → {value}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", default=RECORD, type=pathlib.Path)
    parser.add_argument("--before", type=pathlib.Path)
    arguments = parser.parse_args()
    record = json.loads(arguments.file.read_text())
    older = json.loads(arguments.before.read_text()) if arguments.before else None
    columns = [record["figures"].index(name) for name in FIGURES]
    print("| pipeline |" + "".join(f" {chip} {name} |" for chip in CHIPS for name in FIGURES))
    print("|---|" + "---|" * (len(CHIPS) * len(FIGURES)))
    for label, name in rows(record["stages"]):
        if name is None:
            continue
        line = f"| {label} |"
        for chip in CHIPS:
            now = record["stages"][name][chip]
            before = older["stages"].get(name, {}).get(chip) if older else None
            line += "".join(f" {cell(now, before, column)} |" for column in columns)
        print(line)


if __name__ == "__main__":
    main()
