// SPDX-License-Identifier: Apache-2.0
#include "store/light_rows.h"

#include <algorithm>

namespace gnomon {

std::uint32_t LightRows::freshRow()
{
    if (free_.empty()) {
        return end_++;
    }
    const std::uint32_t row = free_.back();
    free_.pop_back();
    return row;
}

void LightRows::follow(std::span<const std::uint64_t> keys)
{
    free_.insert(free_.end(), gone_.begin(), gone_.end());
    gone_.clear();
    next_.clear();
    order_.clear();
    for (std::uint32_t light = 0; light < keys.size(); ++light) {
        order_.emplace_back(keys[light], light);
    }
    std::ranges::sort(order_);
    row_of_.resize(keys.size());
    // Both lists are sorted by key, so one walk along them pairs them.
    auto known = known_.begin();
    for (const auto& [key, light] : order_) {
        for (; known != known_.end() && known->key < key; ++known) {
            gone_.push_back(known->row);
        }
        const bool is_known = known != known_.end() && known->key == key;
        row_of_[light] = is_known ? known++->row : freshRow();
        next_.push_back({key, row_of_[light]});
    }
    for (; known != known_.end(); ++known) {
        gone_.push_back(known->row);
    }
    std::swap(known_, next_);
}

} // namespace gnomon
