// SPDX-License-Identifier: Apache-2.0
// Based on: J. Meeus, "Astronomical Algorithms", 2nd edition, 1998, chapters 13 (height and azimuth of a body,
// equations 13.5 and 13.6), 15 (rising and setting, equation 15.1) and 58 (planar sundials).
#include "course.h"

#include "worlds/sundial.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace gnomon::worlds {

namespace {

constexpr double kHourAngle_rad = std::numbers::pi / 12.0; // the sun's turn in one hour
constexpr double kSecondsPerHour = 3600.0;

/// Unit vector to a body with this local hour angle, which is 0 in the south and grows westwards. Equations 13.5 and
/// 13.6, taken apart into east, up and north.
glm::dvec3 towards(double hour_angle_rad, double declination_rad)
{
    const double sin_latitude = std::sin(SundialWorld::latitude_rad);
    const double cos_latitude = std::cos(SundialWorld::latitude_rad);
    const double sin_declination = std::sin(declination_rad);
    const double cos_declination = std::cos(declination_rad);
    const double east = -cos_declination * std::sin(hour_angle_rad);
    const double up = sin_latitude * sin_declination + cos_latitude * cos_declination * std::cos(hour_angle_rad);
    const double north = cos_latitude * sin_declination - sin_latitude * cos_declination * std::cos(hour_angle_rad);
    return glm::normalize(glm::dvec3(east, up, -north));
}

double hourAngle(double hour)
{
    return (hour - 12.0) * kHourAngle_rad;
}

double heightOf(const glm::dvec3& direction_ws)
{
    return std::asin(std::clamp(-direction_ws.y, -1.0, 1.0));
}

double strengthAt(double height_rad)
{
    const double t =
        (height_rad - SundialWorld::fade_from_rad) / (SundialWorld::fade_to_rad - SundialWorld::fade_from_rad);
    const double c = std::clamp(t, 0.0, 1.0);
    return c * c * (3.0 - 2.0 * c);
}

/// How the sky looks while the sun is at a height. Chosen by eye.
struct Mood {
    float height_deg;
    Environment environment;
    glm::vec3 sunlight; // share of the light's colour
};
constexpr std::array<Mood, 6> kMoods{{
    {-15.0F,
     {{0.008F, 0.014F, 0.036F}, {0.028F, 0.040F, 0.075F}, {0.012F, 0.013F, 0.017F}, 0.75F, 1.55F},
     {1.0F, 0.44F, 0.16F}},
    {-6.0F,
     {{0.060F, 0.090F, 0.215F}, {0.42F, 0.27F, 0.27F}, {0.060F, 0.054F, 0.066F}, 0.62F, 1.55F},
     {1.0F, 0.44F, 0.16F}},
    {1.0F, {{0.15F, 0.22F, 0.42F}, {0.92F, 0.47F, 0.26F}, {0.20F, 0.16F, 0.14F}, 0.42F, 1.6F}, {1.0F, 0.44F, 0.16F}},
    {7.0F, {{0.13F, 0.23F, 0.46F}, {0.86F, 0.60F, 0.40F}, {0.25F, 0.21F, 0.16F}, 0.28F, 1.45F}, {1.0F, 0.66F, 0.38F}},
    {26.0F, {{0.15F, 0.33F, 0.68F}, {0.62F, 0.73F, 0.86F}, {0.26F, 0.26F, 0.18F}, 0.24F, 1.0F}, {1.0F, 0.90F, 0.76F}},
    {50.0F, {{0.13F, 0.33F, 0.74F}, {0.54F, 0.71F, 0.92F}, {0.27F, 0.28F, 0.19F}, 0.24F, 1.0F}, {1.0F, 1.0F, 1.0F}},
}};

Mood moodAt(double height_rad)
{
    const auto height = static_cast<float>(height_rad * 180.0 / std::numbers::pi);
    if (height <= kMoods.front().height_deg) {
        return kMoods.front();
    }
    for (std::size_t i = 1; i < kMoods.size(); ++i) {
        const Mood& a = kMoods[i - 1];
        const Mood& b = kMoods[i];
        if (height < b.height_deg) {
            const float t = (height - a.height_deg) / (b.height_deg - a.height_deg);
            const Environment& from = a.environment;
            const Environment& to = b.environment;
            return {height,
                    {glm::mix(from.sky_zenith, to.sky_zenith, t), glm::mix(from.sky_horizon, to.sky_horizon, t),
                     glm::mix(from.ground, to.ground, t), glm::mix(from.ambient, to.ambient, t),
                     glm::mix(from.exposure, to.exposure, t)},
                    glm::mix(a.sunlight, b.sunlight, t)};
        }
    }
    return kMoods.back();
}

} // namespace

double SundialWorld::hourOf(double time_s)
{
    const double hour = std::fmod(start_hour + time_s * (clock_rate / kSecondsPerHour), 24.0);
    return hour < 0.0 ? hour + 24.0 : hour;
}

double SundialWorld::timeOf(double hour)
{
    const double time_s = std::fmod((hour - start_hour) * (kSecondsPerHour / clock_rate), day_s);
    return time_s < 0.0 ? time_s + day_s : time_s;
}

glm::dvec3 SundialWorld::sunDirection(double time_s)
{
    return -towards(hourAngle(hourOf(time_s)), sun_declination_rad);
}

glm::dvec3 SundialWorld::moonDirection(double time_s)
{
    return -towards(hourAngle(hourOf(time_s)) + std::numbers::pi, moon_declination_rad);
}

double SundialWorld::sunStrength(double time_s)
{
    return strengthAt(heightOf(sunDirection(time_s)));
}

double SundialWorld::moonStrength(double time_s)
{
    return strengthAt(heightOf(moonDirection(time_s)));
}

double SundialWorld::sunriseHour()
{
    // Equation 15.1 with a height of 0: the horizon of an airless earth, as the light here has it.
    return 12.0 - std::acos(-std::tan(latitude_rad) * std::tan(sun_declination_rad)) / kHourAngle_rad;
}

double SundialWorld::sunsetHour()
{
    return 24.0 - sunriseHour();
}

double SundialWorld::hourLineAzimuth(double hour)
{
    const double angle = hourAngle(hour);
    return std::atan2(std::sin(latitude_rad) * std::sin(angle), std::cos(angle));
}

Environment skyAt(double time_s)
{
    return moodAt(heightOf(SundialWorld::sunDirection(time_s))).environment;
}

glm::vec3 sunlightAt(double time_s)
{
    const glm::vec3 tint = moodAt(heightOf(SundialWorld::sunDirection(time_s))).sunlight;
    return tint * static_cast<float>(SundialWorld::sunStrength(time_s));
}

} // namespace gnomon::worlds
