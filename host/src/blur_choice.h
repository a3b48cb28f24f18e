// SPDX-License-Identifier: Apache-2.0
// Which shaders blur filterable maps, where the options leave it open: tried once for a device, format and radius.
#pragma once

#include "host/gpu.h"

#include <gnomon/vulkan/shadow_renderer.h>

#include <vector>

namespace gnomon::host {

/// What was found out on a device.
struct BlurChoices {
    struct Entry {
        MapFormat format;
        std::uint32_t radius_texels;
        std::uint32_t image_layers;
        bool log_space;
        BlurPath path;
    };
    std::vector<Entry> entries;
};

/// The filter's own path, or if that is automatic and it blurs at all, the faster one.
[[nodiscard]] BlurPath chooseBlurPath(Gpu& gpu, const vulkan::FilterOptions& filter);

} // namespace gnomon::host
