// SPDX-License-Identifier: Apache-2.0
// The progress of building Embree's structures, and its cancellation.
#pragma once

#include "truth/visibility.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <thread>

namespace gnomon::truth {

/// Thrown when building was cancelled.
struct BuildingCancelled {};

/// Counts the triangles that are built: `total` >= 1 of them, in one structure after another.
class Building {
public:
    Building(const Options& options, std::uint64_t total) : options_(options), total_(total) {}

    /// Begins the next structure, of `triangles`. Throws BuildingCancelled when Options::cancel is true.
    void start(std::uint64_t triangles);
    /// Takes the share of the present structure that is done; returns false when building is to stop. Embree calls it,
    /// from any thread, and no exception may cross Embree.
    [[nodiscard]] bool reached(double share) noexcept;
    /// Ends the structure: throws the callback's exception again, and BuildingCancelled when building did stop.
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
    std::exception_ptr failure_; // only the caller's thread sets it
    std::atomic<bool> stopped_{false};
};

} // namespace gnomon::truth
