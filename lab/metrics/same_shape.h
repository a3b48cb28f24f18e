// SPDX-License-Identifier: Apache-2.0
// The precondition that metrics and pictures of masks share.
#pragma once

#include "image/image.h"

namespace gnomon::lab {

/// Do both images have one size and one channel?
template <typename A, typename B>
[[nodiscard]] bool areMasksOfOneSize(const ImageOf<A>& a, const ImageOf<B>& b)
{
    return a.width == b.width && a.height == b.height && a.channels == 1 && b.channels == 1;
}

} // namespace gnomon::lab
