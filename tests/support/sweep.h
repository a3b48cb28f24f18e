// SPDX-License-Identifier: Apache-2.0
// Chooses the points at which a sweep lets something fail, one after the other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::test {

/// Points from 1 to `count`: all of the first ones, then every k-th, about `most` altogether. They are always the same;
/// with GNOMON_SWEEP=all in the environment, all of them. Prints their number under this name.
[[nodiscard]] std::vector<std::uint64_t> sweepPoints(const std::string& name, std::uint64_t count, std::uint64_t most);

} // namespace gnomon::test
