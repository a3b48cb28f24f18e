// SPDX-License-Identifier: Apache-2.0
// Whether the maps of a light's cascades are drawn each in a pass of its own or in one, where the options leave it
// open: timed once for a device and what is drawn.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/vulkan/cascade_pass.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon::host {

/// What was found out on a device.
class CascadeChoices {
public:
    /// What the faster way may depend on.
    struct Drawn {
        MapFormat format = MapFormat::d32f;
        std::uint32_t map_size = 0;
        std::uint32_t views = 0;
        std::uint64_t triangles = 0; // in all maps

        bool operator==(const Drawn&) const = default;
    };
    /// Milliseconds that the maps took, drawn this way; 0 or less: the device has no clock.
    using TimeOf = std::function<double(vulkan::CascadePass)>;

    /// each or layered: what was found before for the same, or else what takes less time, the best of three turns of
    /// both. `each` where they take the same, or where there is no clock.
    [[nodiscard]] vulkan::CascadePass settle(const Drawn& drawn, const TimeOf& time);

private:
    struct Entry {
        Drawn drawn;
        vulkan::CascadePass pass;
    };
    std::vector<Entry> entries_;
};

} // namespace gnomon::host
