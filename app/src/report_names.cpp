// SPDX-License-Identifier: Apache-2.0
#include "report_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace gnomon::app {
namespace {

constexpr std::array<std::string_view, 4> kNumbered{"mask.png", "error.png", "classes.png", "density.png"};
constexpr std::array<std::string_view, 3> kMoments{"", "_middle", "_last"};
constexpr std::array<std::string_view, 3> kOfMoment{"mask", "error", "classes"};

/// Whether it is the name of a technique's picture, without its number.
bool isNumbered(const std::string& name)
{
    for (const std::string_view moment : kMoments) {
        for (const std::string_view what : kOfMoment) {
            if (name == pictureOf(what, moment)) {
                return true;
            }
        }
    }
    return std::find(kNumbered.begin(), kNumbered.end(), name) != kNumbered.end();
}

/// Whether it is the name of a file that belongs to no technique.
bool isFixed(const std::string& name)
{
    constexpr std::array<std::string_view, 3> kFixed{kReportPage, kReportResult, kReportTruth};
    return std::find(kFixed.begin(), kFixed.end(), name) != kFixed.end() ||
           std::any_of(kMoments.begin(), kMoments.end(),
                       [&](std::string_view moment) { return name == pictureOf("truth", moment); });
}

} // namespace

std::vector<std::string> reportFiles(std::size_t shown)
{
    std::vector<std::string> files{kReportTruth};
    for (std::size_t i = 0; i < shown; ++i) {
        for (const std::string_view what : kNumbered) {
            files.push_back(numbered(i, what));
        }
    }
    files.emplace_back(kReportPage);
    files.emplace_back(kReportResult);
    return files;
}

std::vector<std::string> pathReportFiles(std::size_t shown, const FrameRange& frames)
{
    std::vector<std::string> files;
    for (const std::string_view moment : momentsOf(frames.last - frames.first + 1)) {
        files.push_back(pictureOf("truth", moment));
        for (std::size_t i = 0; i < shown; ++i) {
            for (const std::string_view what : kOfMoment) {
                files.push_back(numbered(i, pictureOf(what, moment)));
            }
        }
    }
    files.emplace_back(kReportPage);
    files.emplace_back(kReportResult);
    return files;
}

bool isReportFile(const std::string& name)
{
    if (isFixed(name)) {
        return true;
    }
    const std::size_t digits = std::min(name.find('_'), name.size());
    return digits >= 2 && digits < name.size() &&
           std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(digits),
                       [](unsigned char c) { return std::isdigit(c) != 0; }) &&
           isNumbered(name.substr(digits + 1));
}

std::string numbered(std::size_t index, std::string_view what)
{
    return fmt::format("{:02}_{}", index + 1, what);
}

std::vector<std::string_view> momentsOf(std::size_t shown_frames)
{
    std::vector<std::string_view> moments{kMoments.front()};
    if (shown_frames > 2) {
        moments.push_back(kMoments[1]);
    }
    if (shown_frames > 1) {
        moments.push_back(kMoments.back());
    }
    return moments;
}

std::string pictureOf(std::string_view what, std::string_view moment)
{
    return fmt::format("{}{}.png", what, moment);
}

} // namespace gnomon::app
