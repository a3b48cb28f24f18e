// SPDX-License-Identifier: Apache-2.0
#include "lab/score/path_score.h"

#include <cassert>
#include <cmath>

namespace gnomon::lab {

void PathScore::add(const Score& frame)
{
    if (rmse_.empty()) {
        sums_.atlas = frame.atlas;
        sums_.outcome = frame.outcome;
    }
    if (sums_.outcome.kind == OutcomeKind::ok) {
        sums_.outcome = frame.outcome;
    }
    rmse_.push_back(frame.error ? std::optional(frame.error->rmse) : std::nullopt);
    if (frame.error) {
        errors_.squared.add(frame.error->rmse * frame.error->rmse);
        errors_.mae.add(frame.error->mae);
        errors_.bias.add(frame.error->bias);
        errors_.p99.add(frame.error->p99);
    }
    if (frame.grazing_rmse) {
        errors_.grazing_squared.add(*frame.grazing_rmse * *frame.grazing_rmse);
    }
    errors_.ssim.add(frame.ssim);
    errors_.flip.add(frame.flip);
    if (frame.classification) {
        const ClassErrors& classes = frame.classification->errors;
        errors_.edge.add(classes.edge);
        errors_.acne.add(classes.acne);
        errors_.detached.add(classes.detached);
        errors_.bleeding.add(classes.bleeding);
        errors_.terminator.add(classes.terminator);
    }
    PixelCounts& pixels = sums_.pixels.counts;
    const PixelCounts& counts = frame.pixels.counts;
    pixels.counted += counts.counted;
    pixels.terminator += counts.terminator;
    pixels.background += counts.background;
    pixels.other_object += counts.other_object;
    pixels.facing_away += counts.facing_away;
    pixels.unlit += counts.unlit;
    pixels.no_receiver += counts.no_receiver;
    pixels.grazing += counts.grazing;
    sums_.density.counted += frame.density.counted;
    sums_.density.left_out += frame.density.left_out;
    if (frame.density.counted != 0) {
        density_.p01.add(frame.density.p01);
        density_.p50.add(frame.density.p50);
        density_.p99.add(frame.density.p99);
        density_.facing_p01.add(frame.density.facing.p01);
        density_.facing_p50.add(frame.density.facing.p50);
        density_.facing_p99.add(frame.density.facing.p99);
        density_.one_to_four.add(frame.density.facing.one_to_four);
        density_.fit_efficiency.add(frame.fit_efficiency);
    }
}

Score PathScore::mean() const
{
    assert(!rmse_.empty());
    Score score = sums_;
    if (errors_.squared.count != 0) {
        score.error =
            ErrorNumbers{std::sqrt(errors_.squared.of()), errors_.mae.of(), errors_.bias.of(), errors_.p99.of()};
    }
    if (errors_.grazing_squared.count != 0) {
        score.grazing_rmse = std::sqrt(errors_.grazing_squared.of());
    }
    score.ssim = errors_.ssim.ifAny();
    score.flip = errors_.flip.ifAny();
    if (errors_.edge.count != 0) {
        score.classification.emplace();
        score.classification->errors = {errors_.edge.of(), errors_.acne.of(), errors_.detached.of(),
                                        errors_.bleeding.of(), errors_.terminator.of()};
    }
    score.density.p01 = density_.p01.of();
    score.density.p50 = density_.p50.of();
    score.density.p99 = density_.p99.of();
    score.density.facing = {density_.facing_p01.of(), density_.facing_p50.of(), density_.facing_p99.of(),
                            density_.one_to_four.of()};
    score.fit_efficiency = density_.fit_efficiency.of();
    return score;
}

} // namespace gnomon::lab
