// SPDX-License-Identifier: Apache-2.0
// Whatever a preset's bytes are, they are settings that may be validated, or wrong usage.
#include "app/preset.h"
#include "app/settings.h"

#include <gnomon/error.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    for (const std::uint32_t subcommand : {gnomon::app::kRender, gnomon::app::kCompare}) {
        try {
            gnomon::app::Settings settings;
            gnomon::app::applyPresetText(settings, "fuzzed", {reinterpret_cast<const char*>(data), size}, subcommand);
            gnomon::app::validateSettings(settings);
            (void)gnomon::app::optionsWithoutEffect(settings);
        } catch (const gnomon::app::UsageError&) { // what is wrong with the text
        } catch (const gnomon::Error&) {           // what is wrong with a file that it names
        }
    }
    return 0;
}
