// SPDX-License-Identifier: Apache-2.0
// Small numbers for the lights of a planner, which stay theirs from frame to frame.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon {

/// A light is known by its key; of several with one key, by its turn among them. The work of a frame grows with its
/// lights' number n as n log n, and takes nothing from the heap unless a light is new.
class LightRows {
public:
    /// The lights of a frame, by their keys. Rows of lights that it does not have are given up, and used again for
    /// others.
    void follow(std::span<const std::uint64_t> keys);
    [[nodiscard]] std::uint32_t rowOf(std::size_t light) const { return row_of_[light]; }
    /// Rows that the last follow() gave up. It used none of them again.
    [[nodiscard]] std::span<const std::uint32_t> gone() const { return gone_; }
    /// All rows are less.
    [[nodiscard]] std::uint32_t end() const { return end_; }

private:
    struct Known {
        std::uint64_t key = 0;
        std::uint32_t row = 0;
    };
    std::uint32_t freshRow();

    std::vector<Known> known_; // sorted by key; those of one key are in the frame's order
    std::vector<Known> next_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order_; // keys and lights
    std::vector<std::uint32_t> row_of_;
    std::vector<std::uint32_t> gone_;
    std::vector<std::uint32_t> free_;
    std::uint32_t end_ = 0;
};

} // namespace gnomon
