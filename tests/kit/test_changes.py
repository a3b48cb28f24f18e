#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the kit changes in modules leaves them valid, and does what it says."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "kit"))
import for_wgsl  # noqa: E402
import reflect  # noqa: E402
import spirv  # noqa: E402

READS = """#version 460
layout(constant_id = 0) const int kSize = 2;
layout(constant_id = 1) const bool kSoftware = true;
layout(binding = 1) uniform sampler2D drawn;
layout(binding = 2) uniform usampler2D fetched;
layout(push_constant) uniform Push { vec2 at; };
layout(location = 0) flat in vec4 numbers[3];
layout(location = 0) out vec4 colour;
void main()
{
    float held[2 * kSize + 1];
    held[kSize] = kSoftware ? 1.0 : numbers[1].x;
    colour = textureLod(drawn, at, 0.0) + float(texelFetch(fetched, ivec2(at), 0).x) + held[kSize] + numbers[2];
}
"""
HOLE = """#version 460
layout(push_constant) uniform Push { float a; layout(offset = 16) float b; };
layout(location = 0) out float sum;
void main() { sum = a + b; }
"""
READ_ONLY = """#version 460
layout(binding = 0, std430) readonly buffer In { uint words[]; };
layout(binding = 1, std430) buffer Out { uint sums[]; };
layout(local_size_x = 4, local_size_y = 2) in;
void main() { sums[0] = words[1]; }
"""


class Changes(unittest.TestCase):
    def compiled(self, text: str, stage: str = "frag") -> spirv.Module:
        with tempfile.TemporaryDirectory() as folder:
            made = Path(folder, "a.spv")
            subprocess.run(["glslc", "--target-env=vulkan1.1", "-O0", f"-fshader-stage={stage}", "-o", made, "-"], input=text, text=True, check=True)
            return spirv.Module(made.read_bytes())

    def assert_valid(self, module: spirv.Module) -> None:
        done = subprocess.run(["spirv-val", "--target-env", "vulkan1.1", "-"], input=module.data(), capture_output=True, check=False)
        self.assertEqual(done.stderr.decode(), "")

    def test_a_module_is_written_as_it_was_read(self):
        data = self.compiled(READS).data()
        self.assertEqual(spirv.Module(data).data(), data)

    def test_what_is_no_module_is_refused(self):
        data = self.compiled(HOLE).data()
        for wrong in (b"", data[4:], data[:24], data[:20] + b"\0\0\0\0" + data[24:], data + b"\0"):
            with self.assertRaises(ValueError):
                spirv.Module(wrong)

    def test_samplers_are_parted_where_something_is_sampled(self):
        module = self.compiled(READS)
        module.split_samplers(lambda binding: binding + 16)
        self.assert_valid(module)
        samplers = module.named("drawn_sampler")
        self.assertEqual(len(samplers), 1)
        self.assertEqual(module.decoration(samplers[0], spirv.BINDING), 17)
        self.assertEqual(module.named("fetched_sampler"), [])

    def test_push_data_becomes_a_uniform_block(self):
        module = self.compiled(READS)
        self.assertTrue(module.push_to_uniform("Data", 3, 0))
        self.assert_valid(module)
        blocks = [one for one in reflect.inputs_of(module, reflect.Types(module)) if one["kind"] == "uniform"]
        self.assertEqual([(one["name"], one["set"], one["size"]) for one in blocks], [("Data", 3, 8)])
        self.assertFalse(module.push_to_uniform("Data", 3, 0))

    def test_arrays_between_stages_become_variables(self):
        module = self.compiled(READS)
        for_wgsl.split_arrays(module)
        self.assert_valid(module)
        handed = reflect.handed_on(module, reflect.Types(module), spirv.INPUT)
        self.assertEqual([(one["location"], one["type"], one["flat"]) for one in handed], [(i, "vec4", True) for i in range(3)])

    def test_constants_size_no_array_and_have_no_operations(self):
        module = self.compiled(READS)
        for_wgsl.size_arrays(module, {"kSize": 7})
        for_wgsl.operations_into_functions(module)
        self.assert_valid(module)
        self.assertEqual(module.all(for_wgsl.SPEC_CONSTANT_OP), [])
        types = reflect.Types(module)
        self.assertIn(15, [types.values[one.words[2]] for one in module.all(for_wgsl.TYPE_ARRAY)])

    def test_a_constant_is_fixed(self):
        module = self.compiled(READS)
        self.assertEqual(module.fix_constant("kSoftware", False), 1)
        self.assertIsNone(module.fix_constant("kNone", False))
        self.assert_valid(module)
        self.assertEqual([one["name"] for one in reflect.constants_of(module, reflect.Types(module))], ["kSize"])

    def test_a_hole_in_a_block_is_refused(self):
        module = self.compiled(HOLE)
        with self.assertRaisesRegex(RuntimeError, "Push.b does not lie where"):
            reflect.inputs_of(module, reflect.Types(module))

    def test_buffers_are_read_only_where_their_members_are(self):
        module = self.compiled(READ_ONLY, "comp")
        inputs = reflect.inputs_of(module, reflect.Types(module))
        self.assertEqual([(one["name"], one["access"]) for one in inputs], [("In", "read"), ("Out", "read_write")])
        self.assertEqual(reflect.workgroup_of(module), [4, 2, 1])
        for_wgsl.mark_read_only(module)
        self.assert_valid(module)
        self.assertEqual([module.is_decorated(one["id"], for_wgsl.NON_WRITABLE) for one in inputs], [True, False])


if __name__ == "__main__":
    unittest.main()
