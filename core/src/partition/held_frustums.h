// SPDX-License-Identifier: Apache-2.0
// Keeps a light's frustums from frame to frame where it can, so that nothing swims or pops.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006: a frustum changes only by whole-texel pans and steps
// of size, and any other change is cross-faded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon {

/// Which part of the world a frustum serves.
struct FrustumPart {
    int octave = 0; // its values in ViewSlice begin at 2^octave, and have no lower end with kFromEye,
    int end = 0;    // to 2^end, or without end with kToEnd
    std::uint32_t sector = 0;

    friend bool operator==(const FrustumPart&, const FrustumPart&) = default;
};
inline constexpr int kFromEye = -64;
inline constexpr int kToEnd = 63;

/// One whose texels hold still.
struct HeldFrustum {
    FrustumPart part;
    int step = 0;           // its texels have a side of 2^(step / 4), in units of LightRect
    std::uint32_t side = 0; // side of its map, texels
    double sum = 0.0;       // FacingTexels::sum_px: the value of its map where room is scarce
    bool came = false;      // in place of others, which fade over into it
};

[[nodiscard]] double texelOfStep(int step);
/// The finest step at which `texels` texels show `size`.
[[nodiscard]] int stepFor(double size, double texels);
/// The same with some room to pan, or `held` (none: it was not there), while that fits and is not much too coarse, or
/// while it `stays` for other reasons.
[[nodiscard]] int stepFrom(std::optional<int> held, double size, double texels, bool stays);

/// The frustums of one light.
struct HeldFrustums {
    std::vector<HeldFrustum> now;
    std::vector<HeldFrustum> before; // those that fade out
    std::uint32_t left = 0;          // frames that they have left

    [[nodiscard]] bool fading() const { return left > 0; }
    void cut();
    /// The step of a frustum that has to show `size` on a map of `texels` texels: the one that it had, while that fits
    /// and is not much too coarse.
    [[nodiscard]] int stepOf(const FrustumPart& part, double size, double texels) const;
    /// The frame's frustums. Where they differ from those of the frame before, these begin to fade out, over `frames`.
    void take(std::span<HeldFrustum> found, std::uint32_t frames);
    /// The share of what came, over what fades out.
    [[nodiscard]] double fadedIn(std::uint32_t frames) const;
    /// Where in the order of views a frustum has to stand: after what it fades over, and before what fades over it.
    /// Those that fade out stand first among equals.
    [[nodiscard]] int blockOf(const FrustumPart& part) const;
    /// One frame of the fade is over.
    void step();
};

} // namespace gnomon
