// SPDX-License-Identifier: Apache-2.0
// Pictures of a comparison: false colour with legends, and a page that shows them beside the numbers.
#pragma once

#include "image/image.h"
#include "lab/metrics/error.h"
#include "lab/metrics/error_classes.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::lab {

/// test - truth from -1 (too dark, blue) over 0 (white) to 1 (too bright, orange-brown), in a diverging map that people
/// with any of the usual colour deficiencies can read; left-out pixels dark grey, NaN magenta. The scale is the square
/// root of |test - truth|, so that an error of 0.01 is seen too.
///
/// This picture and the next two are RGB and get a legend below them: they are higher than what they show, and at
/// least 320 px wide. What is smaller than 320 px is shown larger by the whole factor that fits, and padded on both
/// sides with the legend's dark grey. Precondition: one size, one channel each.
[[nodiscard]] Image8 errorPicture(const ImageF& test, const ImageF& truth, const Counted& counted);

/// One colour-blind-safe colour for each class, which plots have for it too, over a faint grey truth, with a legend
/// that names them. The colour is as strong as the square root of |test - truth|: a pixel near an edge without error
/// stays grey.
[[nodiscard]] Image8 classPicture(const ImageOf<ErrorClass>& classes, const ImageF& test, const ImageF& truth);

/// Texels per pixel on a logarithmic scale from 1/16 to 16 (a sequential map, perceptually even; a white line where it
/// passes through 1), with a legend; 0 (left out) dark grey, NaN magenta.
[[nodiscard]] Image8 densityPicture(const ImageF& texels_per_pixel);

/// Pictures of one frame among several.
struct ReportFrame {
    std::string name; // "frame 30"
    std::string truth_file;
    std::string mask_file;
    std::string error_file;
    std::string class_file;
};
/// A page without script or anything from elsewhere, which a browser shows from the folder it lies in. A picture whose
/// file has no name is left out.
struct ReportTechnique {
    std::string name;
    std::string mask_file; // paths relative to the page, with /
    std::string error_file;
    std::string class_file;
    std::string density_file;        // may be an earlier technique's: then the page points there
    std::vector<ReportFrame> frames; // of a path: shown in their order, instead of the files above
};
struct ReportPlot {
    std::string file; // likewise
    std::string caption;
};
struct Report {
    std::string title;
    std::string truth_file;                                 // shown at the top and again beside every mask
    std::vector<std::pair<std::string, std::string>> facts; // what was compared, how: name and value
    std::vector<ReportPlot> plots;                          // before the table
    std::string table_caption = "Best first.";
    std::vector<std::string> columns;           // of the table, the first the technique's name
    std::vector<std::string> column_meanings;   // none, or as `columns`; empty where the name says it
    std::vector<std::vector<std::string>> rows; // each as long as `columns`
    std::vector<ReportTechnique> techniques;    // as `rows`
    std::vector<std::string> notes;             // sentences
};
/// HTML text in UTF-8; every string is escaped.
[[nodiscard]] std::string reportPage(const Report& report);

} // namespace gnomon::lab
