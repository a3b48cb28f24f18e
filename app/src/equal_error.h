// SPDX-License-Identifier: Apache-2.0
// The cost of a technique beside plain PCF whose error is no larger.
#pragma once

#include "app/settings.h"
#include "lab/compare.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::app {

/// One way to run plain PCF, with its rough cost: texels rendered, and texels read by the pixels of the picture.
struct PcfSetting {
    Settings settings;
    double work = 0.0;
};

inline constexpr std::uint32_t kEqualErrorMinMap = 16;
inline constexpr std::uint32_t kEqualErrorMaxMap = 8192;

/// Every kernel of PCF on maps of 16 to 8192 texels on a side, by factors of about sqrt(2) and no larger than
/// `max_side`; the least work first, and at equal work the smaller map. All else is as in `base`.
[[nodiscard]] std::vector<PcfSetting> pcfLadder(const Settings& base, std::uint32_t max_side);

/// Is it PCF with default values of the other choices, with which others are compared?
[[nodiscard]] bool isPlainPcf(const Settings& settings);

struct EqualError {
    std::optional<double> ratio; // median frame of the technique / that of the PCF; nothing: see `reason`
    std::string pcf;             // the PCF that matched
    std::optional<double> pcf_rmse;
    std::string cheaper; // the last before it, which errs more; empty when there is none
    std::optional<double> cheaper_rmse;
    std::optional<double> technique_ms; // median frames, timed in turn with each other
    std::optional<double> pcf_ms;
    std::optional<double> without_ms;   // without shadows
    std::optional<double> shadow_ratio; // `ratio` of the frames less the one without shadows; nothing: none is left
    std::uint32_t tried = 0;            // settings of PCF whose error was compared with the technique's
    std::string reason;                 // a sentence; empty when there is a ratio
};

/// The first of `count` whose error is at most `rmse`, asking in order; nothing when none is, or when an error is
/// absent. `tried` is how many were asked.
[[nodiscard]] std::optional<std::size_t> firstWithin(std::size_t count, double rmse,
                                                     const std::function<std::optional<double>(std::size_t)>& rmse_of,
                                                     std::uint32_t& tried);

/// Finds the match of one technique after another. Each PCF is drawn at most once; all are compared with one truth.
class EqualErrorSearch {
public:
    /// `step` is called about once a frame and may throw to stop. All arguments must outlive the search.
    EqualErrorSearch(const host::SceneOnGpu& scene, const lab::Subject& subject, const truth::Traced& truth,
                     const Settings& base, const std::function<void()>& step);
    /// `rmse`: of the technique against the truth; nothing when no pixel counts.
    [[nodiscard]] EqualError match(const Settings& technique, const std::optional<double>& rmse);

private:
    [[nodiscard]] std::optional<double> rmseOf(std::size_t rung);
    void time(const Settings& technique, const Settings& pcf, EqualError& result);

    const host::SceneOnGpu& scene_;
    const lab::Subject& subject_;
    const truth::Traced& truth_;
    const Settings& base_;
    const std::function<void()>& step_;
    std::vector<PcfSetting> ladder_;
    std::vector<std::optional<std::optional<double>>> rmse_; // by rung; the outer one: drawn yet?
};

} // namespace gnomon::app
