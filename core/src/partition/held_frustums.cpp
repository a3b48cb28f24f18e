// SPDX-License-Identifier: Apache-2.0
#include "partition/held_frustums.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon {
namespace {

/// New texels are so much larger than need be.
constexpr double kRoom = 1.1;
/// Texels that are kTooCoarse steps larger than new ones would be are kept.
constexpr int kTooCoarse = 3;

const HeldFrustum* findPart(std::span<const HeldFrustum> frustums, const FrustumPart& part)
{
    const auto found = std::ranges::find(frustums, part, &HeldFrustum::part);
    return found != frustums.end() ? &*found : nullptr;
}

bool isThere(std::span<const HeldFrustum> frustums, const HeldFrustum& one)
{
    const HeldFrustum* const found = findPart(frustums, one.part);
    return found != nullptr && found->step == one.step;
}

/// Does one of them serve some of the same?
bool overlaps(std::span<const HeldFrustum> frustums, const FrustumPart& part)
{
    return std::ranges::any_of(frustums, [&](const HeldFrustum& one) {
        return one.part.sector == part.sector && one.part.octave < part.end && part.octave < one.part.end;
    });
}

bool beginsThere(std::span<const HeldFrustum> frustums, int octave)
{
    return std::ranges::any_of(frustums, [&](const HeldFrustum& one) { return one.part.octave == octave; });
}

} // namespace

double texelOfStep(int step)
{
    return std::exp2(0.25 * step);
}

int stepFor(double size, double texels)
{
    constexpr double kLeast = 1e-30;
    constexpr double kMost = 1e30;
    const double texel = std::min(std::max(kLeast, size / texels), kMost); // and what is no number is the least
    return static_cast<int>(std::ceil(4.0 * std::log2(texel)));
}

int stepFrom(std::optional<int> held, double size, double texels, bool stays)
{
    const int least = stepFor(size, texels);
    const int best = stepFor(size * kRoom, texels);
    return held && *held >= least && (stays || *held <= best + kTooCoarse) ? *held : best;
}

void HeldFrustums::cut()
{
    now.clear();
    before.clear();
    left = 0;
}

int HeldFrustums::stepOf(const FrustumPart& part, double size, double texels) const
{
    const HeldFrustum* const held = findPart(now, part);
    return stepFrom(held != nullptr ? std::optional(held->step) : std::nullopt, size, texels, fading());
}

void HeldFrustums::take(std::span<HeldFrustum> found, std::uint32_t frames)
{
    const auto replaces = [&](const HeldFrustum& one) {
        return !isThere(now, one) && overlaps(now, one.part);
    };
    if (frames > 0 && std::ranges::any_of(found, replaces)) {
        // At most two maps are drawn of a place. Where something has to change before its time, the less visible of the
        // two goes at once.
        const bool begins = 2 * left <= frames;
        if (begins) {
            before.clear();
            std::ranges::copy_if(now, std::back_inserter(before),
                                 [&](const HeldFrustum& one) { return !isThere(found, one); });
            left = frames;
        }
        for (HeldFrustum& one : found) {
            const HeldFrustum* const held = findPart(now, one.part);
            one.came = replaces(one) || (!begins && held != nullptr && held->came);
        }
    } else {
        for (HeldFrustum& one : found) {
            const HeldFrustum* const held = findPart(now, one.part);
            one.came = fading() && held != nullptr && held->came;
        }
    }
    now.assign(found.begin(), found.end());
}

double HeldFrustums::fadedIn(std::uint32_t frames) const
{
    return 1.0 - static_cast<double>(left) / (frames + 1.0);
}

// Both divisions have those ends in common between which nothing changes, so between two of them all that fades out
// may stand before all that comes.
int HeldFrustums::blockOf(const FrustumPart& part) const
{
    int block = kFromEye;
    for (const HeldFrustum& one : now) {
        const int octave = one.part.octave;
        const bool common = !one.came || beginsThere(before, octave);
        if (common && octave <= part.octave) {
            block = std::max(block, octave);
        }
    }
    return block;
}

void HeldFrustums::step()
{
    if (left > 0 && --left == 0) {
        before.clear();
    }
}

} // namespace gnomon
