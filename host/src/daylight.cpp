// SPDX-License-Identifier: Apache-2.0
// Photometry is absolute here: lux and candela per square metre, until the exposure makes a picture of them.
// Illuminance of the full moon: S. Urban, P. Seidelmann (ed.), "Explanatory Supplement to the Astronomical Almanac",
// 2013. Compiled alone: adaptation.h in double precision.
#define GNOMON_REAL double
#include "host/shaders/adaptation.h"

#include "daylight.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace gnomon::host {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSun_lx = 128000.0; // outside the air
constexpr double kMoon_lx = 0.32;    // full, outside the air
constexpr double kStars_lx = 0.002;  // with airglow, on level ground
constexpr double kDarkest_lx = 0.03; // eyes get used to no less light than that
const glm::dvec3 kStarlight{0.8, 1.0, 1.3};
/// The value of a white surface square to the brightest light, before the tone curve, where the sky is about 0.6:
/// ToneCurve::neutral then takes it to 0.95 of its range, and a grey of 18 % to a middle tone. Under a physical sky
/// that is so on a sunny day.
constexpr double kKey = 1.35;
/// The exposure is chosen for the sky and for things of a mean albedo.
constexpr double kMeanAlbedo = 0.2;
/// Light that has bounced off the surroundings is nowhere else accounted for. The physical sky has a ground.
constexpr double kBounced = 1.5;
constexpr double kBouncedToo = 1.25;

double luminance(const glm::dvec3& c)
{
    return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

double brightest(const glm::dvec3& c)
{
    return std::max({c.x, c.y, c.z});
}

double smoothStep(double from, double to, double x)
{
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double sineOf(const ShadedLight& light)
{
    return std::clamp(-light.caster.direction_ws.y, -1.0, 1.0);
}

/// The light that the sky is the sky of: the sun, or else the brightest that comes from above.
const ShadedLight* sunAmong(std::span<const ShadedLight> lights)
{
    const ShadedLight* best = nullptr;
    for (const ShadedLight& light : lights) {
        if (light.caster.type != LightType::directional || light.body == scene::Body::moon) {
            continue;
        }
        if (light.body == scene::Body::sun) {
            return &light;
        }
        constexpr double kLowest = 0.02; // a degree: what comes from lower is no sun
        const bool is_sun = sineOf(light) > kLowest && luminance(light.colour) > 0.0;
        if (is_sun && (best == nullptr || luminance(light.colour) > luminance(best->colour))) {
            best = &light;
        }
    }
    return best;
}

const ShadedLight* moonAmong(std::span<const ShadedLight> lights)
{
    const auto found = std::find_if(lights.begin(), lights.end(), [](const ShadedLight& light) {
        return light.caster.type == LightType::directional && light.body == scene::Body::moon;
    });
    return found != lights.end() ? &*found : nullptr;
}

/// How much of a body's light its world lets through, whatever colour it gives it: of the colour the air knows more.
double fadeOf(const ShadedLight& light)
{
    return brightest(light.strength);
}

/// A dome stands for all surfaces that see the sky: the mean illuminance of a hemisphere, by its projected area for the
/// light itself, and by how much of the sky each part sees.
double onDome(double direct, double sine, double diffuse)
{
    return (sine > 0.0 ? direct * (1.0 + sine) / 4.0 : 0.0) + 0.75 * diffuse;
}

/// Light that an eye gets used to.
struct Surroundings {
    double dome_lx = 0.0;
    double sky_lx = 0.0; // illuminance of level ground by the sky alone

    [[nodiscard]] double luminance() const
    {
        return std::max(kMeanAlbedo * dome_lx + sky_lx, kMeanAlbedo * kDarkest_lx) / kPi;
    }
};

/// Picture value of 1 cd/m2 for an eye in them.
double exposureFor(const Surroundings& around)
{
    constexpr Surroundings kNoon{52000.0, 10600.0}; // under a sun at 50 degrees,
    constexpr double kNoonSun_lx = 101000.0;        // which gives so much
    using shared::of_double::adaptedKey;
    const double used_to = around.luminance();
    const double noon = kNoon.luminance();
    // Chosen by eye: by all of the article's stops a dusk is too dark to be read on a screen.
    const double key = std::pow(adaptedKey(used_to) / adaptedKey(noon), 0.75);
    return kKey * key * (noon / used_to) * (kPi / kNoonSun_lx);
}

/// A physical frame in the making.
struct Hour {
    const ShadedLight* sun = nullptr;
    const ShadedLight* moon = nullptr;                                                     // or none
    std::array<glm::dvec3, kSkyBodies> outside{glm::dvec3(kSun_lx), glm::dvec3(kMoon_lx)}; // the air
    glm::dvec3 level = kStars_lx * kStarlight; // illuminance of level ground
    Surroundings around{0.75 * kStars_lx, kStars_lx};
    double unit_lx = 1.0;  // lux per unit of the scene's lights
    double camera = 1.0;   // the factor that its user puts on the exposure
    double exposure = 1.0; // picture value of 1 cd/m2

    [[nodiscard]] bool ownSun() const { return sun->body == scene::Body::sun; }

    /// Finds the light of the ground from the bodies in the sky.
    void look(const FrameLight& light)
    {
        for (std::size_t i = 0; i < kSkyBodies; ++i) {
            const SkyBody& body = light.bodies[i];
            if (body.under == nullptr) {
                continue;
            }
            const double sine = body.towards_ws.y;
            const glm::dvec3 direct = outside[i] * body.under->direct;
            const glm::dvec3 diffuse = outside[i] * body.under->diffuse;
            level += direct * std::max(sine, 0.0) + diffuse;
            around.dome_lx += onDome(luminance(direct), sine, luminance(diffuse));
            around.sky_lx += luminance(diffuse);
        }
    }

    /// A sun of ours says what it gives from above, one of a file what arrives.
    void measure(std::span<const ShadedLight> lights, std::span<const double> given)
    {
        const double sun_lx = kSun_lx * luminance(lightThroughAir(ownSun() ? 1.0 : sineOf(*sun)));
        unit_lx = sun_lx / std::max(luminance(sun->colour), 1e-30);
        double others_lx = 0.0;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            if (&lights[i] != sun && &lights[i] != moon) {
                others_lx = std::max(others_lx, unit_lx * given[i]);
            }
        }
        exposure = camera * exposureFor({around.dome_lx + 0.25 * others_lx, around.sky_lx});
    }

    void exposeLights(std::span<const ShadedLight> lights, FrameLight& out) const
    {
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const ShadedLight& one = lights[i];
            glm::dvec3 given_lx = unit_lx * glm::dvec3(one.colour * one.strength);
            if (&one == moon || (&one == sun && ownSun())) {
                given_lx = outside[&one == moon ? 1 : 0] * lightThroughAir(sineOf(one)) * fadeOf(one);
            }
            out.colours[i] = given_lx * (exposure / kPi);
        }
    }

    void exposeSky(const scene::Environment& environment, FrameLight& out) const
    {
        out.ground = glm::dvec3(environment.ground_albedo) * level * (exposure / kPi);
        out.night = kStarlight * (kStars_lx * exposure / kPi);
        out.skylight.addGround(out.ground * kBouncedToo);
        out.skylight.addSky(out.night * kBouncedToo);
        for (std::size_t i = 0; i < kSkyBodies; ++i) {
            SkyBody& body = out.bodies[i];
            if (body.under == nullptr) {
                continue;
            }
            body.times = outside[i] * exposure;
            out.skylight.add(body.under->light.turned(body.towards_ws.x, body.towards_ws.z), body.times * kBouncedToo);
            const glm::dvec3 colour = body.under->direct * outside[i];
            // A disc is far beyond what a screen shows: it has the colour, and is as bright as a lamp.
            const double bright = i == 0 ? 12.0 : 1.6;
            body.disc = colour * (camera * bright / std::max(brightest(colour), 1e-30));
        }
        const double darkness = std::log10(around.dome_lx);
        out.emission = camera;
        out.lamps = camera * smoothStep(3.2, 1.5, darkness);  // from 1600 lx, at sunset, to 30 lx
        out.stars = camera * smoothStep(0.5, -1.3, darkness); // from 3 lx to 0.05 lx
        out.night_sky = out.stars > 0.0 || out.bodies[1].under != nullptr;
    }
};

} // namespace

double exposureOf(std::span<const double> given, const scene::Environment& environment)
{
    const double most = given.empty() ? 0.0 : std::ranges::max(given);
    return most > 0.0 ? kKey * environment.exposure / most : environment.exposure;
}

const FrameLight& Daylight::at(SkyModel sky, double exposure_ev, std::span<const ShadedLight> lights,
                               std::span<const double> given, const scene::Environment& environment)
{
    assert(given.size() == lights.size());
    light_.bodies = {};
    light_.skylight = {};
    light_.physical = sky == SkyModel::physical && sunAmong(lights) != nullptr;
    if (light_.physical) {
        fillPhysical(lights, given, environment, exposure_ev);
    } else {
        scene::Environment exposed = environment;
        exposed.exposure *= static_cast<float>(std::exp2(exposure_ev));
        fillPlain(lights, given, exposed);
    }
    return light_;
}

void Daylight::fillPlain(std::span<const ShadedLight> lights, std::span<const double> given,
                         const scene::Environment& environment)
{
    const double exposure = exposureOf(given, environment);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        light_.colours[i] = glm::dvec3(lights[i].colour * lights[i].strength) * exposure;
    }
    light_.emission = environment.exposure;
    light_.lamps = 0.0;
    light_.stars = 0.0;
    light_.night_sky = false;
    light_.zenith = glm::dvec3(environment.sky_zenith) * light_.emission;
    light_.horizon = glm::dvec3(environment.sky_horizon) * light_.emission;
    light_.ground = glm::dvec3(environment.ground) * light_.emission;
    const glm::dvec3 above = 0.5 * (light_.zenith + light_.horizon);
    const double strength = environment.ambient * kBounced;
    for (int c = 0; c < 3; ++c) { // from the ground's below to the sky's above, by the height of the normal
        light_.skylight.linear[c] =
            strength * glm::dvec4(0.0, 0.5 * (above[c] - light_.ground[c]), 0.0, 0.5 * (above[c] + light_.ground[c]));
    }
}

void Daylight::placeBody(std::size_t body, const ShadedLight& light)
{
    Kept& kept = kept_[body];
    const double sine = sineOf(light);
    if (kept.sine != sine) {
        fillSkyUnder(sine, kept.under);
        kept.sine = sine;
        ++kept.version;
    }
    SkyBody& placed = light_.bodies[body];
    placed.towards_ws = -light.caster.direction_ws;
    placed.under = &kept.under;
    placed.version = kept.version;
    // Twice its size, or one would hardly see it; of a light as large as one likes a part.
    constexpr double kLargest_rad = 0.02;
    placed.cos_radius = std::cos(std::clamp(light.caster.angular_diameter_rad, 0.008, kLargest_rad));
}

void Daylight::fillPhysical(std::span<const ShadedLight> lights, std::span<const double> given,
                            const scene::Environment& environment, double exposure_ev)
{
    Hour hour;
    hour.sun = sunAmong(lights);
    hour.moon = moonAmong(lights);
    hour.camera = std::exp2(exposure_ev);
    constexpr double kDeepNight = -0.32; // sine: 18.7 degrees below the horizon
    constexpr double kMoonlit = -0.05;   // while the sun is higher, nobody sees the moon's sky
    if (sineOf(*hour.sun) > kDeepNight) {
        placeBody(0, *hour.sun);
    }
    if (hour.moon != nullptr && sineOf(*hour.moon) > kMoonlit && sineOf(*hour.sun) < kMoonlit) {
        placeBody(1, *hour.moon);
    }
    if (hour.moon != nullptr) {
        const glm::dvec3 colour(hour.moon->colour);
        hour.outside[1] *= colour / std::max(luminance(colour), 1e-30);
    }
    hour.look(light_);
    hour.measure(lights, given);
    hour.exposeLights(lights, light_);
    hour.exposeSky(environment, light_);
}

} // namespace gnomon::host
