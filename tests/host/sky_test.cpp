// SPDX-License-Identifier: Apache-2.0
// The air by what is known of daylight, and pictures under it.
// Compiled alone: atmosphere.h in double precision.
#define GNOMON_REAL double
#include "host/shaders/adaptation.h"
#include "host/shaders/atmosphere.h"

#include "atmosphere.h"
#include "daylight.h"
#include "small_scene.h"

#include "host/frame_renderer.h"
#include "scene/state.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

using namespace gnomon::shared::of_double;
constexpr double kPi = std::numbers::pi;
constexpr double kOutside_lx = 128000.0;

double luminance(const glm::dvec3& c)
{
    return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

double sineOfDegrees(double height_deg)
{
    return std::sin(glm::radians(height_deg));
}

std::unique_ptr<SkyUnder> skyUnder(double height_deg)
{
    auto sky = std::make_unique<SkyUnder>();
    fillSkyUnder(sineOfDegrees(height_deg), *sky);
    return sky;
}

/// The illuminance of level ground, by sun and sky.
double illuminance_lx(double height_deg)
{
    const auto sky = skyUnder(height_deg);
    const double direct = luminance(sky->direct) * std::max(sineOfDegrees(height_deg), 0.0);
    return kOutside_lx * (direct + luminance(sky->diffuse));
}

TEST(Air, ScattersAsMuchAsItTakes)
{
    double molecules = 0.0;
    double dust = 0.0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double c = -1.0 + (2.0 * i + 1.0) / kSteps;
        molecules += moleculesPhase(c) * 4.0 * kPi / kSteps;
        dust += dustPhase(c) * 4.0 * kPi / kSteps;
    }
    EXPECT_NEAR(molecules, 1.0, 1e-6);
    EXPECT_NEAR(dust, 1.0, 1e-4);
}

TEST(Air, LetsThroughWhatAColumnOfItDoes)
{
    // Straight up all densities have closed forms: 8 km of molecules, 1.2 km of dust, a tent of ozone 15 km in area.
    const glm::dvec3 molecules(8.40e-3, 13.56e-3, 30.25e-3);
    const glm::dvec3 ozone(2.25e-3, 1.88e-3, 0.10e-3);
    const glm::dvec3 depth = molecules * (8.0 * (1.0 - std::exp(-100.0 / 8.0))) + ozone * 15.0 + 4.0 * 4.44e-3 * 1.2;
    const glm::dvec3 got = lightThroughAir(1.0);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(got[c], std::exp(-depth[c]), 2e-3) << c;
    }
    // Slantwise a flat earth's air is as thick as the cosecant says, for as long as the earth looks flat.
    const glm::dvec3 slant = lightThroughAir(sineOfDegrees(30.0));
    EXPECT_NEAR(slant.y, got.y * got.y, 5e-3);
    const glm::dvec3 low = lightThroughAir(sineOfDegrees(2.0));
    EXPECT_GT(low.x, 4.0 * low.z) << "a low sun is orange";
    EXPECT_LT(luminance(lightThroughAir(0.0)), 0.01);
    EXPECT_EQ(lightThroughAir(sineOfDegrees(-1.0)), glm::dvec3(0.0));
}

TEST(Air, TableFindsItsDirections)
{
    for (const double u : {0.0, 0.2, 0.7, 1.0}) {
        for (const double v : {0.0, 0.1, 0.5, 1.0}) {
            const real2 way = skyTableDirection(real2(u, v));
            const real2 back = skyTablePlace(way.x, way.y);
            EXPECT_NEAR(back.x, u, 1e-12);
            EXPECT_NEAR(back.y, v, 1e-12);
        }
    }
}

// Figures of clear days: 10 klx at a sun of about 8 degrees and 50 at 28 are rules of thumb of daylighting; 410 to 585
// lx at sunset and 2 to 3.5 at -6 degrees, American Meteorological Society, "Glossary of Meteorology", civil twilight;
// 0.008 and 0.0006 lx at -12 and -18, the same, nautical and astronomical twilight, starlight apart.
TEST(Air, LightsTheGroundByTheSunsHeight)
{
    const auto within = [](double height_deg, double expected_lx, double factor) {
        const double lx = illuminance_lx(height_deg);
        EXPECT_GT(lx, expected_lx / factor) << height_deg;
        EXPECT_LT(lx, expected_lx * factor) << height_deg;
    };
    within(90.0, 124000.0, 1.1);
    within(28.0, 50000.0, 1.2);
    within(8.0, 10000.0, 1.3);
    within(-0.83, 500.0, 1.5);
    within(-6.0, 3.0, 2.0);
    within(-12.0, 0.008, 2.5);
    EXPECT_LT(illuminance_lx(-18.0), 0.0006);
    double last = illuminance_lx(-18.0);
    for (double height_deg = -17.0; height_deg <= 90.0; height_deg += 3.0) {
        const double lx = illuminance_lx(height_deg);
        EXPECT_GT(lx, last) << height_deg;
        last = lx;
    }
}

TEST(Air, IsBlueAboveAndWarmAroundALowSun)
{
    const auto at = [](const SkyUnder& sky, double height_deg, std::size_t across, std::size_t up) {
        const std::size_t i = up * SkyUnder::across + across;
        const double sine = sineOfDegrees(height_deg);
        const real2 way = skyTableDirection(
            real2(static_cast<double>(across) / (SkyUnder::across - 1), static_cast<double>(up) / (SkyUnder::up - 1)));
        const double towards = way.x * sine + way.y * std::sqrt((1.0 - way.x * way.x) * (1.0 - sine * sine));
        return glm::dvec3(sky.molecules[i]) + glm::dvec3(sky.dust[i]) * dustPhase(towards);
    };
    for (const double height_deg : {50.0, 20.0, 0.0, -4.0, -8.0}) {
        const glm::dvec3 zenith = at(*skyUnder(height_deg), height_deg, 0, SkyUnder::up - 1);
        EXPECT_GT(zenith.z, 1.5 * zenith.x) << height_deg;
        EXPECT_GT(zenith.y, zenith.x) << "no purple at " << height_deg;
    }
    for (const double height_deg : {2.0, 0.0, -4.0}) {
        const auto sky = skyUnder(height_deg);
        const glm::dvec3 sunwards = at(*sky, height_deg, 0, 1);
        const glm::dvec3 away = at(*sky, height_deg, SkyUnder::across - 1, 1);
        EXPECT_GT(sunwards.x, 1.4 * sunwards.z) << height_deg;
        EXPECT_GT(sunwards.x / sunwards.z, 1.4 * away.x / away.z) << height_deg;
        EXPECT_GT(luminance(sunwards), 1.4 * luminance(away)) << height_deg;
    }
}

/// The cosine integral of a table, by its directions.
glm::dvec3 irradiance(const SkyUnder& sky, double sine, const glm::dvec3& normal)
{
    constexpr int kUp = 96;
    constexpr int kAround = 192;
    glm::dvec3 sum(0.0);
    for (int j = 0; j < kUp; ++j) {
        const double up = (j + 0.5) / kUp;
        for (int i = 0; i < kAround; ++i) {
            const double azimuth = 2.0 * kPi * (i + 0.5) / kAround;
            const double level = std::sqrt(1.0 - up * up);
            const glm::dvec3 d(level * std::cos(azimuth), up, level * std::sin(azimuth));
            const real2 place = skyTablePlace(up, std::cos(azimuth));
            const auto x = static_cast<std::size_t>(std::lround(place.x * (SkyUnder::across - 1)));
            const auto y = static_cast<std::size_t>(std::lround(place.y * (SkyUnder::up - 1)));
            const std::size_t texel = y * SkyUnder::across + x;
            const double towards = d.x * std::sqrt(1.0 - sine * sine) + d.y * sine;
            const glm::dvec3 light =
                glm::dvec3(sky.molecules[texel]) + glm::dvec3(sky.dust[texel]) * dustPhase(towards);
            sum += light * (std::max(glm::dot(normal, d), 0.0) * 2.0 * kPi / (kUp * kAround));
        }
    }
    return sum / kPi;
}

TEST(Skylight, IsTheSkysCosineIntegral)
{
    for (const double height_deg : {40.0, 5.0}) {
        const auto sky = skyUnder(height_deg);
        const double overhead = luminance(sky->light.on({0.0, 1.0, 0.0}));
        for (const glm::dvec3& way : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0),
                                      glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, 0)}) {
            const glm::dvec3 normal = glm::normalize(way);
            const double exact = luminance(irradiance(*sky, sineOfDegrees(height_deg), normal));
            EXPECT_NEAR(luminance(sky->light.on(normal)), exact, 0.09 * overhead)
                << height_deg << ": " << way.x << " " << way.y << " " << way.z;
        }
    }
}

TEST(Skylight, TurnsWithItsSun)
{
    const auto sky = skyUnder(10.0);
    const double a = 0.6;
    const double b = -0.8;
    const Skylight turned = sky->light.turned(2.0 * a, 2.0 * b);
    for (const glm::dvec3& way : {glm::dvec3(0.3, 0.5, -0.7), glm::dvec3(-0.9, 0.1, 0.2), glm::dvec3(0.1, -0.6, 0.8)}) {
        const glm::dvec3 n = glm::normalize(way);
        const glm::dvec3 as_before(a * n.x + b * n.z, n.y, a * n.z - b * n.x);
        EXPECT_NEAR(glm::distance(turned.on(n), sky->light.on(as_before)), 0.0, 1e-12);
    }
    Skylight half;
    half.addGround(glm::dvec3(1.0));
    EXPECT_NEAR(half.on({0.0, -1.0, 0.0}).x, 1.0, 1e-12);
    EXPECT_NEAR(half.on({1.0, 0.0, 0.0}).x, 0.5, 1e-12);
    EXPECT_NEAR(half.on({0.0, 1.0, 0.0}).x, 0.0, 1e-12);
}

ShadedLight skyLight(scene::Body body, double height_deg)
{
    ShadedLight light;
    light.body = body;
    light.caster.type = LightType::directional;
    light.caster.direction_ws = {-std::cos(glm::radians(height_deg)), -sineOfDegrees(height_deg), 0.0};
    light.colour = glm::vec3(3.0F, 2.9F, 2.6F);
    return light;
}

/// The light of some lights under a physical sky.
FrameLight lightOf(const std::vector<ShadedLight>& lights, double exposure_ev = 0.0)
{
    Daylight daylight;
    const std::vector<double> given(lights.size(), 0.0); // nothing beside sun and moon
    return daylight.at(SkyModel::physical, exposure_ev, lights, given, {});
}

TEST(Daylight, IsForAnEyeThatIsUsedToIt)
{
    const auto brightness = [](double height_deg) {
        return luminance(lightOf({skyLight(scene::Body::sun, height_deg)}).ground);
    };
    const FrameLight noon = lightOf({skyLight(scene::Body::sun, 50.0)});
    EXPECT_NEAR(luminance(noon.colours[0]), 1.35, 0.1);
    for (double height_deg = 45.0; height_deg > -14.0; height_deg -= 5.0) {
        EXPECT_LT(brightness(height_deg), 1.02 * brightness(height_deg + 5.0)) << height_deg;
    }
    EXPECT_GT(brightness(0.0), 0.15 * brightness(45.0)) << "sunset can be read";
    EXPECT_GT(brightness(-6.0), 0.04 * brightness(45.0)) << "and so can dusk";
    const FrameLight night = lightOf({skyLight(scene::Body::sun, -30.0), skyLight(scene::Body::moon, 35.0)});
    const double moonlit = luminance(night.colours[1]) / luminance(noon.colours[0]);
    EXPECT_GT(moonlit, 1.0 / 20.0) << "which the tone curve makes a twentieth on the screen";
    EXPECT_LT(moonlit, 1.0 / 5.0);
    EXPECT_GT(night.lamps, 0.99);
    EXPECT_GT(night.stars, 0.2);
    EXPECT_EQ(noon.lamps, 0.0);
    EXPECT_EQ(noon.stars, 0.0);
    const FrameLight brighter = lightOf({skyLight(scene::Body::sun, 50.0)}, 1.0);
    EXPECT_NEAR(luminance(brighter.colours[0]), 2.0 * luminance(noon.colours[0]), 1e-9);
}

TEST(Daylight, LeavesLightsOfFilesTheirColour)
{
    ShadedLight red = skyLight(scene::Body::none, 5.0);
    red.colour = {40.0F, 10.0F, 10.0F};
    const FrameLight light = lightOf({red});
    ASSERT_TRUE(light.physical);
    EXPECT_NEAR(light.colours[0].x, 4.0 * light.colours[0].y, 1e-6);
    EXPECT_NEAR(luminance(light.colours[0]), luminance(lightOf({skyLight(scene::Body::sun, 5.0)}).colours[0]), 1e-2)
        << "as bright as a sun at this height, whatever its unit";
    EXPECT_FALSE(lightOf({skyLight(scene::Body::none, -20.0)}).physical) << "from below there shines no sun";
    EXPECT_TRUE(lightOf({skyLight(scene::Body::sun, -20.0)}).physical);
    EXPECT_FALSE(lightOf({}).physical);
}

TEST(Daylight, KeepsThePlainSky)
{
    const scene::Environment environment;
    Daylight daylight;
    const FrameLight& light = daylight.at(SkyModel::plain, 0.0, {}, {}, environment);
    EXPECT_FALSE(light.physical);
    const glm::dvec3 above = 0.5 * glm::dvec3(environment.sky_zenith + environment.sky_horizon);
    const double strength = environment.ambient * 1.5;
    EXPECT_NEAR(glm::distance(light.skylight.on({0.0, 1.0, 0.0}), above * strength), 0.0, 1e-6);
    EXPECT_NEAR(glm::distance(light.skylight.on({0.0, -1.0, 0.0}), glm::dvec3(environment.ground) * strength), 0.0,
                1e-6);
}

TEST(Adaptation, IsTheArticles)
{
    EXPECT_NEAR(adaptedKey(0.0), 0.03, 1e-12);
    EXPECT_NEAR(adaptedKey(9.0), 1.03 - 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(adaptedKey(9999.0), 1.03 - 2.0 / 6.0, 1e-12);
}

class PhysicalSky : public testing::Test {
protected:
    PhysicalSky()
    {
        scene_.lights[0].body = scene::Body::sun;
        state_ = scene::evaluate(scene_, 0.0);
        uploaded_ = std::make_unique<SceneOnGpu>(gpu_, scene_, state_);
    }
    [[nodiscard]] std::unique_ptr<FrameRenderer> renderer(SkyModel sky = SkyModel::physical) const
    {
        RenderOptions options;
        options.width = 96;
        options.height = 64;
        options.shadow.map_size = 128;
        options.sky = sky;
        return std::make_unique<FrameRenderer>(*uploaded_, options);
    }
    void submit(FrameRenderer& renderer, double height_deg)
    {
        std::vector<ShadedLight> lights = lightsOf(scene_, state_);
        lights[0].caster.direction_ws = skyLight(scene::Body::sun, height_deg).caster.direction_ws;
        Eye eye = smallEye();
        eye.target_ws.y = eye.position_ws.y + 0.1; // to see some sky
        renderer.submit(state_, eye, lights);
    }
    std::vector<float> draw(FrameRenderer& renderer, double height_deg)
    {
        submit(renderer, height_deg);
        renderer.finish();
        return renderer.read({.linear = true}).linear.values;
    }
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    Gpu gpu_{{.gpu = "software", .validate = true}};
    scene::Scene scene_ = smallScene();
    scene::State state_;
    std::unique_ptr<SceneOnGpu> uploaded_;
};

TEST_F(PhysicalSky, IsTheSameInWhicheverFrame)
{
    const std::vector<float> evening = draw(*renderer(), 4.0);
    const auto busy = renderer();
    const std::vector<float> noon = draw(*busy, 60.0);
    EXPECT_NE(noon, evening);
    for (int i = 0; i < 5; ++i) { // none is waited for but by its slot
        submit(*busy, 50.0 - 8.0 * i);
    }
    EXPECT_EQ(draw(*busy, 4.0), evening);
    EXPECT_EQ(draw(*busy, 4.0), evening) << "nothing moved";
    EXPECT_EQ(draw(*busy, 60.0), noon);
}

TEST_F(PhysicalSky, GivesWayWhereNobodyAsks)
{
    const auto plain = renderer(SkyModel::plain);
    const std::vector<float> noon = draw(*plain, 60.0);
    EXPECT_NE(noon, draw(*renderer(), 60.0));
}

} // namespace
} // namespace gnomon::host::test
