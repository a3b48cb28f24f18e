// SPDX-License-Identifier: Apache-2.0
// A few depths over each other and a receiver, in numbers that both precisions hold, and how they are filtered.
#pragma once

#include <glm/glm.hpp>

namespace gnomon::test {

struct DepthDraw {
    int points = 1; // 1 .. 4
    float depths[4]{};
    float weights[4]{};
    float receiver = 0.0F;
    float texel_depth = 0.0F;
};

struct SingleOptions {
    int filter = 0;
    int flags = 0;
    double exponent = 0.0;
    double moment_bias = 0.0;
    double min_variance = 0.0;
    double rounding = 0.0; // evsm
    double rounding_negative = 0.0;
};

/// The shaders' work in double precision, up to a map of 32-bit floats, and from there.
[[nodiscard]] glm::vec4 storedInDouble(const DepthDraw& draw, const SingleOptions& options);
[[nodiscard]] double visibilityInDouble(const glm::vec4& stored, const DepthDraw& draw, const SingleOptions& options);

} // namespace gnomon::test
