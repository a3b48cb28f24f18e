// SPDX-License-Identifier: Apache-2.0
// At which of many points something is made to fail, one after the other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::test {

/// Of the points 1 to `count`: the first ones all, then every k-th, about `most` altogether. Always the same ones; all
/// of them where the environment says GNOMON_SWEEP=all. Prints how many that are, under this name.
[[nodiscard]] std::vector<std::uint64_t> sweepPoints(const std::string& name, std::uint64_t count, std::uint64_t most);

} // namespace gnomon::test
