// SPDX-License-Identifier: Apache-2.0
// Section 5 of Hillaire 2020: light along rays, with a table of what gets through the air and one of what is scattered
// more than once.
// Compiled alone: atmosphere.h in double precision.
#define GNOMON_REAL double
#include "host/shaders/atmosphere.h"

#include "atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace gnomon::host {
namespace {

using namespace gnomon::shared::of_double;

constexpr double kPi = std::numbers::pi;
constexpr double kEye_km = 0.1; // a little above the ground, where the horizon is a line
constexpr double kSunRadius_rad = 0.0047;
constexpr double kGroundAlbedo = 0.3; // the whole earth's albedo (Hillaire: 0.3), for light that is scattered up again

/// A function of two numbers in [0, 1] on a grid, linear in between.
struct Grid {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<glm::dvec3> values;

    Grid(std::size_t w, std::size_t h) : width(w), height(h), values(w * h) {}
    [[nodiscard]] glm::dvec3 at(double u, double v) const
    {
        const double x = std::clamp(u, 0.0, 1.0) * static_cast<double>(width - 1);
        const double y = std::clamp(v, 0.0, 1.0) * static_cast<double>(height - 1);
        const std::size_t i = std::min(static_cast<std::size_t>(x), width - 2);
        const std::size_t j = std::min(static_cast<std::size_t>(y), height - 2);
        const glm::dvec3* row = &values[j * width + i];
        const double fx = x - static_cast<double>(i);
        return glm::mix(glm::mix(row[0], row[1], fx), glm::mix(row[width], row[width + 1], fx),
                        y - static_cast<double>(j));
    }
};

double squared(double x)
{
    return x * x;
}

glm::dvec3 decay(const glm::dvec3& depth)
{
    return {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
}

/// The radius where a ray is after `t`, and the cosine of its angle to the vertical there.
double radiusAt(double radius, double up, double t)
{
    return std::sqrt(radius * radius + t * t + 2.0 * radius * up * t);
}

/// A piece of a ray through the air, by what is in its middle.
struct Piece {
    double t_km = 0.0; // its middle, along the ray
    double radius_km = 0.0;
    Air air;
    glm::dvec3 passed{1.0}; // the share of light that gets through
};

/// The k-th of `count` pieces that a ray of length `end` has; they grow with their distance.
Piece pieceOf(double radius, double up, double end, int k, int count)
{
    const double from = end * squared(static_cast<double>(k) / count);
    const double to = end * squared(static_cast<double>(k + 1) / count);
    const double t = 0.5 * (from + to);
    const double r = radiusAt(radius, up, t);
    const Air air = airAt(r - kEarth_km);
    return {t, r, air, decay(air.lost * (to - from))};
}

class Atmosphere {
public:
    Atmosphere()
    {
        fillThrough();
        fillManifold();
    }

    /// The share of a light from outside that reaches a place, where the horizon may cut the light's disc.
    [[nodiscard]] glm::dvec3 through(double radius, double up) const
    {
        const double rho = std::sqrt(std::max(radius * radius - kEarth_km * kEarth_km, 0.0));
        const double horizon = -rho / radius; // sine of the horizon's height
        const double shown = std::clamp(0.5 + 0.5 * (up - horizon) / kSunRadius_rad, 0.0, 1.0);
        if (shown <= 0.0) {
            return glm::dvec3(0.0);
        }
        const double seen = std::max(up, horizon + 1e-9);
        const double shortest = kEarth_km + kAir_km - radius;
        const double longest = rho + kWidest_km;
        const double t = toTheTop_km(radius, seen);
        return through_.at((t - shortest) / (longest - shortest), rho / kWidest_km) * shown;
    }
    /// The light that was scattered more than once, which comes from everywhere.
    [[nodiscard]] glm::dvec3 manifold(double radius, double up) const
    {
        const double angle = std::asin(std::clamp(up, -1.0, 1.0));
        const double s = std::copysign(std::sqrt(std::abs(angle) / (kPi / 2.0)), angle);
        return manifold_.at((s - kLowest) / (1.0 - kLowest), std::sqrt(std::max(radius - kEarth_km, 0.0) / kAir_km));
    }

private:
    static constexpr double kWidest_km = 1132.0; // from the ground along the horizon to the top
    static constexpr double kLowest = -0.5;      // -sqrt(height / 90 degrees): 22.5 degrees below the horizon

    void fillThrough()
    {
        constexpr int kSteps = 40;
        for (std::size_t j = 0; j < through_.height; ++j) {
            const double rho = kWidest_km * static_cast<double>(j) / static_cast<double>(through_.height - 1);
            const double radius = std::sqrt(rho * rho + kEarth_km * kEarth_km);
            const double top = kEarth_km + kAir_km;
            for (std::size_t i = 0; i < through_.width; ++i) {
                const double share = static_cast<double>(i) / static_cast<double>(through_.width - 1);
                const double t = (top - radius) + share * (rho + kWidest_km - (top - radius));
                const double up =
                    t > 0.0 ? std::clamp((top * top - radius * radius - t * t) / (2.0 * radius * t), -1.0, 1.0) : 1.0;
                glm::dvec3 depth(0.0);
                for (int k = 0; k < kSteps; ++k) {
                    const double from = t * squared(static_cast<double>(k) / kSteps);
                    const double to = t * squared(static_cast<double>(k + 1) / kSteps);
                    depth += airAt(radiusAt(radius, up, 0.5 * (from + to)) - kEarth_km).lost * (to - from);
                }
                through_.values[j * through_.width + i] = decay(depth);
            }
        }
    }

    void fillManifold()
    {
        for (std::size_t j = 0; j < manifold_.height; ++j) {
            const double radius =
                kEarth_km +
                std::max(kAir_km * squared(static_cast<double>(j) / static_cast<double>(manifold_.height - 1)), 0.01);
            for (std::size_t i = 0; i < manifold_.width; ++i) {
                const double s =
                    kLowest + (1.0 - kLowest) * static_cast<double>(i) / static_cast<double>(manifold_.width - 1);
                manifold_.values[j * manifold_.width + i] =
                    manifoldAt(radius, std::sin(std::copysign(s * s, s) * kPi / 2.0));
            }
        }
    }

    /// Equations 5 to 10: the second scattering, and all further ones as a geometric series of it.
    [[nodiscard]] glm::dvec3 manifoldAt(double radius, double sun_up) const
    {
        constexpr int kHeights = 8;
        constexpr int kAzimuths = 3;
        glm::dvec3 second(0.0);
        glm::dvec3 again(0.0);
        for (int a = 0; a < kHeights; ++a) {
            const double up = -1.0 + (2.0 * a + 1.0) / kHeights;
            for (int b = 0; b < kAzimuths; ++b) {
                const double along = std::cos(kPi * (b + 0.5) / kAzimuths);
                addSecond(radius, sun_up, up, along, second, again);
            }
        }
        constexpr double kMean = 1.0 / (kHeights * kAzimuths);
        return second * kMean / (1.0 - again * kMean);
    }

    void addSecond(double radius, double sun_up, double up, double along, glm::dvec3& second, glm::dvec3& again) const
    {
        constexpr int kSteps = 16;
        const double ground = toTheGround_km(radius, up);
        const double end = ground >= 0.0 ? ground : toTheTop_km(radius, up);
        const double towards = up * sun_up + along * std::sqrt((1.0 - up * up) * (1.0 - sun_up * sun_up));
        glm::dvec3 left(1.0);
        for (int k = 0; k < kSteps; ++k) {
            const auto [t, r, air, passed] = pieceOf(radius, up, end, k, kSteps);
            const glm::dvec3 scattered =
                left * (air.molecules + air.dust) * (1.0 - passed) / glm::max(air.lost, glm::dvec3(1e-12));
            second += scattered * kQuarterOverPi * through(r, (radius * sun_up + t * towards) / r);
            again += scattered;
            left *= passed;
        }
        if (ground >= 0.0) {
            const double level = (radius * sun_up + end * towards) / kEarth_km;
            second += left * (kGroundAlbedo / kPi * std::max(level, 0.0)) * through(kEarth_km + 0.001, level);
        }
    }

    Grid through_{64, 32};
    Grid manifold_{64, 8};
};

const Atmosphere& atmosphere()
{
    static const Atmosphere one;
    return one;
}

/// One ray from the ground to the top.
void march(double up, double along, double sun_up, glm::dvec3& molecules, glm::dvec3& dust)
{
    constexpr int kSteps = 30;
    const Atmosphere& air_of = atmosphere();
    const double radius = kEarth_km + kEye_km;
    const double end = toTheTop_km(radius, up);
    const double towards = up * sun_up + along * std::sqrt((1.0 - up * up) * (1.0 - sun_up * sun_up));
    const double phase = moleculesPhase(towards);
    glm::dvec3 left(1.0);
    molecules = dust = glm::dvec3(0.0);
    for (int k = 0; k < kSteps; ++k) {
        const auto [t, r, air, passed] = pieceOf(radius, up, end, k, kSteps);
        const glm::dvec3 seen = left * (1.0 - passed) / glm::max(air.lost, glm::dvec3(1e-12));
        const double sun_there = (radius * sun_up + t * towards) / r;
        const glm::dvec3 lit = air_of.through(r, sun_there);
        molecules += seen * (air.molecules * phase * lit + (air.molecules + air.dust) * air_of.manifold(r, sun_there));
        dust += seen * air.dust * lit;
        left *= passed;
    }
}

/// Real spherical harmonics of the upper half, symmetrical about +x, as plain moments: of 1, x, y, xx, yy, xy, zz.
struct Moments {
    glm::dvec3 one{0.0};
    glm::dvec3 x{0.0};
    glm::dvec3 y{0.0};
    glm::dvec3 xx{0.0};
    glm::dvec3 yy{0.0};
    glm::dvec3 zz{0.0};
    glm::dvec3 xy{0.0};

    void add(double up, double along, const glm::dvec3& light)
    {
        const double level = std::sqrt(std::max(1.0 - up * up, 0.0));
        const double dx = level * along;
        const double dz2 = level * level * (1.0 - along * along);
        one += light;
        x += light * dx;
        y += light * up;
        xx += light * (dx * dx);
        yy += light * (up * up);
        zz += light * dz2;
        xy += light * (dx * up);
    }
    /// Ramamoorthi and Hanrahan's equation 11 over pi: each order's moments times 1, 2/3 and 1/4 and its harmonics'
    /// squared norms, which are 1 / 4 pi, 3 / 4 pi and 15 / 4 pi (xy), 15 / 16 pi (xx - zz), 5 / 16 pi (3 yy - 1).
    [[nodiscard]] Skylight skylight() const
    {
        Skylight s;
        const glm::dvec3 level = (3.0 * yy - one) * (5.0 / (64.0 * kPi));
        for (int c = 0; c < 3; ++c) {
            s.linear[c] = {x[c] / (2.0 * kPi), y[c] / (2.0 * kPi), 0.0, one[c] / (4.0 * kPi) - level[c]};
            s.square[c] = {xy[c] * 15.0 / (16.0 * kPi), 0.0, 3.0 * level[c], 0.0};
        }
        s.across = (xx - zz) * (15.0 / (64.0 * kPi));
        return s;
    }
};

/// Where the border between a sample and the next lies.
double borderAfter(std::size_t i, std::size_t count)
{
    return i + 1 == count ? 1.0 : (static_cast<double>(i) + 0.5) / static_cast<double>(count - 1);
}

} // namespace

glm::dvec3 Skylight::on(const glm::dvec3& n) const
{
    glm::dvec3 light = across * (n.x * n.x - n.z * n.z);
    for (int c = 0; c < 3; ++c) {
        light[c] += glm::dot(linear[c], glm::dvec4(n, 1.0)) +
                    glm::dot(square[c], glm::dvec4(n.x * n.y, n.y * n.z, n.y * n.y, n.x * n.z));
    }
    return light;
}

void Skylight::add(const Skylight& other, const glm::dvec3& times)
{
    for (int c = 0; c < 3; ++c) {
        linear[c] += other.linear[c] * times[c];
        square[c] += other.square[c] * times[c];
    }
    across += other.across * times;
}

void Skylight::addGround(const glm::dvec3& radiance)
{
    for (int c = 0; c < 3; ++c) {
        linear[c] += radiance[c] * glm::dvec4(0.0, -0.5, 0.0, 0.5);
    }
}

void Skylight::addSky(const glm::dvec3& radiance)
{
    for (int c = 0; c < 3; ++c) {
        linear[c] += radiance[c] * glm::dvec4(0.0, 0.5, 0.0, 0.5);
    }
}

Skylight Skylight::turned(double x, double z) const
{
    const double length = std::sqrt(x * x + z * z);
    const double a = length > 0.0 ? x / length : 1.0;
    const double b = length > 0.0 ? z / length : 0.0;
    Skylight t = *this; // x becomes a x + b z, and z a z - b x
    for (int c = 0; c < 3; ++c) {
        const glm::dvec4& l = linear[c];
        const glm::dvec4& s = square[c];
        t.linear[c] = {a * l.x - b * l.z, l.y, b * l.x + a * l.z, l.w};
        t.square[c] = {a * s.x - b * s.y, b * s.x + a * s.y, s.z, (a * a - b * b) * s.w + 4.0 * a * b * across[c]};
        t.across[c] = across[c] * (a * a - b * b) - a * b * s.w;
    }
    return t;
}

glm::dvec3 lightThroughAir(double sine)
{
    return atmosphere().through(kEarth_km, sine);
}

void fillSkyUnder(double sine, SkyUnder& sky)
{
    Moments moments;
    sky.largest = 1e-30;
    double below_up = 0.0;
    for (std::size_t j = 0; j < SkyUnder::up; ++j) {
        const double above_up = squared(borderAfter(j, SkyUnder::up));
        double before_rad = 0.0;
        for (std::size_t i = 0; i < SkyUnder::across; ++i) {
            const glm::dvec2 place(static_cast<double>(i) / (SkyUnder::across - 1),
                                   static_cast<double>(j) / (SkyUnder::up - 1));
            const glm::dvec2 way = skyTableDirection(place);
            glm::dvec3 molecules;
            glm::dvec3 dust;
            march(way.x, way.y, sine, molecules, dust);
            sky.molecules[j * SkyUnder::across + i] = glm::vec3(molecules);
            sky.dust[j * SkyUnder::across + i] = glm::vec3(dust);
            const glm::dvec3 most = glm::max(molecules, dust);
            sky.largest = std::max({sky.largest, most.x, most.y, most.z});
            const double after_rad = 2.0 * std::asin(borderAfter(i, SkyUnder::across));
            const double solid = 2.0 * (above_up - below_up) * (after_rad - before_rad); // both sides
            before_rad = after_rad;
            const double mid_up = 0.5 * (above_up + below_up);
            const double towards = way.x * sine + way.y * std::sqrt((1.0 - way.x * way.x) * (1.0 - sine * sine));
            moments.add(mid_up, way.y, (molecules + dust * dustPhase(towards)) * solid);
        }
        below_up = above_up;
    }
    sky.direct = lightThroughAir(sine);
    sky.diffuse = moments.y;
    sky.light = moments.skylight();
}

} // namespace gnomon::host
