// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.h"

#include <algorithm>

namespace gnomon {
namespace {

struct Row {
    Fit fit;
    FitFunction function;
};
constexpr Row kFits[] = {
    {Fit::uniform, fitUniform},
};

} // namespace

FitFunction fitFunction(Fit fit)
{
    for (const Row& row : kFits)
        if (row.fit == fit)
            return row.function;
    return nullptr;
}

double usableBorder(double border_texels, std::uint32_t map_size)
{
    return std::min(border_texels, 0.25 * static_cast<double>(map_size));
}

} // namespace gnomon
