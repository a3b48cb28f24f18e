// SPDX-License-Identifier: Apache-2.0
// Based on: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
#include "outline.h"

#include <algorithm>
#include <cstddef>

namespace gnomon {
namespace {

double cross2(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

} // namespace

void outlineOf(std::vector<glm::dvec2>& points, std::vector<glm::dvec2>& outline)
{
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    outline.clear();
    const auto chain = [&](auto first, auto last) {
        const std::size_t start = outline.size();
        for (auto p = first; p != last; ++p) {
            while (outline.size() >= start + 2 &&
                   cross2(outline[outline.size() - 2], outline[outline.size() - 1], *p) <= 0.0) {
                outline.pop_back();
            }
            outline.push_back(*p);
        }
        outline.pop_back(); // the other chain begins with it
    };
    chain(points.begin(), points.end());
    chain(points.rbegin(), points.rend());
    if (outline.empty()) { // all are one point
        outline.push_back(points.front());
    }
}

void widenOutline(std::vector<glm::dvec2>& outline, double by, std::vector<glm::dvec2>& scratch)
{
    scratch.clear();
    for (const glm::dvec2& p : outline) {
        for (const glm::dvec2& side :
             {glm::dvec2(-by, -by), glm::dvec2(by, -by), glm::dvec2(by, by), glm::dvec2(-by, by)}) {
            scratch.push_back(p + side);
        }
    }
    outlineOf(scratch, outline);
}

} // namespace gnomon
