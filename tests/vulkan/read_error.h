// SPDX-License-Identifier: Apache-2.0
// How exact the device's linear samplers are. The specification leaves that open for formats of 16 bits: lavapipe reads
// them in single precision, GPUs may round the result.
#pragma once

#include <vulkan/vulkan.h>

namespace gnomon::test {

/// The largest error of a linear sampler of a format: `absolute` + `relative` of the value.
struct ReadError {
    double absolute = 0.0;
    double relative = 0.0;
};

/// The error of a read of similar texels of R16G16B16A16_UNORM or R16G16B16A16_SFLOAT, in steps of the format. Measured
/// once, by a blit; half a step where the device cannot blit as a sampler reads.
[[nodiscard]] double stepsOfReads(VkFormat format);
/// Nothing where such reads are exact, else half a step of the format.
[[nodiscard]] ReadError readErrorOf(VkFormat format);

} // namespace gnomon::test
