// SPDX-License-Identifier: Apache-2.0
#include "sweep.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

namespace gnomon::test {

std::vector<std::uint64_t> sweepPoints(const std::string& name, std::uint64_t count, std::uint64_t most)
{
    const char* const wanted = std::getenv("GNOMON_SWEEP");
    const bool all = wanted != nullptr && std::string_view(wanted) == "all";
    const std::uint64_t first = all ? count : std::min(count, most / 2);
    const std::uint64_t rest = std::max<std::uint64_t>(most - first, 1);
    const std::uint64_t stride = all ? 1 : std::max<std::uint64_t>((count - first + rest - 1) / rest, 1);
    std::vector<std::uint64_t> points;
    for (std::uint64_t point = 1; point <= count; point += point < first ? 1 : stride) {
        points.push_back(point);
    }
    std::cout << "[   sweep  ] " << name << ": " << points.size() << " of " << count << " points\n";
    return points;
}

} // namespace gnomon::test
