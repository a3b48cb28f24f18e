// SPDX-License-Identifier: Apache-2.0
// How far the building of Embree's structures has come, and whether it is to end.
#pragma once

#include "truth/visibility.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <thread>

namespace gnomon::truth {

/// Thrown when building was cancelled.
struct BuildingCancelled {};

/// What is to be built is counted in triangles: `total` >= 1 of them, in one structure after another.
class Building {
public:
    Building(const Options& options, std::uint64_t total) : options_(options), total_(total) {}

    /// The next structure, of so many of the triangles. Throws BuildingCancelled when that is asked for.
    void start(std::uint64_t triangles);
    /// The share of the present structure that is done; false when building is to stop. For Embree, which may call from
    /// any thread, and which no exception may cross.
    [[nodiscard]] bool reached(double share) noexcept;
    /// After the structure: throws what the callback threw, and BuildingCancelled when building did stop.
    void finish();

private:
    void show(double triangles);
    [[nodiscard]] bool isCancelled() const { return options_.cancel != nullptr && *options_.cancel; }

    const Options& options_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
    std::uint64_t current_ = 0;
    double shown_ = 0.0;
    std::thread::id caller_ = std::this_thread::get_id();
    std::exception_ptr failure_; // of the caller's thread alone
    std::atomic<bool> stopped_{false};
};

} // namespace gnomon::truth
