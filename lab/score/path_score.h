// SPDX-License-Identifier: Apache-2.0
// The errors of one technique over the frames of a path, as one score.
#pragma once

#include "lab/score/score.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::lab {

/// Adds up the scores of frames; keeps no image of them. Every frame in which a pixel counts weighs the same.
class PathScore {
public:
    /// Frames in order.
    void add(const Score& frame);
    /// A score without images. rmse is the root of the mean over the frames of its square, so that the classes, which
    /// are means, still add up to its square; all else are means: mae, bias, p99, ssim, flip, texel density, fit
    /// efficiency. Pixels are added up. The outcome is the first that is not ok. The error numbers are absent when in
    /// no frame a pixel counts; a value that is not a number makes its mean NaN. Precondition: a frame was added.
    [[nodiscard]] Score mean() const;
    /// The rmse of every frame; nothing where no pixel counts.
    [[nodiscard]] const std::vector<std::optional<double>>& rmse() const { return rmse_; }

private:
    /// A sum and how many are in it.
    struct Mean {
        double sum = 0.0;
        std::uint64_t count = 0;
        void add(const std::optional<double>& value)
        {
            if (value) {
                sum += *value;
                ++count;
            }
        }
        [[nodiscard]] double of() const { return count == 0 ? 0.0 : sum / static_cast<double>(count); }
        [[nodiscard]] std::optional<double> ifAny() const { return count == 0 ? std::nullopt : std::optional(of()); }
    };
    struct ErrorMeans {
        Mean squared, grazing_squared, mae, bias, p99, ssim, flip, edge, acne, detached, bleeding, terminator;
    };
    struct DensityMeans {
        Mean p01, p50, p99, facing_p01, facing_p50, facing_p99, one_to_four, fit_efficiency;
    };
    ErrorMeans errors_;
    DensityMeans density_;
    Score sums_; // numbers that are summed, not averaged
    std::vector<std::optional<double>> rmse_;
};

} // namespace gnomon::lab
