// SPDX-License-Identifier: Apache-2.0
// The images that a frame is drawn into.
#pragma once

#include "pipelines.h"

#include <tuple>

namespace gnomon::host {

struct Targets {
    Targets(Memory& memory, VkExtent2D drawn, VkExtent2D shown, bool with_toned);

    VkExtent2D drawn; // everything up to the tone curve: twice `shown` on each side with supersampling
    VkExtent2D shown;
    Image depth;
    std::array<Image, std::tuple_size_v<GBufferFormats>> gbuffer; // null: not yet needed
    Image light;
    Image toned; // before fxaa; null without it
    Image picture;

    /// Makes the images of the G-buffer that are not there yet. Throws Error.
    void needGBuffer(Memory& memory, const GBufferFormats& formats, const GBufferShape& shape);
    [[nodiscard]] const Image& surfaces() const { return gbuffer[0]; }
    [[nodiscard]] const Image& normals() const { return gbuffer[1]; }
    [[nodiscard]] const Image& receivers() const { return gbuffer[2]; } // ids
    [[nodiscard]] const Image& smooth() const { return gbuffer[3]; }
};

} // namespace gnomon::host
