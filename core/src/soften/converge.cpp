// SPDX-License-Identifier: Apache-2.0
// Based on: H. Weyl, "Ueber die Gleichverteilung von Zahlen mod. Eins", 1916 (that steps of independent irrational
// lengths fill all dimensions together); H. Vogel, "A better way to construct the sunflower head", 1979 (the disc, by
// turns of the golden section). Departure: radii come in steps too, not in order, so that any run of frames covers the
// disc. Among some twenty such steps these had the least error, over all half-planes, of the first 16 frames' mean.
#include <gnomon/converge.h>

#include <cmath>
#include <numbers>

namespace gnomon {
namespace {

/// Evenly over [-0.5, 0.5), from 0 on.
double stepped(std::uint64_t frame, double step)
{
    const double turns = static_cast<double>(frame) * step + 0.5;
    return turns - std::floor(turns) - 0.5;
}

} // namespace

ConvergeSample convergeSample(std::uint64_t frame)
{
    // No sum of whole multiples of these is whole, so none of the dimensions repeats what another one does.
    constexpr double kTurn = 0.6180339887498949;                           // the golden section
    constexpr double kArea = 0.5698402909980532;                           // 1 / g^2, where g^3 = g + 1
    constexpr double kDepth = 0.3166247903553998;                          // sqrt(11)
    constexpr double kGrid[] = {0.41421356237309503, 0.7320508075688772};  // sqrt(2), sqrt(3)
    constexpr double kPixel[] = {0.23606797749978969, 0.6457513110645906}; // sqrt(5), sqrt(7)
    ConvergeSample sample;
    const double turns = static_cast<double>(frame) * kArea;
    const double area = turns - std::floor(turns); // area of the disc within the point's radius: 0 at first
    const double radius = std::sqrt(area);
    const double angle = 2.0 * std::numbers::pi * stepped(frame, kTurn);
    // Points that are evenly spread over the sphere in four dimensions are even over the disc in any two of them
    // (Archimedes' theorem, two dimensions up).
    const double depth = std::sqrt(1.0 - area) * std::sin(2.0 * std::numbers::pi * stepped(frame, kDepth));
    sample.light = {radius * std::cos(angle), radius * std::sin(angle), depth};
    sample.grid_texels = {stepped(frame, kGrid[0]), stepped(frame, kGrid[1])};
    sample.pixel_px = {stepped(frame, kPixel[0]), stepped(frame, kPixel[1])};
    return sample;
}

} // namespace gnomon
