// SPDX-License-Identifier: Apache-2.0
// The options that refuse a choice of casters' surfaces, and that a midpoint keeps nothing apart.
#include <gnomon/option_table.h>

#include <gtest/gtest.h>

namespace gnomon {
namespace {

std::string refusalOf(ShadowOptions options, Filter filter)
{
    options.technique.filter = filter;
    return resolve(options).refusal;
}

TEST(CasterFaces, EveryFilterThatReadsDepthHasThem)
{
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch}) {
        for (const CasterFaces faces : {CasterFaces::nearest, CasterFaces::back, CasterFaces::midpoint}) {
            for (const MapFormat format : {MapFormat::d32f, MapFormat::d16}) {
                EXPECT_EQ(refusalOf({.format = format, .faces = faces}, filter), "") << nameOf(filter) << nameOf(faces);
            }
        }
    }
    EXPECT_EQ(refusalOf({.faces = CasterFaces::back}, Filter::vsm), "");
}

TEST(CasterFaces, AMidpointIsOfTwoDepthsOfAllCastersOfAMap)
{
    const ShadowOptions midpoint{.faces = CasterFaces::midpoint};
    for (const Filter filter : {Filter::vsm, Filter::lvsm, Filter::esm, Filter::evsm, Filter::msm}) {
        EXPECT_EQ(refusalOf(midpoint, filter), "caster-faces midpoint: an average needs the depth of the receiver "
                                               "itself, which a midpoint is not");
    }
    for (const MapFormat format : {MapFormat::r32f, MapFormat::rg16, MapFormat::rgba8}) {
        ShadowOptions other = midpoint;
        other.format = format;
        EXPECT_EQ(refusalOf(other, Filter::hard),
                  "caster-faces midpoint: the two surfaces are depths, so the map is d32f or d16");
    }
    ShadowOptions layered = midpoint;
    layered.cascades.pass = CascadePass::layered;
    EXPECT_EQ(refusalOf(layered, Filter::pcf), "caster-faces midpoint: a map's second surface needs its first; draw "
                                               "each map in a pass of its own");
    ShadowOptions kept = midpoint;
    kept.keep_still = KeepStill::always;
    EXPECT_EQ(refusalOf(kept, Filter::pcf), "caster-faces midpoint: what moves may lie between two surfaces of what "
                                            "stands still, so nothing can be kept apart");
}

TEST(CasterCull, GoesWithEveryFilterButNotWithOtherFaces)
{
    for (const CasterCull cull : {CasterCull::none, CasterCull::back, CasterCull::front}) {
        for (const Filter filter : {Filter::hard, Filter::pcf, Filter::raymarch, Filter::vsm, Filter::msm}) {
            EXPECT_EQ(refusalOf({.cull = cull}, filter), "") << nameOf(filter) << nameOf(cull);
        }
    }
    EXPECT_EQ(refusalOf({.faces = CasterFaces::back, .cull = CasterCull::front}, Filter::hard),
              "caster-cull front: caster-faces back says by itself which surfaces count; leave one of them out");
    EXPECT_EQ(refusalOf({.faces = CasterFaces::midpoint, .cull = CasterCull::back}, Filter::hard),
              "caster-cull back: caster-faces midpoint says by itself which surfaces count; leave one of them out");
}

} // namespace
} // namespace gnomon
