// SPDX-License-Identifier: Apache-2.0
// Objects of a device that was abandoned.
#pragma once

#include <memory>

namespace gnomon::host {

/// Keeps an object for ever, reachable, so that it does not count as a leak.
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
