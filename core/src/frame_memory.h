// SPDX-License-Identifier: Apache-2.0
// The last input of a planner, so that a frame in which nothing moved costs next to nothing.
#pragma once

#include <gnomon/frame.h>

#include <cstdint>
#include <vector>

namespace gnomon {

class FrameMemory {
public:
    /// Is all that a plan depends on as in the last frame that was noted? Frame::time_s does not count here: only suns
    /// that move in steps go by it.
    [[nodiscard]] bool holds(const Frame& frame) const;
    /// Does the frame's camera stand where it stood in the last frame that was noted? Not where there was none.
    [[nodiscard]] bool sees(const Frame& frame) const;
    void note(const Frame& frame);

private:
    bool known_ = false;
    Camera camera_;
    std::vector<WorldLayer> layers_;
    glm::uvec2 size_px_{0};
    bool clamps_depth_ = true;
    DeviceRates rates_;
    std::vector<Light> lights_;
    std::uint64_t objects_ = 0; // ObjectSet::identity()
    std::uint64_t version_ = 0;
};

} // namespace gnomon
