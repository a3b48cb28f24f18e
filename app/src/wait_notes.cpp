// SPDX-License-Identifier: Apache-2.0
#include "wait_notes.h"

#include <fmt/format.h>

namespace gnomon::app {

std::optional<std::string> waitNote(const lab::Waits& waits)
{
    if (waits.longest_frames == 0) {
        return std::nullopt;
    }
    return fmt::format("lights keep maps that they had until their turn comes: up to {} light{} and {} map{} in a "
                       "frame, for {} frame{} at the longest; frames after the first draw {} texels at most",
                       waits.most_lights, waits.most_lights == 1 ? "" : "s", waits.most_maps,
                       waits.most_maps == 1 ? "" : "s", waits.longest_frames, waits.longest_frames == 1 ? "" : "s",
                       waits.most_texels);
}

} // namespace gnomon::app
