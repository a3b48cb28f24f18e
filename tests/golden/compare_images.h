// SPDX-License-Identifier: Apache-2.0
// Is a picture the one we looked at and found right?
#pragma once

#include "image/image.h"

#include <string>

namespace gnomon::golden {

/// Differences are of values in [0, 1], a pixel's the largest of its channels. Both tolerances must hold.
struct Tolerance {
    float largest = 1.0F; // no pixel differs by more
    float small = 0.0F;   // differences up to this are rounding
    float share = 0.0F;   // at most this share of the pixels differs by more than `small`
};

struct Verdict {
    bool same = false;
    float largest = 0.0F;
    float share = 0.0F; // of pixels beyond `small`
    std::string why;    // empty when same
};
/// Sizes and channels must be equal. A value that is not finite, on either side, is a failure whatever the tolerances.
[[nodiscard]] Verdict compare(const ImageF& actual, const ImageF& wanted, const Tolerance& tolerance);

/// The pixel's difference times 4 as grey, for people. Precondition: equal sizes and channels.
[[nodiscard]] Image8 differenceImage(const ImageF& actual, const ImageF& wanted);
/// The image moved by whole pixels, its edge repeated.
[[nodiscard]] ImageF shifted(const ImageF& image, int dx, int dy);
/// To nearest.
[[nodiscard]] Image8 to8Bit(const ImageF& image);
[[nodiscard]] ImageF toFloat(const Image8& image);

} // namespace gnomon::golden
