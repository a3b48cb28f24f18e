#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Python plans by the C interface, with nothing but its standard library: structs and functions are those that a reader of a
few lines finds in the header, so other languages bind it as easily.

usage: test_ctypes.py --library LIBRARY --headers FOLDER
"""

import argparse
import ctypes
import json
import re
import sys
import unittest
from pathlib import Path

OPTIONS = argparse.Namespace()
NUMBERS = {"uint32_t": ctypes.c_uint32, "uint64_t": ctypes.c_uint64, "uint16_t": ctypes.c_uint16, "float": ctypes.c_float,
           "double": ctypes.c_double, "size_t": ctypes.c_size_t, "char": ctypes.c_char, "void": None}


class Binding:
    """The declarations of the headers, for the library."""

    def __init__(self, headers: Path, library: str):
        text = "\n".join((headers / name).read_text(encoding="utf-8") for name in ("gnomon_data.h", "gnomon_commands.h", "gnomon.h"))
        text = re.sub(r"//[^\n]*|^\s*#[^\n]*", "", text, flags=re.MULTILINE)
        self.types, self.values = dict(NUMBERS), {"GNOMON_INTERFACE": 1}
        for name in re.findall(r"typedef struct (\w+) \1;", text):
            self.types[name] = type(name, (ctypes.Structure,), {})  # opaque
        for kind, body, name in re.findall(r"typedef (enum|struct) \w+ \{([^}]*)\} (\w+);", text):
            if kind == "enum":
                self.types[name] = ctypes.c_int
                self.values.update((key, int(value)) for key, value in re.findall(r"(\w+) = (\d+)", body))
            else:
                fields = [self.field(line) for line in body.split(";") if line.strip()]
                self.types[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
        self.library = ctypes.CDLL(library)
        for result, name, parameters in re.findall(r"GNOMON_C_API ([\w\s*]+?)\s*(\w+)\(([^)]*)\)", text):
            function = getattr(self.library, name)
            function.restype = self.kind(result)
            function.argtypes = [self.kind(re.sub(r"\w+$", "", one.strip())) for one in parameters.split(",")
                                 if one.strip() != "void"]
            setattr(self, name, function)

    def kind(self, words: str):
        """The type of a declaration without its name."""
        base, stars = words.replace("const", "").replace("*", "").strip(), words.count("*")
        if stars == 1 and base in ("char", "void"):
            return ctypes.c_char_p if base == "char" else ctypes.c_void_p
        found = self.types[base]
        return ctypes.POINTER(found) if stars else found

    def field(self, line: str) -> tuple:
        words, name, counts = re.match(r"\s*(.*?)(\w+)((?:\[\d+\])*)\s*$", line, re.DOTALL).groups()
        kind = self.kind(words)
        for count in reversed(re.findall(r"\d+", counts)):
            kind = kind * int(count)
        return name, kind

    def init(self, name: str):
        made = self.types[name]()
        assert getattr(self, f"gnomonInit{name.removeprefix('Gnomon')}")(ctypes.byref(made), ctypes.sizeof(made)) == 0, \
            self.gnomonLastError().contents.message
        return made


class Planned(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.gnomon = Binding(OPTIONS.headers, str(OPTIONS.library))

    def setUp(self):
        gnomon = self.gnomon
        self.objects, self.planner = gnomon.gnomonMakeObjects(1), gnomon.gnomonMakePlanner(1)
        self.addCleanup(gnomon.gnomonFreeObjects, self.objects)
        self.addCleanup(gnomon.gnomonFreePlanner, self.planner)
        for low, high in (((-20, -0.1, -20), (20, 0, 20)), ((-1, 0, -1), (1, 2, 1))):
            bounds, name = gnomon.types["GnomonBounds"](low, high), gnomon.types["GnomonObjectId"]()
            self.done(gnomon.gnomonAddObject(self.objects, bounds, None, name))
        for key, value in ((b"filter", b"pcf"), (b"map-size", b"256"), (b"partition", b"cascades")):
            self.done(gnomon.gnomonSetOption(self.planner, 0, key, value))
        self.light, self.frame = gnomon.init("GnomonLight"), gnomon.init("GnomonFrame")
        self.light.direction_ws[:] = (0.6, -0.8, 0.0)
        self.frame.camera.eye_ws[:] = (0, 2, 10)
        self.frame.camera.clip_from_world[:] = (1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1, 0, 2, 0.1, 10)
        self.frame.objects, self.frame.light_count = self.objects, 1
        self.frame.lights = ctypes.pointer(self.light)

    def done(self, status: int) -> None:
        self.assertEqual(status, 0, self.gnomon.gnomonLastError().contents.message)

    def test_structs_are_as_large_as_in_c(self):
        for name in ("GnomonObjectFlags", "GnomonLight", "GnomonFrame", "GnomonPageRequests", "GnomonPrecision"):
            self.assertEqual(self.gnomon.init(name).size, ctypes.sizeof(self.gnomon.types[name]))

    def test_a_plan_is_what_its_json_says(self):
        gnomon = self.gnomon
        plan = gnomon.gnomonPlan(self.planner, ctypes.byref(self.frame))
        self.assertTrue(plan, gnomon.gnomonLastError().contents.message)
        told = json.loads(gnomon.gnomonPlanJson(self.planner))
        self.assertEqual(plan.contents.view_count, 4)
        self.assertEqual(len(told["views"]), 4)
        for index, view in enumerate(told["views"]):
            shown = gnomon.gnomonViewAt(self.planner, index).contents
            rows = [[shown.clip_from_world[4 * column + row] for column in range(4)] for row in range(4)]
            self.assertEqual(rows, view["clip_from_world_rows"])
            self.assertEqual(shown.metric_ws[:], view["metric"]["metric_ws"])
            self.assertEqual([shown.tile_layer, shown.tile_x, shown.tile_width],
                             [view["tile"][key] for key in ("layer", "x", "width")])
            first = shown.first_caster
            self.assertEqual(plan.contents.casters[first:first + shown.caster_count], view["casters"])
            self.assertEqual(shown.layers[7][:], [0.0, 0.0])
        self.assertEqual(gnomon.gnomonLightAt(self.planner, 0).contents.outcome_name, b"ok")
        passes = [gnomon.gnomonPassAt(self.planner, i).contents.name for i in range(plan.contents.pass_count)]
        self.assertEqual(passes, [b"maps", b"mask"])

    def test_a_frame_is_a_list_of_commands(self):
        gnomon = self.gnomon
        self.assertTrue(gnomon.gnomonPlan(self.planner, ctypes.byref(self.frame)))
        recorder = gnomon.gnomonMakeRecorder(1, 256, 256, 0)
        self.addCleanup(gnomon.gnomonFreeRecorder, recorder)
        images = gnomon.gnomonRecordImages(recorder, self.planner, 64, 36)
        self.assertTrue(images, gnomon.gnomonLastError().contents.message)
        first = images.contents.commands[0]
        self.assertEqual((first.kind, first.format, first.size_px[0]), (gnomon.values["GNOMON_MAKE_IMAGE"], b"d32f", 256))
        maps = gnomon.gnomonRecordMaps(recorder, self.planner).contents
        self.assertEqual(maps.maps_drawn, 4)
        mask = gnomon.gnomonRecordMask(recorder, self.planner, 0, None).contents
        last = mask.commands[mask.command_count - 1]
        self.assertEqual((last.kind, last.module, last.viewport[2]), (gnomon.values["GNOMON_DRAW_TRIANGLE"], b"mask_pcf.frag", 64))

    def test_wrong_calls_are_told(self):
        gnomon = self.gnomon
        self.assertEqual(gnomon.gnomonSetOption(self.planner, 0, b"filter", b"fog"), gnomon.values["GNOMON_REFUSED"])
        error = gnomon.gnomonLastError().contents
        self.assertEqual(error.tried, b"setting an option")
        self.assertIn(b'filter: "fog" is not', error.message)
        self.assertFalse(gnomon.gnomonViewAt(self.planner, 3))
        self.assertIn(b"no plan", gnomon.gnomonLastError().contents.message)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for path in ("--library", "--headers"):
        parser.add_argument(path, type=Path, required=True)
    parser.parse_args(namespace=OPTIONS)
    unittest.main(argv=sys.argv[:1])
