// SPDX-License-Identifier: Apache-2.0
// What belongs to a device that was abandoned.
#pragma once

#include <memory>

namespace gnomon::host {

/// Never destroyed, and still reachable, so that it is not taken for a leak.
template <class Whole>
void keepForGood(std::unique_ptr<Whole> whole) noexcept
{
    struct Kept {
        Kept* before;
        Whole* whole;
    };
    static Kept* last = nullptr;
    last = new (std::nothrow) Kept{last, whole.release()};
}

} // namespace gnomon::host
