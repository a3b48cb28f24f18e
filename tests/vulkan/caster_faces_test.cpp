// SPDX-License-Identifier: Apache-2.0
// The depths of a box over a plane by each CasterFaces, under sun and spot, in both depth formats.
#include "fixture.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace gnomon::test {
namespace {

constexpr std::uint32_t kSide = 128;
constexpr std::size_t kMiddle = kSide / 2 * kSide + kSide / 2;
constexpr std::size_t kCorner = 2 * kSide + 2;

// A box from 4 m to 6 m over the ground, closed; the ground is open. The sun's near plane is at 15 m and its range
// 45 m, the spot hangs at 20 m (makeView()).
class CasterFacesOnGpu : public testing::TestWithParam<MapFormat> {
protected:
    void TearDown() override { expectSilence(gpu()); }

    static Light sun() { return makeSun({0.0, -1.0, 0.0}); }
    static Light spot() { return makeSpot({0.0, 20.0, 0.0}, {0.0, 0.0, 0.0}, 0.6); }
    static double sunDepth(double height_m) { return (15.0 - height_m) / 45.0; }
    static double spotDepth(double height_m) { return (20.0 - height_m - 0.2) / 39.8; }
    static double tolerance() { return GetParam() == MapFormat::d16 ? 2e-5 : 2e-6; }

    static Bench makeBench(CasterFaces faces)
    {
        return Bench({64, 48}, ShadowOptions{.technique = kPlainTechnique, .format = GetParam(), .faces = faces});
    }
    static void setScene(Bench& bench)
    {
        bench.scene.boxes = {{{0.0, 5.0, 0.0}, {3.0, 1.0, 3.0}, 0.0}};
        bench.setLights({sun(), spot()}, {{0, 0, 0, kSide, kSide}, {1, 0, 0, kSide, kSide}}, {kSide, kSide, 2});
        bench.mesh.batches.push_back({});
        bench.mesh.batches[1].two_sided = false;
        bench.mesh.parts[1].batch = 1;
    }
    /// Expects the depths of the box and of the ground beside it.
    static void expectHeights(Bench& bench, double box_m, double ground_m)
    {
        const auto of_sun = bench.readMap(0);
        EXPECT_NEAR(of_sun[kMiddle], sunDepth(box_m), tolerance());
        EXPECT_NEAR(of_sun[kCorner], sunDepth(ground_m), tolerance());
        const auto of_spot = bench.readMap(1);
        EXPECT_NEAR(of_spot[kMiddle], spotDepth(box_m), tolerance());
        EXPECT_NEAR(of_spot[kCorner], spotDepth(ground_m), tolerance());
    }
};

TEST_P(CasterFacesOnGpu, theNearestIsTheTop)
{
    Bench bench = makeBench(CasterFaces::nearest);
    setScene(bench);
    bench.prepare();
    bench.record(1);
    expectHeights(bench, 6.0, 0.0);
}

TEST_P(CasterFacesOnGpu, theBackIsTheBottomAndWhatIsOpenCasts)
{
    Bench bench = makeBench(CasterFaces::back);
    setScene(bench);
    bench.prepare();
    bench.record(1);
    expectHeights(bench, 4.0, 0.0);
}

TEST_P(CasterFacesOnGpu, theMidpointIsMidwayAndTheGroundAlone)
{
    Bench bench = makeBench(CasterFaces::midpoint);
    setScene(bench);
    bench.prepare();
    bench.record(2); // the second recording finds the images as the first one left them
    expectHeights(bench, 5.0, 0.0);
}

TEST_P(CasterFacesOnGpu, theMidpointGoesThroughTheHolesOfMaskedCasters)
{
    Bench bench = makeBench(CasterFaces::midpoint);
    setScene(bench);
    bench.mesh.batches.pop_back();
    bench.maskBoxes();
    bench.prepare();
    bench.record(1);
    const auto map = bench.readMap(0);
    constexpr std::size_t kTexel = 8; // 1.5 m
    const std::array sides{map[kMiddle - kTexel], map[kMiddle + kTexel]};
    EXPECT_NEAR(std::min(sides[0], sides[1]), sunDepth(5.0), tolerance()) << "the half that is there";
    EXPECT_NEAR(std::max(sides[0], sides[1]), sunDepth(0.0), tolerance()) << "the half that is clear";
}

// The box alone is pushed away from the light, by as many metres under a sun and along a spot's axis.
TEST_P(CasterFacesOnGpu, anObjectsOwnBiasMovesItAlone)
{
    Bench bench = makeBench(CasterFaces::nearest);
    setScene(bench);
    bench.prepare();
    const std::array biases{0.0F, 1.5F};
    bench.drawer.setBiases(biases);
    bench.record(1);
    expectHeights(bench, 4.5, 0.0);
    const std::array wrong{0.0F, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_THROW(bench.drawer.setBiases(wrong), Error);
}

// Culled faces are left out of all casters, also of the open ground, of which the light sees the front.
TEST_P(CasterFacesOnGpu, whatIsCulledIsLeftOutOfAllThatCasts)
{
    constexpr double kNothing = 1e9;
    const auto expectMap = [](Bench& bench, double box_m, double ground_m) {
        const auto map = bench.readMap(0);
        EXPECT_NEAR(map[kMiddle], box_m == kNothing ? 1.0 : sunDepth(box_m), tolerance());
        EXPECT_NEAR(map[kCorner], ground_m == kNothing ? 1.0 : sunDepth(ground_m), tolerance());
    };
    for (const CasterCull cull : {CasterCull::none, CasterCull::back, CasterCull::front}) {
        for (const bool two_sided : {false, true}) {
            Bench bench({64, 48}, ShadowOptions{.technique = kPlainTechnique, .format = GetParam(), .cull = cull});
            setScene(bench);
            bench.mesh.batches[1].two_sided = two_sided;
            bench.prepare();
            bench.record(1);
            if (cull == CasterCull::front) {
                expectMap(bench, 4.0, kNothing);
            } else {
                expectMap(bench, 6.0, 0.0);
            }
        }
    }
}

// The other faces of what winds the other way: of a mirrored batch, or where a host calls clockwise triangles front.
TEST_P(CasterFacesOnGpu, windingSaysWhichFacesAreFront)
{
    for (const CasterFaces faces : {CasterFaces::nearest, CasterFaces::back}) {
        for (const bool mirrored : {false, true}) {
            for (const bool clockwise : {false, true}) {
                const CasterCull cull = faces == CasterFaces::nearest ? CasterCull::front : CasterCull::none;
                Bench bench(
                    {64, 48},
                    ShadowOptions{.technique = kPlainTechnique, .format = GetParam(), .faces = faces, .cull = cull},
                    true, false, {}, clockwise);
                setScene(bench);
                bench.mesh.batches[1].mirrored = mirrored;
                bench.prepare();
                bench.record(1);
                // As its triangles are wound, the top is the front: where both say otherwise it is again.
                EXPECT_NEAR(bench.readMap(0)[kMiddle], sunDepth(mirrored == clockwise ? 4.0 : 6.0), tolerance());
            }
        }
    }
}

// Cut at 5 m the box is open above, so one sees its bottom; whichever of its triangles would be left out of a closed
// one.
TEST_P(CasterFacesOnGpu, aBoxThatIsCutIsOpen)
{
    for (const CasterFaces faces : {CasterFaces::nearest, CasterFaces::back, CasterFaces::midpoint}) {
        Bench bench = makeBench(faces);
        setScene(bench);
        bench.mesh.batches[1].clip_planes[0] = {0.0F, -2.0F, 0.0F, 0.0F}; // its own space: the cube from -1 to 1
        bench.prepare();
        bench.record(1);
        expectHeights(bench, faces == CasterFaces::midpoint ? 2.0 : 4.0, 0.0); // or midway from there to the ground
    }
}

TEST_P(CasterFacesOnGpu, eachPlaneCutsAndTogetherTheyMayLeaveNothing)
{
    for (const bool masked : {false, true}) {
        Bench bench = makeBench(CasterFaces::nearest);
        setScene(bench);
        if (masked) {
            bench.mesh.batches.pop_back();
            bench.maskBoxes();
        }
        vulkan::CasterBatch& batch = bench.mesh.batches.back();
        batch.cutoff = 0.0F; // all is solid
        batch.clip_planes[1] = {1.0F, 0.0F, 0.0F, 0.0F};
        bench.prepare();
        bench.record(1);
        const auto map = bench.readMap(0);
        constexpr std::size_t kTexel = 8; // 1.5 m
        const std::array sides{map[kMiddle - kTexel], map[kMiddle + kTexel]};
        EXPECT_NEAR(std::min(sides[0], sides[1]), sunDepth(6.0), tolerance()) << "the half that is left";
        EXPECT_NEAR(std::max(sides[0], sides[1]), sunDepth(0.0), tolerance()) << "the half that is cut away";
        batch.clip_planes[0] = {-1.0F, 0.0F, 0.0F, -0.5F};
        bench.prepare();
        bench.record(1);
        EXPECT_NEAR(bench.readMap(0)[kMiddle - kTexel], sunDepth(0.0), tolerance());
        EXPECT_NEAR(bench.readMap(0)[kMiddle + kTexel], sunDepth(0.0), tolerance());
    }
}

TEST_P(CasterFacesOnGpu, aPlaneThatIsNotFiniteIsRefused)
{
    Bench bench = makeBench(CasterFaces::nearest);
    setScene(bench);
    bench.mesh.batches[1].clip_planes[1].w = std::numeric_limits<float>::infinity();
    EXPECT_THROW(bench.prepare(), Error);
}

TEST_P(CasterFacesOnGpu, pagesGrowUnderTheMidpoint)
{
    Bench bench = makeBench(CasterFaces::midpoint);
    setScene(bench);
    bench.prepare();
    bench.record(1);
    for (View& view : bench.plan.views) {
        view.place.tile.x = kSide;
        view.contents.redraw = true;
    }
    bench.plan.pages[0].width = 2 * kSide;
    bench.prepare();
    bench.record(1);
    const auto map = bench.readMap(0);
    EXPECT_NEAR(map[kSide / 2 * 2 * kSide + kSide + kSide / 2], sunDepth(5.0), tolerance());
}

INSTANTIATE_TEST_SUITE_P(Formats, CasterFacesOnGpu, testing::Values(MapFormat::d32f, MapFormat::d16),
                         [](const auto& param) { return std::string(nameOf(param.param)); });

} // namespace
} // namespace gnomon::test
