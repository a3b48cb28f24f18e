// SPDX-License-Identifier: Apache-2.0
// Based on: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", 2020, the colour pipeline, with the constants that its authors publish.
// Equations are numbered here, (F1) to (F9), in the order in which the method uses them; the rest are in flip.cpp and
// flip_filters.cpp.
#include "flip_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::lab::flip_parts {
namespace {

using Row = std::array<double, 3>;
using Matrix = std::array<Row, 3>;

// XYZ from linear RGB under D65, and its inverse as published, which is good to single precision.
constexpr Matrix kXyzFromLinear{{
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0},
}};
constexpr Matrix kLinearFromXyz{{
    {3.241003275, -1.537398934, -0.498615861},
    {-0.969224334, 1.875930071, 0.041554224},
    {0.055639423, -0.204011202, 1.057148933},
}};

// The white point is the XYZ of (1, 1, 1), published as 0.950428545, 1, 1.088900371.
constexpr double whiteOf(const Row& row)
{
    return row[0] + row[1] + row[2];
}
constexpr Row kWhite{whiteOf(kXyzFromLinear[0]), whiteOf(kXyzFromLinear[1]), whiteOf(kXyzFromLinear[2])};

constexpr double kExponent = 0.7;       // q_c
constexpr double kShareOfLargest = 0.4; // p_c: below this share of the largest distance ...
constexpr double kShareOfRange = 0.95;  // p_t: ... the result lies within this share of [0, 1]

double dot(const Row& row, double x, double y, double z)
{
    return row[0] * x + row[1] * y + row[2] * z;
}

/// XYZ relative to white.
struct RelativeXyz {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

RelativeXyz relativeXyz(const LinearRgb& rgb)
{
    return {dot(kXyzFromLinear[0], rgb.r, rgb.g, rgb.b) / kWhite[0],
            dot(kXyzFromLinear[1], rgb.r, rgb.g, rgb.b) / kWhite[1],
            dot(kXyzFromLinear[2], rgb.r, rgb.g, rgb.b) / kWhite[2]};
}

/// CIE 1976: the cube root, with a tangent line near 0.
double compress(double relative)
{
    constexpr double kDelta = 6.0 / 29.0;
    if (relative > kDelta * kDelta * kDelta) {
        return std::cbrt(relative);
    }
    return relative / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

} // namespace

LinearRgb clampToCube(const LinearRgb& rgb)
{
    return {std::clamp(rgb.r, 0.0, 1.0), std::clamp(rgb.g, 0.0, 1.0), std::clamp(rgb.b, 0.0, 1.0)};
}

// (F1) Y = 116 Y/Yn - 16, Cx = 500 (X/Xn - Y/Yn), Cz = 200 (Y/Yn - Z/Zn): L*a*b* without its cube root, so that
// filtering it is filtering light.
Opponent opponentFromLinear(const LinearRgb& rgb)
{
    const RelativeXyz xyz = relativeXyz(rgb);
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

LinearRgb linearFromOpponent(const Opponent& colour)
{
    const double relative_y = luminance(colour.y);
    const double x = (relative_y + colour.cx / 500.0) * kWhite[0];
    const double y = relative_y * kWhite[1];
    const double z = (relative_y - colour.cz / 200.0) * kWhite[2];
    return {dot(kLinearFromXyz[0], x, y, z), dot(kLinearFromXyz[1], x, y, z), dot(kLinearFromXyz[2], x, y, z)};
}

// (F4) L*a*b*, then a_h = 0.01 L* a*, b_h = 0.01 L* b*.
HuntLab huntLabFromLinear(const LinearRgb& rgb)
{
    const RelativeXyz xyz = relativeXyz(rgb);
    const double x = compress(xyz.x);
    const double y = compress(xyz.y);
    const double z = compress(xyz.z);
    const double lightness = 116.0 * y - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

double luminance(double opponent_y)
{
    return (opponent_y + 16.0) / 116.0;
}

// (F5) |dL*| + sqrt(da_h^2 + db_h^2)
double hyab(const HuntLab& first, const HuntLab& second)
{
    const double da = first.a - second.a;
    const double db = first.b - second.b;
    return std::abs(first.l - second.l) + std::sqrt(da * da + db * db);
}

// (F6) c_max = HyAB(green, blue)^q_c: of the cube's colours these two are farthest apart.
Redistribution::Redistribution()
    : largest_(std::pow(hyab(huntLabFromLinear({0.0, 1.0, 0.0}), huntLabFromLinear({0.0, 0.0, 1.0})), kExponent))
{
}

// (F7) Two lines through (0, 0), (p_c c_max, p_t) and (c_max, 1), of HyAB^q_c.
double Redistribution::operator()(double hyab_distance) const
{
    const double distance = std::pow(hyab_distance, kExponent);
    const double knee = kShareOfLargest * largest_;
    if (distance < knee) {
        return kShareOfRange / knee * distance;
    }
    // min keeps the result within its range when the filter's rounding puts a colour past a corner of the cube; its
    // arguments' order lets what is not a number through.
    return std::min(kShareOfRange + (distance - knee) / (largest_ - knee) * (1.0 - kShareOfRange), 1.0);
}

} // namespace gnomon::lab::flip_parts
