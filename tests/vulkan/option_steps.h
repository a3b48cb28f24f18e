// SPDX-License-Identifier: Apache-2.0
// Changes of one option each, through all rows of the option table.
#pragma once

#include <gnomon/option_table.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::test {

struct OptionStep {
    ShadowOptions options{.technique = kPlainTechnique};
    std::string what; // "pcf.taps=64"
};

struct OptionSteps {
    std::vector<OptionStep> list;
    std::size_t refused = 0; // values that resolve() refuses, which are not in the list
    std::size_t rows = 0;    // that have a value in the list
};

/// All choices of a row; of numbers the least, one in the middle and the largest, maps staying small.
[[nodiscard]] OptionSteps stepsFrom(const ShadowOptions& base);
/// The options of a line such as "filter=pcf map-size=64": choices and whole numbers.
[[nodiscard]] ShadowOptions optionsFrom(std::string_view line);

/// The options that sequences begin with.
inline constexpr std::array kBases{
    "filter=pcf motion=snap keep-still=always map-size=64",
    "filter=pcf partition=cascades motion=snap keep-still=always map-size=64",
    "filter=hard partition=sdsm keep-still=always map-size=64",
    "filter=pcf partition=auto fit=auto quality=best keep-still=always map-size=64",
    "filter=vsm motion=snap keep-still=always map-size=64",
    "filter=lvsm lvsm.placement=lloyd motion=snap keep-still=always map-size=64",
    "filter=evsm partition=cascades motion=snap keep-still=always map-size=64",
    "filter=msm blur=gaussian motion=snap keep-still=always map-size=64",
    "filter=pcf motion=step-band keep-still=always map-size=64",
    "filter=hard motion=step-blend map-format=rg16 keep-still=always map-size=64",
    "filter=esm motion=step-alternate keep-still=always map-size=64",
    "filter=pcf soften=converge map-size=64",
    "filter=hard partition=sdsm soften=converge map-size=64",
    "filter=pcf soften=blur soften.edges=plain motion=step-alternate map-size=64",
    "filter=hard soften=blur soften.kernel=poisson soften.size=half map-size=64",
    "filter=pcss mask-size=half map-size=64",
    "filter=raymarch partition=virtual texels=65536",
    "filter=pcf soften=smoothies motion=snap keep-still=always map-size=64",
    "filter=smoothies motion=snap keep-still=always map-size=64",
    "filter=smoothies partition=sdsm cascades.pass=layered map-size=64",
};
/// The options of hosts that always give ids of objects.
inline constexpr std::array kBasesOfIds{
    "filter=depth-id id.of=face motion=snap keep-still=always map-size=64",
};
/// A name of letters and digits alone.
[[nodiscard]] std::string nameOfBase(std::string_view line);

} // namespace gnomon::test
