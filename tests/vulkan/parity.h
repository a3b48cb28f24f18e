// SPDX-License-Identifier: Apache-2.0
// One frame of the scene of boxes on the GPU, with all that the CPU's reference needs to compute its masks.
#pragma once

#include "cpu_map.h"
#include "reference.h"

#include <string>

namespace gnomon::test {

inline constexpr VkExtent2D kParityScreen{320, 200};

enum class ParityLights : std::uint8_t {
    sun_and_spot, // on a layer each, the spot's tile amid room to spare, so tile offsets count
    sun_alone,    // then the mask is drawn by pipelines for orthographic views
    point,        // six views with a tile each of the same layer, side by side
    paraboloid,   // the same lamp with two half spaces
    one_layer,    // a sun, a spot and a second sun, each with a tile of the same layer
    // A sun between two positions, each with a layer of its own or, where the format has two maps a texel, with half of
    // one; they are blended all over, or in
    stepping_sun,
    stepping_band, // a band across the picture
};

struct Rendered {
    Scene scene = makeScene();
    std::vector<Light> lights;
    Plan plan;
    Camera camera;
    Picture picture;
    std::vector<CpuMap> maps;                          // by layer of the image
    std::vector<std::vector<std::byte>> masks;         // by light, one byte a pixel
    std::vector<std::vector<pack::DepthLayer>> layers; // by view
};
[[nodiscard]] Rendered renderParity(const ShadowOptions& options, ParityLights lights = ParityLights::sun_and_spot);

struct ParityFigures {
    std::size_t pixels = 0;
    std::size_t different = 0; // by more than a step of the mask and its rounding
    double worst = 0.0;        // in steps of the mask
    std::size_t loose = 0;     // where rounding of single precision alone may be more than a step
};
/// Every mask against the reference: at most a pixel in a thousand may be off by more than `steps` of the mask's 255
/// from what rounding may make of it.
/// Writes the masks as pictures named for the case, and returns the light that is worst.
ParityFigures expectParity(const Rendered& r, const ShadowOptions& options, const std::string& name,
                           double steps = 1.001);

} // namespace gnomon::test
