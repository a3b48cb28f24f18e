// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.h"

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

} // namespace gnomon
