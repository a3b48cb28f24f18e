// SPDX-License-Identifier: Apache-2.0
// That the report's colours can be told apart is checked for each kind of colour vision.
// Based on: G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, "A Physiologically-based Model for Simulation of Color
// Vision Deficiency", 2009, table 1 at severity 1.0: matrices on linear RGB.
#include "lab/src/false_colour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::lab {
namespace {

using Triple = std::array<double, 3>;
struct Vision {
    const char* name;
    std::array<Triple, 3> rows;
};
constexpr std::array<Vision, 4> kVisions = {{
    {"normal", {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}}},
    {"protanopia",
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    {"deuteranopia",
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
    {"tritanopia",
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}},
}};

double linearOf(std::uint8_t code)
{
    const double v = code / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// L*a*b* of a colour as one kind of vision has it.
Triple seen(Colour colour, const Vision& vision)
{
    const Triple light = {linearOf(colour.red), linearOf(colour.green), linearOf(colour.blue)};
    Triple s{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            s[i] += vision.rows[i][j] * light[j];
        s[i] = std::clamp(s[i], 0.0, 1.0);
    }
    const auto f = [](double t) {
        return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
    };
    const double x = f((0.4124 * s[0] + 0.3576 * s[1] + 0.1805 * s[2]) / 0.9505);
    const double y = f(0.2126 * s[0] + 0.7152 * s[1] + 0.0722 * s[2]);
    const double z = f((0.0193 * s[0] + 0.1192 * s[1] + 0.9505 * s[2]) / 1.0890);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double lightness(Colour colour)
{
    return seen(colour, kVisions[0])[0];
}

// CIE 1976; 2.3 is just noticeable side by side.
double distance(Colour a, Colour b, const Vision& vision)
{
    const Triple p = seen(a, vision);
    const Triple q = seen(b, vision);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

Colour grey(int code)
{
    const auto value = static_cast<std::uint8_t>(code);
    return {value, value, value};
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(ReportColour, TheSimulationConfusesWhatIsConfused)
{
    const Colour red{200, 60, 40};
    const Colour green{110, 120, 30};
    EXPECT_GT(distance(red, green, kVisions[0]), 60.0);
    EXPECT_LT(distance(red, green, kVisions[2]), 20.0);
    // Why the truth below the class colours is no lighter: their purple has its lightness.
    EXPECT_LT(distance({0xcc, 0x79, 0xa7}, grey(150), kVisions[2]), 15.0);
}

TEST(ReportColour, ErrorIsWhiteAtZeroBlueBelowAndOrangeAbove)
{
    EXPECT_EQ(errorColour(0.0), kWhite);
    EXPECT_EQ(errorColour(-0.0), kWhite);
    EXPECT_EQ(errorColour(kNan), kNotANumber);
    EXPECT_EQ(errorColour(-kInfinity), errorColour(-1.0));
    EXPECT_EQ(errorColour(kInfinity), errorColour(1.0));
    EXPECT_EQ(errorColour(2.0), errorColour(1.0));
    const Colour dark = errorColour(-1.0); // L*a*b* (32, 6, -38)
    EXPECT_NEAR(dark.red, 24, 1);
    EXPECT_NEAR(dark.green, 76, 1);
    EXPECT_NEAR(dark.blue, 135, 1);
    const Colour bright = errorColour(1.0); // L*a*b* (32, 26, 40)
    EXPECT_NEAR(bright.red, 123, 1);
    EXPECT_NEAR(bright.green, 57, 1);
    EXPECT_NEAR(bright.blue, 7, 1);
}

TEST(ReportColour, EqualErrorsAreEquallyLight)
{
    double last = 101.0;
    for (int i = 0; i <= 100; ++i) {
        const double e = i / 100.0;
        EXPECT_NEAR(lightness(errorColour(e)), lightness(errorColour(-e)), 0.6) << e;
        EXPECT_LT(lightness(errorColour(e)), last) << e;
        last = lightness(errorColour(e));
    }
    EXPECT_NEAR(last, 32.0, 0.5);
}

TEST(ReportColour, LeftOutIsNoErrorAndNoDensity)
{
    for (const Vision& vision : kVisions) {
        for (int i = -64; i <= 64; ++i) {
            EXPECT_GT(distance(errorColour(i / 64.0), kLeftOut, vision), 16.0) << vision.name << i;
            EXPECT_GT(distance(densityColour(std::exp2(i / 16.0)), kLeftOut, vision), 16.0) << vision.name << i;
        }
    }
}

TEST(ReportColour, NotANumberIsLikeNothingElse)
{
    std::vector<Colour> others = {kLeftOut, kWhite, kFaintDark, kFaintLight};
    for (int i = -64; i <= 64; ++i) {
        others.push_back(errorColour(i / 64.0));
        others.push_back(densityColour(std::exp2(i / 16.0)));
    }
    for (const ErrorClass c :
         {ErrorClass::edge, ErrorClass::acne, ErrorClass::detached, ErrorClass::bleeding, ErrorClass::terminator})
        others.push_back(classColour(c));
    for (const Vision& vision : kVisions) {
        for (const Colour other : others)
            EXPECT_GT(distance(kNotANumber, other, vision), 15.0) << vision.name;
    }
}

TEST(ReportColour, ClassesAreToldApartByEveryone)
{
    const std::array<ErrorClass, 5> classes = {ErrorClass::edge, ErrorClass::acne, ErrorClass::detached,
                                               ErrorClass::bleeding, ErrorClass::terminator};
    for (const Vision& vision : kVisions) {
        for (std::size_t i = 0; i < classes.size(); ++i) {
            const Colour colour = classColour(classes[i]);
            for (std::size_t j = i + 1; j < classes.size(); ++j)
                EXPECT_GT(distance(colour, classColour(classes[j]), vision), 20.0) << vision.name << i << j;
            for (int code = kFaintDark.red; code <= kFaintLight.red; ++code)
                EXPECT_GT(distance(colour, grey(code), vision), 20.0) << vision.name << i << " on grey " << code;
            EXPECT_GT(distance(colour, kLeftOut, vision), 20.0) << vision.name << i;
        }
    }
    EXPECT_GT(lightness(kFaintDark) - lightness(kLeftOut), 15.0);
    EXPECT_GT(lightness(kFaintLight) - lightness(kFaintDark), 14.0);
    EXPECT_EQ(classColour(ErrorClass::left_out), kLeftOut);
    EXPECT_EQ(classColour(ErrorClass::correct), kFaintLight);
}

// A hue has a name; two blues have one. Angles of a* and b* for normal vision.
TEST(ReportColour, ClassesDifferInHue)
{
    const std::array<ErrorClass, 5> classes = {ErrorClass::edge, ErrorClass::acne, ErrorClass::detached,
                                               ErrorClass::bleeding, ErrorClass::terminator};
    const auto hue = [](ErrorClass error_class) {
        const Triple lab = seen(classColour(error_class), kVisions[0]);
        return std::atan2(lab[2], lab[1]) * 180.0 / 3.14159265358979;
    };
    for (std::size_t i = 0; i < classes.size(); ++i) {
        for (std::size_t j = i + 1; j < classes.size(); ++j) {
            const double apart = std::abs(hue(classes[i]) - hue(classes[j]));
            EXPECT_GT(std::min(apart, 360.0 - apart), 40.0) << i << j;
        }
    }
}

TEST(ReportColour, DensityGrowsLighterOctaveByOctave)
{
    for (const Vision& vision : kVisions) {
        for (int octave = -4; octave < 4; ++octave) {
            const Triple low = seen(densityColour(std::exp2(octave)), vision);
            const Triple high = seen(densityColour(std::exp2(octave + 1)), vision);
            EXPECT_GT(high[0] - low[0], 4.0) << vision.name << octave;
        }
    }
    // Even: with normal vision no octave's step is three times another's.
    double smallest = 1e9;
    double largest = 0.0;
    for (int octave = -4; octave < 4; ++octave) {
        const double step =
            distance(densityColour(std::exp2(octave)), densityColour(std::exp2(octave + 1)), kVisions[0]);
        smallest = std::min(smallest, step);
        largest = std::max(largest, step);
    }
    EXPECT_LT(largest, 3.0 * smallest);
}

} // namespace
} // namespace gnomon::lab
