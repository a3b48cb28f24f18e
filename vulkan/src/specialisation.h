// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "functions.h"

#include <array>

namespace gnomon::vulkan {

/// Specialisation constants 0, 1, ... of a shader: the members of a struct, four bytes each, in their order.
template <class Words>
class Specialisation {
public:
    explicit Specialisation(const Words& words) : words_(words)
    {
        for (std::uint32_t i = 0; i < entries_.size(); ++i) {
            entries_[i] = {i, 4 * i, 4};
        }
        info_ = {static_cast<std::uint32_t>(entries_.size()), entries_.data(), sizeof words_, &words_};
    }
    Specialisation(const Specialisation&) = delete;
    Specialisation& operator=(const Specialisation&) = delete;

    [[nodiscard]] const VkSpecializationInfo* info() const { return &info_; } // for as long as this lives

private:
    static_assert(sizeof(Words) % 4 == 0);
    Words words_;
    std::array<VkSpecializationMapEntry, sizeof(Words) / 4> entries_{};
    VkSpecializationInfo info_{};
};

} // namespace gnomon::vulkan
