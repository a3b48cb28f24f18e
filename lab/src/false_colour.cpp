// SPDX-License-Identifier: Apache-2.0
// Based on:
// - C. A. Brewer, M. Harrower, "ColorBrewer.org: An Online Tool for Selecting Colour Schemes for Maps", 2003: the hues
//   of the error's two sides are the blue of its scheme RdBu and the orange of PuOr, both of the colour-blind-safe
//   kind. Departure: our lightness is the same on both sides, so that equal errors are equally strong, and the middle
//   is white.
// - N. Smith, S. van der Walt, "A Better Default Colormap for Matplotlib", 2015: viridis, for densities and counts.
// - M. Okabe, K. Ito, "Color Universal Design", 2002: the colours of the classes.
// - CIE 15: L*a*b* for white D65; colours between control points are interpolated in it.
#include "false_colour.h"

#include "image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::lab {
namespace {

struct Lab {
    double lightness = 0.0;
    double a = 0.0;
    double b = 0.0;
};
struct LinearColour {
    double red = 0.0;
    double green = 0.0;
    double blue = 0.0;
};

// The white of sRGB, D65, Y = 1.
constexpr double kWhiteX = 0.95047;
constexpr double kWhiteZ = 1.08883;
// CIE 15's exact fractions where the cube root becomes a line.
constexpr double kLabEpsilon = 216.0 / 24389.0;
constexpr double kLabKappa = 24389.0 / 27.0;

double labCurve(double t)
{
    return t > kLabEpsilon ? std::cbrt(t) : (kLabKappa * t + 16.0) / 116.0;
}

double inverseLabCurve(double f)
{
    return f * f * f > kLabEpsilon ? f * f * f : (116.0 * f - 16.0) / kLabKappa;
}

LinearColour decode(Colour colour)
{
    return {decodeSrgb(colour.red / 255.0), decodeSrgb(colour.green / 255.0), decodeSrgb(colour.blue / 255.0)};
}

Colour encode(const LinearColour& light)
{
    return {encodeSrgb(light.red), encodeSrgb(light.green), encodeSrgb(light.blue)};
}

// The matrices are IEC 61966-2-1's primaries against XYZ.
Lab labOf(Colour colour)
{
    const LinearColour c = decode(colour);
    const double x = labCurve((0.4124564 * c.red + 0.3575761 * c.green + 0.1804375 * c.blue) / kWhiteX);
    const double y = labCurve(0.2126729 * c.red + 0.7151522 * c.green + 0.0721750 * c.blue);
    const double z = labCurve((0.0193339 * c.red + 0.1191920 * c.green + 0.9503041 * c.blue) / kWhiteZ);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Colour colourOf(const Lab& lab)
{
    const double f = (lab.lightness + 16.0) / 116.0;
    const double x = inverseLabCurve(f + lab.a / 500.0) * kWhiteX;
    const double y = inverseLabCurve(f);
    const double z = inverseLabCurve(f - lab.b / 200.0) * kWhiteZ;
    return encode({3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                   0.0556434 * x - 0.2040259 * y + 1.0572252 * z});
}

// Evenly spaced points; `t` in [0, 1] goes from the first to the last.
template <std::size_t count>
Colour colourAt(const std::array<Lab, count>& points, double t)
{
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(count - 1);
    const std::size_t first = std::min(static_cast<std::size_t>(place), count - 2);
    const double share = place - static_cast<double>(first);
    const Lab& p = points[first];
    const Lab& q = points[first + 1];
    return colourOf(
        {p.lightness + share * (q.lightness - p.lightness), p.a + share * (q.a - p.a), p.b + share * (q.b - p.b)});
}

constexpr std::array<Lab, 5> kTooDark = {
    {{100.0, 0.0, 0.0}, {86.0, -6.0, -12.0}, {70.0, -10.0, -25.0}, {52.0, -3.0, -38.0}, {32.0, 6.0, -38.0}}};
constexpr std::array<Lab, 5> kTooBright = {
    {{100.0, 0.0, 0.0}, {86.0, 6.0, 29.0}, {70.0, 22.0, 55.0}, {52.0, 31.0, 58.0}, {32.0, 26.0, 40.0}}};

// A picture has a million pixels: colours are looked up. An odd number of steps, so that the middle is a step.
constexpr std::size_t kSteps = 2049;
using Table = std::array<Colour, kSteps>;

Colour lookUp(const Table& table, double t)
{
    return table[static_cast<std::size_t>(std::lround(std::clamp(t, 0.0, 1.0) * (kSteps - 1)))];
}

Table makeErrorTable()
{
    Table table;
    for (std::size_t i = 0; i < kSteps; ++i) {
        const double t = 2.0 * static_cast<double>(i) / (kSteps - 1) - 1.0;
        table[i] = t < 0.0 ? colourAt(kTooDark, -t) : colourAt(kTooBright, t);
    }
    return table;
}

Table makeViridis()
{
    constexpr std::array<Colour, 9> published = {{{0x44, 0x01, 0x54},
                                                  {0x47, 0x2d, 0x7b},
                                                  {0x3b, 0x52, 0x8b},
                                                  {0x2c, 0x72, 0x8e},
                                                  {0x21, 0x91, 0x8c},
                                                  {0x28, 0xae, 0x80},
                                                  {0x5e, 0xc9, 0x62},
                                                  {0xad, 0xdc, 0x30},
                                                  {0xfd, 0xe7, 0x25}}};
    std::array<Lab, published.size()> points;
    std::transform(published.begin(), published.end(), points.begin(), labOf);
    Table table;
    for (std::size_t i = 0; i < kSteps; ++i) {
        table[i] = colourAt(points, static_cast<double>(i) / (kSteps - 1));
    }
    return table;
}

Colour viridis(double t)
{
    static const Table table = makeViridis();
    return lookUp(table, t);
}

} // namespace

std::uint8_t encodeSrgb(double linear)
{
    return static_cast<std::uint8_t>(std::lround(255.0 * gnomon::encodeSrgb(std::clamp(linear, 0.0, 1.0))));
}

Colour errorColour(double error)
{
    static const Table table = makeErrorTable();
    if (std::isnan(error)) {
        return kNotANumber;
    }
    return lookUp(table, 0.5 + 0.5 * std::copysign(std::sqrt(std::abs(error)), error));
}

Colour lightCountColour(std::uint32_t lights)
{
    return lights == 0 ? kLeftOut : viridis(std::log2(static_cast<double>(lights)) / kLightOctaves);
}

Colour densityColour(double texels_per_pixel)
{
    if (std::isnan(texels_per_pixel)) {
        return kNotANumber;
    }
    if (texels_per_pixel <= 0.0) {
        return kLeftOut;
    }
    return viridis(0.5 + 0.5 * std::log2(texels_per_pixel) / kDensityOctaves);
}

Colour classColour(ErrorClass error_class)
{
    // Four of Okabe and Ito's eight that differ in hue and stay apart from each other and from the faint greys for
    // every kind of colour vision. Their bluish green comes too near to blue, orange to vermillion. The fifth is a
    // light green of ours, the farthest from all of these.
    switch (error_class) {
    case ErrorClass::edge:
        return {0x00, 0x72, 0xb2}; // blue
    case ErrorClass::acne:
        return {0xd5, 0x5e, 0x00}; // vermillion
    case ErrorClass::detached:
        return {0xf0, 0xe4, 0x42}; // yellow
    case ErrorClass::bleeding:
        return {0xcc, 0x79, 0xa7}; // reddish purple
    case ErrorClass::terminator:
        return {0x9b, 0xff, 0xaa}; // light green
    case ErrorClass::correct:
        return kFaintLight;
    case ErrorClass::left_out:
        break;
    }
    return kLeftOut;
}

Colour mixLight(Colour a, Colour b, double share_of_b)
{
    const LinearColour p = decode(a);
    const LinearColour q = decode(b);
    return encode({p.red + share_of_b * (q.red - p.red), p.green + share_of_b * (q.green - p.green),
                   p.blue + share_of_b * (q.blue - p.blue)});
}

} // namespace gnomon::lab
