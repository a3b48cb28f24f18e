// SPDX-License-Identifier: Apache-2.0
// Whatever the bytes are, reading them ends in a scene that can be evaluated or in an Error; anything else, any other
// exception among it, is a crash. Run it on a copy of a corpus, to which it adds what it finds.
#include "scene/gltf.h"
#include "scene/state.h"

#include <gnomon/error.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace {

/// Small enough that the fuzzer spends its time on logic, not on zeroing memory.
gnomon::scene::Limits smallLimits()
{
    gnomon::scene::Limits limits;
    limits.max_file_bytes = 1U << 20;
    limits.max_total_bytes = 16U << 20;
    limits.max_image_side = 256;
    limits.max_node_depth = 32;
    limits.max_count = 512;
    limits.max_vertices = 1U << 14;
    return limits;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        const gnomon::scene::Scene scene =
            gnomon::scene::readGltf(std::as_bytes(std::span(data, size)), {}, smallLimits());
        gnomon::scene::State state = gnomon::scene::evaluate(scene, 0.25);
        gnomon::scene::advance(scene, 1.5, state);
    } catch (const gnomon::Error&) {
        return 0; // the one way to refuse
    }
    return 0;
}
