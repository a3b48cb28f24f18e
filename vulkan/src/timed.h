// SPDX-License-Identifier: Apache-2.0
// A pass of the profiler for as long as it lives, where there is a profiler.
#pragma once

#include <gnomon/vulkan/profiler.h>

namespace gnomon::vulkan {

class Timed {
public:
    Timed(Profiler* profiler, VkCommandBuffer commands, const char* name) : profiler_(profiler), commands_(commands)
    {
        if (profiler_ != nullptr) {
            profiler_->beginPass(commands, name);
        }
    }
    ~Timed()
    {
        if (profiler_ != nullptr) {
            profiler_->endPass(commands_);
        }
    }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

private:
    Profiler* profiler_;
    VkCommandBuffer commands_;
};

} // namespace gnomon::vulkan
