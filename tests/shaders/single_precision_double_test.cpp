// SPDX-License-Identifier: Apache-2.0
// The double precision half of single_precision_float_test.cpp.
#include "cpu_map.h"
#include "single_values.h"

#include <gnomon/lib/average.glsl>
#include <gnomon/lib/encoders.glsl>

#include <gtest/gtest.h>

#include "single_precision.h"

namespace gnomon::test {
namespace {

/// lvsm's two layers, as the placer would hand them over: near, far, where its receivers begin.
constexpr glm::dvec4 kLayers[2] = {{0.0, 0.6, 0.0, 0.0}, {0.4, 1.0, 0.5, 0.0}};

} // namespace

glm::vec4 storedInDouble(const DepthDraw& draw, const SingleOptions& options)
{
    const shared::MomentRule rule = shared::single::ruleOf(options);
    const glm::dvec4 k = shared::averageExponents(options.filter, rule);
    const bool logarithms = shared::averagesLogarithms(options.filter, options.flags);
    shared::EncodeInput e{};
    e.first = kLayers[0];
    e.second = kLayers[1];
    shared::MomentSum sum{};
    for (int i = 0; i < draw.points; ++i) {
        e.depth = static_cast<double>(draw.depths[i]);
        const double weight = static_cast<double>(draw.weights[i]);
        const glm::dvec4 value = shared::encodeDepth(options.filter, e, rule);
        sum = i == 0 ? shared::startAverage(value, weight, logarithms)
                     : shared::addToAverage(sum, value, weight, k, logarithms);
    }
    return glm::vec4(shared::finishAverage(sum, k, logarithms));
}

double visibilityInDouble(const glm::vec4& stored, const DepthDraw& draw, const SingleOptions& options)
{
    map_moments = [&](glm::dvec2, double, double) {
        return glm::dvec4(stored);
    };
    depth_layers = [](int, int i) {
        return i < 2 ? kLayers[i] : glm::dvec4(0.0, 1.0, 2.0, 0.0);
    };
    const double v = shared::single::visibilityOf(draw, options);
    map_moments = nullptr;
    depth_layers = nullptr;
    return v;
}

// The reference that single precision is compared with must itself be right: one depth before or behind the receiver.
TEST(SinglePrecision, isHeldAgainstWhatKnowsLightFromShadow)
{
    for (const int filter :
         {GNOMON_FILTER_VSM, GNOMON_FILTER_LVSM, GNOMON_FILTER_ESM, GNOMON_FILTER_EVSM, GNOMON_FILTER_MSM}) {
        SingleOptions o{filter, filter == GNOMON_FILTER_MSM ? int(shared::kMomentRemap) : 0, 40.0, 1e-6, 1.3e-6};
        DepthDraw draw{1, {0.3F}, {1.0F}, 0.9F, 0.0F};
        EXPECT_LT(visibilityInDouble(storedInDouble(draw, o), draw, o), 0.01) << filter;
        draw.receiver = 0.2F;
        EXPECT_GT(visibilityInDouble(storedInDouble(draw, o), draw, o), 0.99) << filter;
    }
}

} // namespace gnomon::test
