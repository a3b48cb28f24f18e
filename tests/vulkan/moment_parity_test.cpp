// SPDX-License-Identifier: Apache-2.0
// Masks of filterable maps against the same shader files run on the CPU in double precision, on the texels that the GPU
// made: every filter, every format that it can use, every way to read it.
#include "fixture.h"
#include "moment_numbers.h"
#include "parity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace gnomon::test {
namespace {

void unchanged(MomentOptions&) {}

struct MomentCase {
    std::string name;
    Filter filter;
    MapFormat format;
    void (*change)(MomentOptions&) = unchanged;
    ParityLights lights = ParityLights::sun_and_spot;
};

std::ostream& operator<<(std::ostream& out, const MomentCase& c)
{
    return out << c.name;
}

void shaped(MomentOptions& o);

ShadowOptions optionsOf(const MomentCase& c)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = c.filter;
    options.format = c.format;
    c.change(options.moments);
    options.lighten = c.change == shaped ? 0.1F : 0.0F;
    return options;
}

class MomentParity : public testing::TestWithParam<MomentCase> {};

TEST_P(MomentParity, maskIsThatOfTheCpu)
{
    const ShadowOptions options = optionsOf(GetParam());
    const ParityFigures figures = expectParity(renderParity(options, GetParam().lights), options, GetParam().name);
    std::printf("%-28s %4zu of %zu pixels differ, worst %.2f of 255; %zu may by rounding\n", GetParam().name.c_str(),
                figures.different, figures.pixels, figures.worst, figures.loose);
    expectSilence(gpu());
}

void nearest(MomentOptions& o)
{
    o.sampling = MapSampling::nearest;
}
void bilinear(MomentOptions& o)
{
    o.sampling = MapSampling::bilinear;
}
void anisotropic(MomentOptions& o)
{
    o.sampling = MapSampling::anisotropic;
}
void plain(MomentOptions& o)
{
    o.samples = 1;
    o.blur = BlurKind::none;
}
void box(MomentOptions& o)
{
    o.blur = BlurKind::box;
    o.samples = 1;
}
void zOverW(MomentOptions& o)
{
    o.metric = DepthMetricKind::z_over_w;
}
void remapped(MomentOptions& o)
{
    o.remap = true;
}
void logarithmic(MomentOptions& o)
{
    o.log_space = true;
}
void penumbra(MomentOptions& o)
{
    o.penumbra = MomentPenumbra::light;
}
void hausdorff(MomentOptions& o)
{
    o.solver = MomentSolver::hausdorff;
}
void shaped(MomentOptions& o)
{
    o.bleeding_linstep = 0.2F;
    o.bleeding_power = 1.3F;
    o.derivative_variance = true;
    o.min_variance = 1e-5F;
}
// Splits amid the depths of the boxes, which are around 0.3 for both lights.
void twoLayers(MomentOptions& o)
{
    o.placement = LayerPlacement::by_hand;
    o.splits = {0.3F};
}
void threeLayers(MomentOptions& o)
{
    o.layers = 3;
    o.placement = LayerPlacement::by_hand;
    o.splits = {0.27F, 0.34F};
}
void eightLayers(MomentOptions& o)
{
    o.layers = 8;
    o.placement = LayerPlacement::by_hand;
    o.splits = {0.18F, 0.23F, 0.27F, 0.3F, 0.33F, 0.37F, 0.45F};
}
void byLloyd(MomentOptions& o)
{
    o.placement = LayerPlacement::lloyd;
}
void fourUniformLayers(MomentOptions& o)
{
    o.layers = 4;
    o.placement = LayerPlacement::uniform;
    o.remap = true;
}

constexpr ParityLights kAlone = ParityLights::sun_alone;
constexpr ParityLights kTogether = ParityLights::one_layer;

const MomentCase kVsm[] = {
    {"vsm_rg32f", Filter::vsm, MapFormat::rg32f},
    {"vsm_rg16", Filter::vsm, MapFormat::rg16},
    {"vsm_rg16f", Filter::vsm, MapFormat::rg16f},
    {"vsm_rg32f_nearest", Filter::vsm, MapFormat::rg32f, nearest},
    {"vsm_rg32f_bilinear", Filter::vsm, MapFormat::rg32f, bilinear},
    {"vsm_rg32f_anisotropic", Filter::vsm, MapFormat::rg32f, anisotropic},
    {"vsm_rg16_anisotropic_together", Filter::vsm, MapFormat::rg16, anisotropic, kTogether},
    {"vsm_rg32f_plain", Filter::vsm, MapFormat::rg32f, plain},
    {"vsm_rg32f_box", Filter::vsm, MapFormat::rg32f, box},
    {"vsm_rg32f_z_over_w", Filter::vsm, MapFormat::rg32f, zOverW},
    {"vsm_rg16f_remapped", Filter::vsm, MapFormat::rg16f, remapped},
    {"vsm_rg32f_shaped", Filter::vsm, MapFormat::rg32f, shaped},
    {"vsm_rg32f_penumbra", Filter::vsm, MapFormat::rg32f, penumbra},
    {"vsm_rg32f_penumbra_alone", Filter::vsm, MapFormat::rg32f, penumbra, kAlone},
    {"vsm_rg32f_together", Filter::vsm, MapFormat::rg32f, unchanged, kTogether},
    {"vsm_rg32f_alone", Filter::vsm, MapFormat::rg32f, unchanged, kAlone},
};
const MomentCase kLvsm[] = {
    {"lvsm_rgba16", Filter::lvsm, MapFormat::rgba16, twoLayers},
    {"lvsm_rgba16f", Filter::lvsm, MapFormat::rgba16f, twoLayers},
    {"lvsm_rgba32f", Filter::lvsm, MapFormat::rgba32f, twoLayers},
    {"lvsm_rgba16_three", Filter::lvsm, MapFormat::rgba16, threeLayers},
    {"lvsm_rgba32f_eight", Filter::lvsm, MapFormat::rgba32f, eightLayers},
    {"lvsm_rgba16f_four_uniform", Filter::lvsm, MapFormat::rgba16f, fourUniformLayers},
    {"lvsm_rgba16_lloyd", Filter::lvsm, MapFormat::rgba16, byLloyd},
    {"lvsm_rgba16_gaps", Filter::lvsm, MapFormat::rgba16},
    {"lvsm_rgba16_eight_together", Filter::lvsm, MapFormat::rgba16, eightLayers, kTogether},
    {"lvsm_rgba16_alone", Filter::lvsm, MapFormat::rgba16, threeLayers, kAlone},
};
const MomentCase kEsm[] = {
    {"esm_r32f", Filter::esm, MapFormat::r32f},
    {"esm_r16f", Filter::esm, MapFormat::r16f},
    {"esm_r32f_logarithmic", Filter::esm, MapFormat::r32f, logarithmic},
    {"esm_r16f_logarithmic", Filter::esm, MapFormat::r16f, logarithmic},
    {"esm_r32f_nearest", Filter::esm, MapFormat::r32f, nearest},
    {"esm_r32f_anisotropic", Filter::esm, MapFormat::r32f, anisotropic},
    {"esm_r32f_z_over_w", Filter::esm, MapFormat::r32f, zOverW},
    {"esm_r16f_remapped", Filter::esm, MapFormat::r16f, remapped},
    {"esm_r32f_plain", Filter::esm, MapFormat::r32f, plain},
    {"esm_r32f_together", Filter::esm, MapFormat::r32f, unchanged, kTogether},
    {"esm_r32f_alone", Filter::esm, MapFormat::r32f, unchanged, kAlone},
};
const MomentCase kEvsm[] = {
    {"evsm_rgba32f", Filter::evsm, MapFormat::rgba32f},
    {"evsm_rgba16f", Filter::evsm, MapFormat::rgba16f},
    {"evsm_rg32f", Filter::evsm, MapFormat::rg32f},
    {"evsm_rg16f", Filter::evsm, MapFormat::rg16f},
    {"evsm_rgba32f_logarithmic", Filter::evsm, MapFormat::rgba32f, logarithmic},
    {"evsm_rgba16f_logarithmic", Filter::evsm, MapFormat::rgba16f, logarithmic},
    {"evsm_rgba32f_nearest", Filter::evsm, MapFormat::rgba32f, nearest},
    {"evsm_rgba32f_anisotropic", Filter::evsm, MapFormat::rgba32f, anisotropic},
    {"evsm_rgba32f_remapped", Filter::evsm, MapFormat::rgba32f, remapped},
    {"evsm_rgba16f_z_over_w", Filter::evsm, MapFormat::rgba16f, zOverW},
    {"evsm_rgba32f_together", Filter::evsm, MapFormat::rgba32f, unchanged, kTogether},
    {"evsm_rgba32f_alone", Filter::evsm, MapFormat::rgba32f, unchanged, kAlone},
};
const MomentCase kMsm[] = {
    {"msm_rgba32f_penumbra", Filter::msm, MapFormat::rgba32f, penumbra},
    {"msm_rgba32f_penumbra_alone", Filter::msm, MapFormat::rgba32f, penumbra, kAlone},
    {"msm_rgba16", Filter::msm, MapFormat::rgba16},
    {"msm_rgba32f", Filter::msm, MapFormat::rgba32f},
    {"msm_rgba16_hausdorff", Filter::msm, MapFormat::rgba16, hausdorff},
    {"msm_rgba32f_hausdorff", Filter::msm, MapFormat::rgba32f, hausdorff},
    {"msm_rgba16_nearest", Filter::msm, MapFormat::rgba16, nearest},
    {"msm_rgba16_bilinear", Filter::msm, MapFormat::rgba16, bilinear},
    {"msm_rgba16_anisotropic", Filter::msm, MapFormat::rgba16, anisotropic},
    {"msm_rgba32f_z_over_w", Filter::msm, MapFormat::rgba32f, zOverW},
    {"msm_rgba16_plain", Filter::msm, MapFormat::rgba16, plain},
    {"msm_rgba16_together", Filter::msm, MapFormat::rgba16, unchanged, kTogether},
    {"msm_rgba16_alone", Filter::msm, MapFormat::rgba16, unchanged, kAlone},
};

std::string nameOfCase(const testing::TestParamInfo<MomentCase>& info)
{
    return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Vsm, MomentParity, testing::ValuesIn(kVsm), nameOfCase);
INSTANTIATE_TEST_SUITE_P(Lvsm, MomentParity, testing::ValuesIn(kLvsm), nameOfCase);
INSTANTIATE_TEST_SUITE_P(Esm, MomentParity, testing::ValuesIn(kEsm), nameOfCase);
INSTANTIATE_TEST_SUITE_P(Evsm, MomentParity, testing::ValuesIn(kEvsm), nameOfCase);
INSTANTIATE_TEST_SUITE_P(Msm, MomentParity, testing::ValuesIn(kMsm), nameOfCase);

// The reference must be able to tell: what is not the GPU's rule gives other masks.
TEST(MomentParityItself, tellsAnotherRuleApart)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::vsm;
    options.format = MapFormat::rg32f;
    const Rendered r = renderParity(options, ParityLights::sun_alone);
    options.moments.bleeding_linstep = 0.05F;
    const ReferenceScene scene{r.picture, r.camera, r.lights, r.plan, r.maps};
    const auto reference = referenceMask(scene, 0, options);
    std::size_t different = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        different += std::abs(std::to_integer<int>(r.masks[0][i]) - 255.0 * reference[i]) > 1.001 ? 1 : 0;
    }
    EXPECT_GT(different, reference.size() / 1000);
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
