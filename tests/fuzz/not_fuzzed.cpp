// SPDX-License-Identifier: Apache-2.0
// Functions that settings refer to in the drawing part of the program. The fuzzers leave that part out: it takes
// minutes to compile, and no preset or path gets that far.
#include "app/shot.h"
#include "debug_views.h"
#include "shot_parts.h"

#include <cstdlib>

namespace gnomon::app {

std::vector<std::string_view> debugViewNames()
{
    return {"none"};
}

double timeOf(const Settings& /*settings*/, std::uint32_t /*frame*/)
{
    std::abort(); // asked of a path that is followed
}

std::optional<std::size_t> lightNamed(const Shot& /*shot*/, const Settings& /*settings*/, std::string_view /*name*/)
{
    std::abort(); // asked of a shot that is taken
}

std::vector<std::string_view> lightNames(const Shot& /*shot*/)
{
    std::abort();
}

} // namespace gnomon::app
