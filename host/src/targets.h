// SPDX-License-Identifier: Apache-2.0
// The images that a frame is drawn into.
#pragma once

#include "pipelines.h"

namespace gnomon::host {

struct Targets {
    Targets(Memory& memory, VkExtent2D drawn, VkExtent2D shown, bool with_toned);

    VkExtent2D drawn; // everything up to the tone curve: twice `shown` on each side with supersampling
    VkExtent2D shown;
    Image depth;
    std::array<Image, kGBufferFormats.size()> gbuffer;
    Image light;
    Image toned; // before fxaa; null without it
    Image picture;

    [[nodiscard]] const Image& ids() const { return gbuffer[3]; }
    [[nodiscard]] const Image& normals() const { return gbuffer[1]; }
    [[nodiscard]] const Image& smooth() const { return gbuffer[4]; }
};

} // namespace gnomon::host
