// SPDX-License-Identifier: Apache-2.0
// Objects whose transforms mirror them: of what is closed the far side is held, as of their image in the mirror.
#include "small_scene.h"

#include "host/frame_renderer.h"
#include "scene/state.h"

#include <gtest/gtest.h>

namespace gnomon::host::test {
namespace {

ImageF mapOf(Gpu& gpu, bool mirrored, CasterFaces faces, CasterCull cull = CasterCull::none)
{
    scene::Scene scene = smallScene();
    scene.nodes[kMoverNode].transform.scale.x = mirrored ? -1.0F : 1.0F; // a box, which is its own image
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 32;
    options.height = 32;
    options.shadow.technique = kPlainTechnique;
    options.shadow.technique.filter = Filter::hard;
    options.shadow.map_size = 128;
    options.shadow.faces = faces;
    options.shadow.cull = cull;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    renderer.draw(state, smallEye(), lightsOf(scene, state));
    return renderer.readMap(0);
}

TEST(MirroredCasters, HaveTheFacesLeftOutThatTheirImagesHave)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const ImageF nearest = mapOf(gpu, false, CasterFaces::nearest);
    const ImageF back = mapOf(gpu, false, CasterFaces::back);
    EXPECT_GT(differing(nearest, back, 0.002F), 10U) << "else this says nothing";
    EXPECT_EQ(differing(mapOf(gpu, true, CasterFaces::back), back, 0.002F), 0U);
    const ImageF culled = mapOf(gpu, false, CasterFaces::nearest, CasterCull::front);
    EXPECT_GT(differing(culled, back, 0.002F), 10U) << "the ground is open, and its front is left out, too";
    EXPECT_EQ(differing(mapOf(gpu, true, CasterFaces::nearest, CasterCull::front), culled, 0.002F), 0U);
    for (const std::string& message : gpu.messages()) {
        ADD_FAILURE() << message;
    }
}

} // namespace
} // namespace gnomon::host::test
