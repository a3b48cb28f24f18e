// SPDX-License-Identifier: Apache-2.0
// Interpolation against closed form.
#include "animation.h"

#include "scene/state.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace gnomon::scene {
namespace {

AnimationChannel channelOf(AnimationPath path, Interpolation interpolation, std::vector<float> times,
                           std::vector<float> values)
{
    AnimationChannel channel;
    channel.node = 0;
    channel.path = path;
    channel.interpolation = interpolation;
    channel.times_s = std::move(times);
    channel.values = std::move(values);
    return channel;
}

std::array<float, 3> sample3(const AnimationChannel& channel, float time_s)
{
    std::array<float, 3> out{-7.0F, -7.0F, -7.0F};
    sampleChannel(channel, time_s, out);
    return out;
}

/// x y z w of a turn about +y.
std::array<float, 4> aboutY(float radians)
{
    return {0.0F, std::sin(radians * 0.5F), 0.0F, std::cos(radians * 0.5F)};
}

TEST(Animation, StepHoldsUntilTheNextKey)
{
    const AnimationChannel channel =
        channelOf(AnimationPath::translation, Interpolation::step, {1.0F, 2.0F, 4.0F}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
    EXPECT_EQ(sample3(channel, 0.0F)[0], 1.0F);
    EXPECT_EQ(sample3(channel, 1.999F)[0], 1.0F);
    EXPECT_EQ(sample3(channel, 2.0F)[0], 2.0F);
    EXPECT_EQ(sample3(channel, 3.9F)[0], 2.0F);
    EXPECT_EQ(sample3(channel, 4.0F)[0], 3.0F);
    EXPECT_EQ(sample3(channel, 99.0F)[0], 3.0F);
}

TEST(Animation, LinearIsTheStraightLineAndHoldsOutside)
{
    const AnimationChannel channel =
        channelOf(AnimationPath::scale, Interpolation::linear, {0.5F, 2.5F}, {1, 10, -4, 5, 20, 4});
    EXPECT_EQ(sample3(channel, 0.0F), (std::array<float, 3>{1, 10, -4}));
    EXPECT_EQ(sample3(channel, 1.0F), (std::array<float, 3>{2, 12.5F, -2}));
    EXPECT_EQ(sample3(channel, 2.5F), (std::array<float, 3>{5, 20, 4}));
    EXPECT_EQ(sample3(channel, 9.0F), (std::array<float, 3>{5, 20, 4}));
}

TEST(Animation, LinearRotationTurnsAtConstantSpeed)
{
    const auto a = aboutY(0.2F);
    const auto b = aboutY(2.0F);
    const AnimationChannel channel = channelOf(AnimationPath::rotation, Interpolation::linear, {0.0F, 1.0F},
                                               {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]});
    for (const float t : {0.0F, 0.1F, 0.25F, 0.5F, 0.75F, 1.0F}) {
        std::array<float, 4> out{};
        sampleChannel(channel, t, out);
        const auto expected = aboutY(0.2F + 1.8F * t);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(out[i], expected[i], 1e-6F) << "t=" << t << " component " << i;
        }
    }
}

TEST(Animation, LinearRotationTakesTheShortWay)
{
    const auto a = aboutY(0.0F);
    const auto b = aboutY(1.0F);
    const AnimationChannel channel = channelOf(AnimationPath::rotation, Interpolation::linear, {0.0F, 1.0F},
                                               {a[0], a[1], a[2], a[3], -b[0], -b[1], -b[2], -b[3]});
    std::array<float, 4> out{};
    sampleChannel(channel, 0.5F, out);
    const auto expected = aboutY(0.5F);
    EXPECT_NEAR(out[1], expected[1], 1e-6F);
    EXPECT_NEAR(out[3], expected[3], 1e-6F);
}

TEST(Animation, CubicSplineIsTheHermitePolynomial)
{
    // Keys of p(t) = t^3 - 2 t^2 + 5 with its own derivatives as tangents: the spline must be p itself.
    const auto p = [](float t) {
        return t * t * t - 2.0F * t * t + 5.0F;
    };
    const auto derivative = [](float t) {
        return 3.0F * t * t - 4.0F * t;
    };
    std::vector<float> values;
    const std::vector<float> times{0.0F, 0.5F, 2.0F};
    for (const float t : times) {
        for (const float v : {derivative(t), p(t), derivative(t)}) {
            values.insert(values.end(), {v, 2.0F * v, -v});
        }
    }
    const AnimationChannel channel = channelOf(AnimationPath::translation, Interpolation::cubic_spline, times, values);
    for (const float t : {0.0F, 0.1F, 0.49F, 0.5F, 0.9F, 1.7F, 2.0F}) {
        const auto out = sample3(channel, t);
        EXPECT_NEAR(out[0], p(t), 2e-5F) << "t=" << t;
        EXPECT_NEAR(out[1], 2.0F * p(t), 4e-5F) << "t=" << t;
        EXPECT_NEAR(out[2], -p(t), 2e-5F) << "t=" << t;
    }
    EXPECT_EQ(sample3(channel, -1.0F)[0], p(0.0F));
    EXPECT_EQ(sample3(channel, 3.0F)[0], p(2.0F));
}

TEST(Animation, CubicRotationsComeOutNormalised)
{
    const AnimationChannel channel =
        channelOf(AnimationPath::rotation, Interpolation::cubic_spline, {0.0F, 1.0F},
                  {0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0.6F, 0, 0.8F, 0, 0, 0, 0});
    std::array<float, 4> out{};
    sampleChannel(channel, 0.4F, out);
    EXPECT_NEAR(out[0] * out[0] + out[1] * out[1] + out[2] * out[2] + out[3] * out[3], 1.0F, 1e-6F);
    EXPECT_NE(out[0], 0.0F);
}

TEST(Animation, StartsAnewAfterItsEndAndHoldsItsEnd)
{
    Animation animation;
    animation.duration_s = 2.0F;
    animation.channels.push_back(
        channelOf(AnimationPath::translation, Interpolation::linear, {0.0F, 2.0F}, {0, 0, 0, 4, 0, 0}));
    std::vector<Node> nodes(1);
    const auto x = [&](double time_s) {
        applyAnimation(animation, time_s, nodes);
        return nodes[0].transform.translation.x;
    };
    EXPECT_EQ(x(2.0), 4.0F);
    EXPECT_EQ(x(2.5), 1.0F);
    EXPECT_EQ(x(-0.5), 3.0F);
}

TEST(Animation, LeavesNodesGivenAsMatricesAlone)
{
    Animation animation;
    animation.channels.push_back(channelOf(AnimationPath::translation, Interpolation::linear, {0.0F}, {4, 5, 6}));
    std::vector<Node> nodes(1);
    nodes[0].use_matrix = true;
    applyAnimation(animation, 0.0, nodes);
    EXPECT_EQ(nodes[0].transform.translation, glm::vec3(0.0F));
}

TEST(Animation, AnUnknownNameIsAnErrorThatListsTheNames)
{
    Scene scene;
    scene.nodes.resize(1);
    EXPECT_NO_THROW((void)evaluate(scene, 0.0));
    EXPECT_THROW((void)evaluate(scene, 0.0, "walk"), Error);
    scene.animations.resize(2);
    scene.animations[0].name = "run";
    scene.animations[1].name = "jump";
    try {
        (void)evaluate(scene, 0.0, "walk");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("run, jump"), std::string::npos) << error.what();
    }
}

TEST(Transform, IsTranslationTimesRotationTimesScale)
{
    Transform transform;
    transform.translation = {1.0F, 2.0F, 3.0F};
    transform.rotation = glm::normalize(glm::quat(0.7F, 0.1F, -0.5F, 0.3F));
    transform.scale = {2.0F, 3.0F, -0.5F};
    const glm::vec3 p(0.3F, -1.2F, 4.0F);
    const glm::vec3 expected = transform.rotation * (p * transform.scale) + transform.translation;
    const glm::vec3 got(transform.matrix() * glm::vec4(p, 1.0F));
    EXPECT_NEAR(glm::distance(got, expected), 0.0F, 1e-5F);
}

} // namespace
} // namespace gnomon::scene
