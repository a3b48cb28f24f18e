// SPDX-License-Identifier: Apache-2.0
// Which shaders blur filterable maps, where the options leave it open: tried once for a device, format and radius.
#pragma once

#include <gnomon/moment_options.h>

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

} // namespace gnomon::host
