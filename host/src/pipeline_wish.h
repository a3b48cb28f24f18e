// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipelines.h"

namespace gnomon::host {

/// The constant_ids of the host's shaders. tone.frag has its own meaning for the first four.
enum Constant : std::uint32_t {
    kBaseTexture,
    kEmits,
    kAllTextures,
    kEmissiveOnly,
    kFixedLights,
    kDirectionalOnly,
    kPhysicalOnly,
    kPhong2005,
    kOpaque,
    kToned,
    kTints,
    kTechnique,                                                      // pack::TechniqueConstants
    kInSoftware = kTechnique + sizeof(pack::TechniqueConstants) / 4, // set by make()
    kDrawsSky,                                                       // screen.vert
    kNight,                                                          // sky_physical.frag
    kOccluded,
    kFilmic,
    kDither,
    kLayered,
    kOrthographic,
    kMostConstants
};

// forward.frag, by_vertex.glsl, shade.frag, tone.glsl
static_assert(kTechnique == 11 && kInSoftware == 20 && kDrawsSky == 21 && kNight == 22 && kOccluded == 23 &&
              kDither == 25 && kLayered == 26);

struct Pipelines::Wish {
    const char* name = "";
    std::string_view vertex;                          // shaders
    std::string_view fragment;                        // empty: none
    std::array<VkBool32, kMostConstants> constants{}; // by Constant; floats by their bits
    std::span<const VkFormat> colours;
    bool scene = false; // vertex streams, dynamic culling; else one full-screen triangle
    bool blend = false;
    bool depth = false;
    bool depth_write = false;
    VkCompareOp compare = VK_COMPARE_OP_ALWAYS;
    VkPipelineLayout layout = VK_NULL_HANDLE; // null: that of the scene or of the screen
};

} // namespace gnomon::host
