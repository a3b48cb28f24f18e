// SPDX-License-Identifier: Apache-2.0
// Boxes around all objects that moved between two frames.
#pragma once

#include <gnomon/object_set.h>

#include <vector>

namespace gnomon {

/// Remembers where every object was.
class MovedBoxes {
public:
    /// Boxes around what came, went or changed since the last call for the same set, as Plan::moved_ws. False: there
    /// was no such call, and nothing is known.
    bool follow(const ObjectSet& objects, std::vector<Aabb>& moved_ws);
    /// The next call knows nothing.
    void forget() { identity_ = 0; }

private:
    std::vector<Aabb> bounds_; // as they were, by index
    std::uint64_t identity_ = 0;
    std::uint64_t version_ = 0;
};

} // namespace gnomon
