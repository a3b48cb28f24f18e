// SPDX-License-Identifier: Apache-2.0
// The errors of this device's samplers with formats of 16 bits; the figures are properties of the result
// (tools/on_gpu.sh).
#include "fixture.h"
#include "read_error.h"

#include <gtest/gtest.h>

#include <string>

namespace gnomon::test {
namespace {

TEST(ReadError, isHalfAStepAtMost)
{
    for (const bool is_unorm : {true, false}) {
        const double steps = stepsOfReads(is_unorm ? VK_FORMAT_R16G16B16A16_UNORM : VK_FORMAT_R16G16B16A16_SFLOAT);
        RecordProperty(is_unorm ? "unorm_read_steps" : "half_read_steps", std::to_string(steps));
        EXPECT_LE(steps, 0.6);
    }
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
