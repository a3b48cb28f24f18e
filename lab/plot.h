// SPDX-License-Identifier: Apache-2.0
// Line plots as SVG text.
#pragma once

#include "lab/metrics/error_classes.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::lab {

struct PlotLine {
    std::string name;
    std::vector<double> values;                 // as many as Plot::x; NaN leaves a gap
    bool emphasised = false;                    // a wide pale band below the other lines, for what they add up to
    std::optional<ErrorClass> error_class = {}; // has its colour in classPicture(); else one by the line's place
};
struct Plot {
    std::string title;
    std::string x_label; // with its unit
    std::string y_label;
    std::vector<double> x; // ascending
    std::vector<PlotLine> lines;
    bool x_logarithmic = false; // all x > 0
    bool y_logarithmic = false; // values <= 0 leave a gap
};

/// A self-contained SVG of 860 x 480 with axes, round ticks (a logarithmic x of few values has its ticks at these), and
/// lines told apart by colour, dash and a marker, so that
/// they can be read without colour. Names are escaped. The same input gives the same bytes on every machine.
[[nodiscard]] std::string plotSvg(const Plot& plot);

} // namespace gnomon::lab
