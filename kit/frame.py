# SPDX-License-Identifier: Apache-2.0
"""The modules that a frame runs, in order, by the kinds of pack::listFramePasses() (gnomon/pack/frame_passes.h), whose list
for a plan says which of these kinds there are. A step is a draw (a vertex and a fragment module) or a dispatch; names are
patterns, of which one module each is taken. `when` says what it takes for the step to be run."""

import fnmatch

TRIANGLE = "mask.vert"
CASTER = "caster*.vert"


def draw(vertex: str, fragment: str, when: str) -> dict:
    return {"vertex": vertex, "fragment": fragment, "when": when}


def mask(when: str) -> dict:
    """In SPIR-V these modules have inputs, which software rasterisers alone read."""
    return {"vertex": TRIANGLE, "spirv_vertex": "mask_numbers.vert", "fragment": "mask_[!s]*.frag", "when": when}


def dispatch(compute: str, when: str) -> dict:
    return {"compute": compute, "when": when}


# In the order of FramePassKind; tests/kit holds both to one another.
FRAME: dict[str, list[dict]] = {
    "bounds": [
        dispatch("cascade_depth.comp", "always: a light's least and greatest depth, over the screen's pixels"),
        dispatch("cascade_bounds.comp", "always: the bounds of each cascade, over the screen's pixels"),
        dispatch("cascade_finish.comp", "always: where each cascade lies on its light's base map"),
        dispatch("cascade_constants.comp", "before the mask: writes that into the GpuViews"),
    ],
    "maps": [
        draw(TRIANGLE, "restore_[ds]*.frag", "a kept map of what stands still, of depths alone or of two maps a texel, goes back under what moves"),
        draw(TRIANGLE, "restore_colour.frag", "the same, of a map in a colour image"),
        draw(TRIANGLE, "restore_clear.frag", "the map shares its texels with another, and nothing is kept"),
        draw(CASTER, "caster_[!tb]*.frag", "casters, where more than the rasteriser's depth is written or a texture has holes"),
        draw(CASTER, "", "casters, where the rasteriser's depth is the map's"),
        draw(CASTER, "caster_behind*.frag", "caster-faces=midpoint: the second surface"),
        draw(TRIANGLE, "midpoint.frag", "caster-faces=midpoint: midway between the two"),
        draw(CASTER, "caster_tint.frag", "blended casters tint the light: into the map of tints"),
        dispatch("smoothies_edges.comp", "soften=smoothies"),
        dispatch("smoothies_row.comp", "soften=smoothies"),
        dispatch("smoothies_column.comp", "soften=smoothies"),
        draw("fin*.vert", "fin.frag", "filter=smoothies: fins, into the image beside the map"),
        dispatch("depth_blocks_map.comp", "filters pcss and raymarch: the two finest levels of blocks"),
        dispatch("depth_blocks.comp", "the same: two further levels, until there is one block"),
        dispatch("depth_layers_histogram*.comp", "lvsm.placement=lloyd: depths of the map"),
        dispatch("depth_layers_place.comp", "the same: a view's layers"),
        dispatch("depth_layers_gaps*.comp", "lvsm.placement=gaps: depths of the map"),
        dispatch("depth_layers_part.comp", "the same: a view's layers"),
        dispatch("moments*.comp", "a filterable filter without a blur: depths become what a texel stores"),
        dispatch("blur_moments*.comp", "a filterable filter with a blur: the same, blurred along x"),
        dispatch("blur_blocks.comp", "with a blur: the blocks that are left to do"),
        dispatch("blur.comp", "with a blur, blur.path=compute: along y"),
        draw(TRIANGLE, "blur.frag", "with a blur, blur.path=fragment: along y"),
        dispatch("mip.comp", "a filterable filter with mip levels: each from the finer one"),
    ],
    "mask": [mask("each draw of listMaskDraws(), by the module of pack::filterModule(); with mask-size=half into an image of half the size"),
             dispatch("seen_cells.comp", "partition=virtual, after all that writes the mask: where its edges are, for Frame::requests")],
    "spread": [draw("mask_screen.vert", "mask_spread.frag", "where the image of half the size settles a pixel"),
               mask("the pixels that are left")],
    "volumes": [draw(TRIANGLE, "volume_depth.frag", "the camera's depth, beside a stencil"),
                draw("volume.vert", "", "each draw of listVolumeDraws(): counts in the stencil"),
                draw(TRIANGLE, "volume_mask.frag", "twice a light: outside of all volumes, inside of some")],
    "history": [draw(TRIANGLE, "alternate.frag", "always")],
    "converge": [draw(TRIANGLE, "converge.frag", "always")],
    "blur": [draw(TRIANGLE, "soften.frag", "each draw of listSoftenDraws()"),
             draw(TRIANGLE, "soften_spread.frag", "soften.size=half: spreads what was blurred at half the size")],
}


def order(modules: list[str]) -> list[dict]:
    """The frame with the names of modules in place of patterns. Throws where a pattern names none or a module is in no step."""
    used: set[str] = set()

    def named(pattern: str) -> list[str]:
        found = fnmatch.filter(modules, pattern)
        if pattern and not found:
            raise ValueError(f"no module is called {pattern}")
        used.update(found)
        return found

    passes = [{"kind": kind, "steps": [{what: value if what == "when" else named(value) for what, value in step.items()} for step in steps]}
              for kind, steps in FRAME.items()]
    if unused := set(modules) - used:
        raise ValueError(f"no step of the frame runs {', '.join(sorted(unused))}")
    return passes


def programs(frame: list[dict]) -> list[tuple[str, ...]]:
    """The modules that the texts of a dialect draw or dispatch with, together."""
    found = {}
    for kind in frame:
        for step in kind["steps"]:
            for name in step.get("compute", []):
                found[(name,)] = None
            for vertex in step.get("vertex", []):
                found |= {(vertex, fragment): None for fragment in step["fragment"]} or {(vertex,): None}
    return list(found)
