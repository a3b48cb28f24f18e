// SPDX-License-Identifier: Apache-2.0
// Whatever an earlier result's bytes are, they are figures of techniques of different names, or an Error.
#include "bench_figures.h"

#include <gnomon/error.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        const gnomon::app::BenchFigures figures =
            gnomon::app::parseBenchFigures({reinterpret_cast<const char*>(data), size}, "fuzzed");
        std::set<std::string_view> names;
        for (const gnomon::app::TechniqueFigures& technique : figures.techniques) {
            const bool timed = !technique.frame.median || *technique.frame.median >= 0.0;
            if (!timed || !names.insert(technique.name).second) {
                std::abort();
            }
        }
    } catch (const gnomon::Error&) {
        return 0;
    }
    return 0;
}
