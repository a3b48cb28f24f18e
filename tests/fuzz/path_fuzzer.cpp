// SPDX-License-Identifier: Apache-2.0
// Whatever a path's bytes are, they are keys with finite values between them, or an Error.
#include "app/keyframes.h"

#include <gnomon/error.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        const gnomon::app::Keyframes frames =
            gnomon::app::parseKeyframes({reinterpret_cast<const char*>(data), size}, "fuzzed");
        for (const auto* track : {&frames.eye_ws, &frames.target_ws, &frames.fov_deg, &frames.sun_ws, &frames.time_s}) {
            for (const double at_s : {-1.0, 0.0, 0.3, 1.0, 7.7, 1e9}) {
                if (track->empty()) {
                    continue;
                }
                const glm::dvec3 value = track->at(at_s);
                if (!std::isfinite(value.x + value.y + value.z)) {
                    std::abort();
                }
            }
        }
    } catch (const gnomon::Error&) {
        return 0;
    }
    return 0;
}
