// SPDX-License-Identifier: Apache-2.0
#include "fit/fit.h"

namespace gnomon {
namespace {

struct Row {
    Fit fit;
    FitFunction function;
};
constexpr Row kFits[] = {
    {Fit::uniform, fitUniform}, {Fit::lispsm, fitLispsm}, {Fit::lispsm_simple, fitLispsmSimple},
    {Fit::tsm, fitTsm},         {Fit::psm, fitPsm},       {Fit::scene, fitScene},
};

} // namespace

FitFunction fitFunction(Fit fit)
{
    for (const Row& row : kFits) {
        if (row.fit == fit) {
            return row.function;
        }
    }
    return nullptr;
}

} // namespace gnomon
