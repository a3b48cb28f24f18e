// SPDX-License-Identifier: Apache-2.0
// The key of a truth by a given tracer.
#pragma once

#include "truth/cache.h"

namespace gnomon::truth {

/// keyOf(), where tracerIdentity() is `identity`.
[[nodiscard]] scene::Hash128 keyBy(std::uint64_t identity, const scene::Scene& scene, const scene::State& state,
                                   const View& view, const Light& light, const Options& options);

} // namespace gnomon::truth
