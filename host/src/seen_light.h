// SPDX-License-Identifier: Apache-2.0
// The light of lights on visible surfaces, from which the exposure follows.
#pragma once

#include "frame_data.h"

#include "host/view.h"

#include <gnomon/object_set.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::host {

/// Estimated from the bounds of objects on the CPU. So a picture's exposure does not depend on the picture before it.
class SeenLight {
public:
    /// For each light, at its full strength, the illuminance of the surfaces that it shines on and the camera sees:
    /// lux, or the unit of the scene's lights. A directional light has its own. The 16 spot and point lights of most
    /// candela count, the others have 0. Where a lamp's place in the picture is small, or beside it, it has less, but
    /// at least a 16th of its illuminance there. `left_out`: by object, 1 for those that do not count; empty: all do.
    /// Valid until the next call.
    std::span<const double> find(std::span<const ShadedLight> lights, const ObjectSet& objects, const Sight& sight,
                                 std::span<const std::uint8_t> left_out = {});

private:
    [[nodiscard]] double lampGives(const Light& lamp, const ObjectSet& objects, const Sight& sight,
                                   std::span<const std::uint8_t> left_out);

    std::vector<double> given_;
    std::vector<std::uint32_t> lamps_;
    std::vector<std::uint32_t> near_;
    std::vector<Aabb> boxes_;
};

} // namespace gnomon::host
