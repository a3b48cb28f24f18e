// SPDX-License-Identifier: Apache-2.0
#include "lab/metrics/error_classes.h"

#include "lab/metrics/same_shape.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace gnomon::lab {
namespace {

using Marks = ImageOf<std::uint8_t>; // 1 where marked, one channel

/// Counted pixels of the penumbra, and both sides of every edge between counted neighbours.
///
/// An edge is looked for in area truth too, though its penumbra would seem enough: at a sharp contact it goes from 0 to
/// 1 between two neighbours with no pixel of penumbra between them.
///
/// Only counted pixels make edges: where the other side is background, or faces away from the light, there is a
/// silhouette and no border of a shadow, and an error beside it is no aliasing.
Marks findEdges(const ImageF& truth, const Counted& counted)
{
    // Half of the 8 neighbours: the other half is seen from the other side.
    constexpr std::array<std::array<int, 2>, 4> kOffsets{{{1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    const auto width = static_cast<std::ptrdiff_t>(truth.width);
    const auto height = static_cast<std::ptrdiff_t>(truth.height);
    Marks marks(truth.width, truth.height, 1);
    for (std::ptrdiff_t y = 0; y < height; ++y) {
        for (std::ptrdiff_t x = 0; x < width; ++x) {
            const std::ptrdiff_t here = y * width + x;
            if (counted.values[here] == 0) {
                continue;
            }
            const double value = truth.values[here];
            if (value > 0.0 && value < 1.0) {
                marks.values[here] = 1;
            }
            for (const auto& [dx, dy] : kOffsets) {
                if (x + dx < 0 || x + dx >= width || y + dy >= height) {
                    continue;
                }
                const std::ptrdiff_t there = here + dy * width + dx;
                const double step = static_cast<double>(truth.values[there]) - value;
                if (counted.values[there] != 0 && std::abs(step) > kEdgeStep) {
                    marks.values[here] = 1;
                    marks.values[there] = 1;
                }
            }
        }
    }
    return marks;
}

/// Marks what lies within kEdgeReachPx of a mark along x and y each: along the rows first, then the columns, which
/// together make the square.
Marks dilate(const Marks& marks)
{
    const std::size_t width = marks.width;
    const std::size_t height = marks.height;
    Marks rows(marks.width, marks.height, 1);
    for (std::size_t y = 0; y < height; ++y) {
        const std::uint8_t* from = marks.values.data() + y * width;
        std::uint8_t* to = rows.values.data() + y * width;
        for (std::size_t x = 0; x < width; ++x) {
            if (from[x] != 0) {
                const std::size_t first = x - std::min<std::size_t>(x, kEdgeReachPx);
                std::fill(to + first, to + std::min<std::size_t>(x + kEdgeReachPx + 1, width), std::uint8_t{1});
            }
        }
    }
    Marks square(marks.width, marks.height, 1);
    for (std::size_t y = 0; y < height; ++y) {
        std::uint8_t* to = square.values.data() + y * width;
        const std::size_t end = std::min<std::size_t>(y + kEdgeReachPx + 1, height);
        for (std::size_t row = y - std::min<std::size_t>(y, kEdgeReachPx); row < end; ++row) {
            const std::uint8_t* from = rows.values.data() + row * width;
            std::transform(from, from + width, to, to, [](std::uint8_t a, std::uint8_t b) { return a | b; });
        }
    }
    return square;
}

/// The class of a counted pixel that is not at the terminator. Where its truth is neither 0 nor 1 it is near an edge;
/// all other pixels are lit or unlit. There a mask in [0, 1] can err to one side only. An error to the other side, or
/// NaN, goes by its place, so that the classes' squares add up to the whole for any mask.
ErrorClass classOf(double e, double truth, bool near_edge, bool blocker_is_near)
{
    if (near_edge) {
        return ErrorClass::edge;
    }
    if (e == 0.0) {
        return ErrorClass::correct;
    }
    if (truth >= 1.0) {
        return ErrorClass::acne;
    }
    return blocker_is_near ? ErrorClass::detached : ErrorClass::bleeding;
}

/// Where the class's squared errors are summed; null where there are none.
double* sumOf(ClassErrors& errors, ErrorClass kind)
{
    switch (kind) {
    case ErrorClass::edge:
        return &errors.edge;
    case ErrorClass::acne:
        return &errors.acne;
    case ErrorClass::detached:
        return &errors.detached;
    case ErrorClass::bleeding:
        return &errors.bleeding;
    case ErrorClass::terminator:
        return &errors.terminator;
    case ErrorClass::left_out:
    case ErrorClass::correct:
        break;
    }
    return nullptr;
}

} // namespace

std::optional<Classification> classifyErrors(const ImageF& test, const ImageF& truth, const Counted& counted,
                                             const Counted& terminator, const ImageF& first_blocker_m,
                                             double scene_diagonal_m)
{
    assert(areMasksOfOneSize(test, truth));
    assert(areMasksOfOneSize(test, counted));
    assert(areMasksOfOneSize(test, terminator));
    assert(areMasksOfOneSize(test, first_blocker_m));
    const auto count = counted.values.size() - std::count(counted.values.begin(), counted.values.end(), 0);
    if (count == 0) {
        return std::nullopt;
    }
    assert(scene_diagonal_m > 0.0); // where nothing is seen there may be no scene
    const double contact_m = kContactShareOfDiagonal * scene_diagonal_m;
    const Marks near_edge = dilate(findEdges(truth, without(counted, terminator)));
    Classification result{ImageOf<ErrorClass>(test.width, test.height, 1, ErrorClass::left_out), {}};
    for (std::size_t i = 0; i < counted.values.size(); ++i) {
        if (counted.values[i] == 0) {
            continue;
        }
        const double e = static_cast<double>(test.values[i]) - static_cast<double>(truth.values[i]);
        const ErrorClass kind = terminator.values[i] != 0 ? ErrorClass::terminator
                                                          : classOf(e, truth.values[i], near_edge.values[i] != 0,
                                                                    first_blocker_m.values[i] < contact_m);
        result.classes.values[i] = kind;
        if (double* sum = sumOf(result.errors, kind)) {
            *sum += e * e;
        }
    }
    ClassErrors& errors = result.errors;
    for (double* sum : {&errors.edge, &errors.acne, &errors.detached, &errors.bleeding, &errors.terminator}) {
        *sum /= static_cast<double>(count);
    }
    return result;
}

} // namespace gnomon::lab
