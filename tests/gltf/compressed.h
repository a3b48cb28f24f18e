// SPDX-License-Identifier: Apache-2.0
// Small files that the encoders of Draco and meshoptimizer have compressed.
#pragma once

#include "support.h"

namespace gnomon::scene::test {

/// A hilly square of side 8 with known normals. Positions lie on a grid of 1/64, so that they can be told again.
struct Hill {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;

    /// The surface's normal at a point of it.
    [[nodiscard]] glm::vec3 normalAt(const glm::vec3& point) const;
};

/// `side` vertices along each side, 2 at least.
[[nodiscard]] Hill makeHill(std::uint32_t side);

/// Positions, normals, texture coordinates, joints, weights and colours, in this order, as attributes 0 to 5.
[[nodiscard]] std::vector<std::byte> encodeDraco(const Hill& hill, bool sequential);
/// One primitive of them. Its stream is view 0, at the start of the data.
[[nodiscard]] FileBuilder dracoFile(const Hill& hill, bool sequential);

/// One primitive, and an animation that turns its node by 90 degrees around x. Views: positions, normals (OCTAHEDRAL),
/// texture coordinates (EXPONENTIAL), indices by `mode`, key times, rotations (QUATERNION). Buffer 1 is a fallback.
[[nodiscard]] FileBuilder meshoptFile(const Hill& hill, const char* mode, bool wide_indices, const char* extension);

} // namespace gnomon::scene::test
