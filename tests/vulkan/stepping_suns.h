// SPDX-License-Identifier: Apache-2.0
// The scene of boxes, with many more of them, under suns that have maps of two positions.
#pragma once

#include "fixture.h"

#include <ostream>
#include <vector>

namespace gnomon::test {

inline constexpr VkExtent2D kStepScreen{160, 100};

using Mask = std::vector<std::byte>;

enum class Slices : std::uint8_t { one, two };

struct Setting {
    ShadowOptions options{.technique = kPlainTechnique};
    Slices slices = Slices::one;
    bool paired_texels = false;
};

/// One of the settings that a test runs with.
struct StepCase {
    const char* name;
    Filter filter;
    MapFormat format;
    Slices slices;
    bool paired_texels;
};
[[nodiscard]] Setting settingOf(const StepCase& c);
std::ostream& operator<<(std::ostream& out, const StepCase& c);

/// Suns, each with its positions as asked for; of the second one on they are the other way round.
class Suns {
public:
    explicit Suns(const Setting& setting_in, std::size_t lights = 1, const vulkan::MemoryHooks& memory = {});

    /// The masks of all lights by one position alone, without stepping.
    [[nodiscard]] std::vector<Mask> maskOf(SunPosition position);
    /// The masks of all lights between their positions.
    [[nodiscard]] std::vector<Mask> maskOf(const std::vector<SunSteps>& steps);
    [[nodiscard]] Plan planOf(const std::vector<SunSteps>& steps) const;

    Bench bench;
    Setting setting;

private:
    [[nodiscard]] std::vector<Mask> draw(const Plan& plan);
};

/// The largest difference of the mask from the mix of both positions' masks, in steps of 255.
[[nodiscard]] double worstOff(const Mask& mask, const Mask& earlier, const Mask& later, const SunSteps& steps);
[[nodiscard]] std::size_t countDifferent(const Mask& a, const Mask& b);
[[nodiscard]] inline int steps255(const Mask& mask, std::size_t i)
{
    return std::to_integer<int>(mask[i]);
}
/// Both masks are rounded, and so is their mix; a bit more for single precision.
inline constexpr double kRounding = 1.01;

[[nodiscard]] SunSteps blendOf(double share, bool smooth);

} // namespace gnomon::test
