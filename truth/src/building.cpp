// SPDX-License-Identifier: Apache-2.0
#include "building.h"

#include <algorithm>

namespace gnomon::truth {

void Building::show(double triangles)
{
    // Embree's own count is rough: it may fall back, or end short of all.
    shown_ = std::max(shown_, std::clamp(triangles / static_cast<double>(total_), 0.0, 1.0));
    if (options_.progress) {
        options_.progress(shown_);
    }
}

void Building::start(std::uint64_t triangles)
{
    if (isCancelled()) {
        throw BuildingCancelled();
    }
    current_ = triangles;
}

bool Building::reached(double share) noexcept
{
    if (isCancelled()) {
        stopped_ = true;
    }
    if (!stopped_ && std::this_thread::get_id() == caller_) {
        try {
            show(static_cast<double>(done_) + std::clamp(share, 0.0, 1.0) * static_cast<double>(current_));
        } catch (...) {
            failure_ = std::current_exception();
            stopped_ = true;
        }
    }
    return !stopped_;
}

void Building::finish()
{
    if (failure_) {
        std::rethrow_exception(failure_);
    }
    if (stopped_ || isCancelled()) {
        throw BuildingCancelled();
    }
    done_ += current_;
    current_ = 0;
    show(static_cast<double>(done_));
}

} // namespace gnomon::truth
