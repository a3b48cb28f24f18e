// SPDX-License-Identifier: Apache-2.0
// A renderer by OpenGL keeps from frame to frame: maps that hold what the plan presumes, maps of still casters,
// and the host's state.
#include "option_steps.h"
#include "sides.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 48};

/// The scene's objects, of which the first box moves.
struct MovingBox {
    MovingBox()
    {
        (void)objects.add({{-30.0F, 0.0F, -30.0F}, {30.0F, 0.0F, 30.0F}});
        for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
            (void)objects.add(boundsOf(scene.boxes[i]), {.dynamic = i == 0});
        }
    }
    [[nodiscard]] static Aabb boundsOf(const Box& box)
    {
        const auto reach = static_cast<float>(glm::length(box.half));
        return {glm::vec3(box.centre) - reach, glm::vec3(box.centre) + reach};
    }
    /// As PlannedScene::moveCaster() does.
    void move()
    {
        scene.boxes[0].centre += glm::dvec3(0.4, 0.0, 0.3);
        (void)objects.update(objects.idAt(1), boundsOf(scene.boxes[0]));
    }
    [[nodiscard]] Frame frameOf(std::span<const Light> lights, const Camera& camera) const
    {
        Frame frame;
        frame.camera = camera;
        frame.size_px = {kScreen.width, kScreen.height};
        frame.lights = lights;
        frame.objects = &objects;
        return frame;
    }

    Scene scene = makeScene();
    ObjectSet objects;
};

class GlKept : public testing::TestWithParam<const char*> {};

TEST_P(GlKept, mapsAreRestoredUnderWhatMoves)
{
    GNOMON_NEEDS_EGL();
    VulkanSide vulkan(kScreen);
    GlSide by_gl(kScreen);
    MovingBox moving;
    Planner planner(optionsFrom(GetParam()));
    const std::vector<Light> lights = lightsOf("sun spot");
    const Camera camera = vulkan.scene.frameOf(lights).camera;
    std::uint32_t restored = 0;
    std::uint32_t held = 0;
    for (int i = 0; i < 6; ++i) {
        const Plan& plan = planner.plan(moving.frameOf(lights, camera));
        EXPECT_LE(farthest(by_gl.draw(plan), vulkan.scene.draw(vulkan.drawing, plan)), 1) << "frame " << i;
        const vulkan::MapReuse wanted = vulkan.drawing.renderer.reuse(0);
        const gl::MapReuse reuse = by_gl.renderer.reuse();
        EXPECT_EQ(reuse.drawn, wanted.drawn) << i;
        EXPECT_EQ(reuse.restored, wanted.restored) << i;
        EXPECT_EQ(reuse.kept_drawn, wanted.kept_drawn) << i;
        EXPECT_EQ(reuse.held, wanted.held) << i;
        restored += i > 0 ? reuse.restored : 0;
        held += reuse.held;
        if (i % 2 == 1) { // every other frame nothing moves
            moving.move();
            vulkan.scene.moveCaster();
            by_gl.scene.scene = moving.scene;
        }
    }
    EXPECT_GT(restored, 0U);
    EXPECT_GT(held, 0U);
    EglContext::instance().expectSilence();
}

INSTANTIATE_TEST_SUITE_P(Options, GlKept,
                         testing::Values("filter=hard map-size=128 partition=single motion=snap keep-still=always",
                                         "filter=pcss map-size=128 partition=single motion=snap keep-still=always",
                                         "filter=pcf map-format=r32f map-size=128 motion=snap keep-still=always",
                                         "filter=vsm map-size=128 partition=single motion=snap keep-still=always"));

TEST(GlReuse, GrownMapsTakeOverWhatWasDrawn)
{
    GNOMON_NEEDS_EGL();
    VulkanSide vulkan(kScreen);
    GlSide by_gl(kScreen);
    Planner planner(optionsFrom("filter=evsm map-size=128 partition=single motion=snap"));
    std::vector<Light> lights = lightsOf("sun");
    (void)by_gl.draw(planner.plan(vulkan.scene.frameOf(lights)));
    lights = lightsOf("sun spot lamp");
    const Plan& plan = planner.plan(vulkan.scene.frameOf(lights));
    const std::vector<std::byte> drawn = by_gl.draw(plan);
    EXPECT_GT(by_gl.renderer.reuse().held, 0U);
    EXPECT_LE(farthest(drawn, vulkan.scene.draw(vulkan.drawing, plan)), 1);
    by_gl.renderer.reset();
    (void)by_gl.draw(plan);
    EXPECT_EQ(by_gl.renderer.reuse().held, 0U) << "after a reset all is drawn again";
    EglContext::instance().expectSilence();
}

constexpr GLenum kNames[] = {GL_CLIP_DISTANCE3,
                             GL_DITHER,
                             GL_CULL_FACE,
                             GL_DEPTH_TEST,
                             GL_DEPTH_CLAMP,
                             GL_STENCIL_TEST,
                             GL_BLEND,
                             GL_SCISSOR_TEST,
                             GL_MULTISAMPLE,
                             GL_DEPTH_FUNC,
                             GL_CURRENT_PROGRAM,
                             GL_CLIP_ORIGIN,
                             GL_VERTEX_ARRAY_BINDING,
                             GL_CLIP_DEPTH_MODE,
                             GL_DRAW_FRAMEBUFFER_BINDING,
                             GL_VIEWPORT,
                             GL_SCISSOR_BOX,
                             GL_COLOR_WRITEMASK,
                             GL_BLEND_SRC_RGB,
                             GL_READ_FRAMEBUFFER_BINDING,
                             GL_BLEND_DST_ALPHA,
                             GL_DEPTH_RANGE,
                             GL_BLEND_EQUATION_RGB,
                             GL_DEPTH_WRITEMASK};

TEST(GlState, IsAsTheHostHadIt)
{
    GNOMON_NEEDS_EGL();
    VulkanSide vulkan(kScreen);
    GlSide by_gl(kScreen);
    Planner planner(optionsFrom("filter=vsm soften=blur map-size=64"));
    const Plan& plan = planner.plan(vulkan.scene.frameOf(lightsOf("sun spot")));
    const auto state = [] {
        std::vector<GLint> values;
        for (const GLenum name : kNames) {
            GLint value[4] = {};
            glGetIntegerv(name, value);
            values.insert(values.end(), std::begin(value), std::end(value));
        }
        return values;
    };
    glEnable(GL_CULL_FACE);
    glEnable(GL_CLIP_DISTANCE3);
    glEnable(GL_BLEND);
    glEnable(GL_STENCIL_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glViewport(1, 2, 3, 4);
    glScissor(5, 6, 7, 8);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    const std::vector<GLint> before = state();
    const std::vector<std::byte> drawn = by_gl.draw(plan);
    EXPECT_EQ(state(), before);
    const auto samplers = [] {
        int bound = 0;
        for (GLenum unit = 0; unit < 12; ++unit) {
            GLint sampler = 0;
            glGetIntegeri_v(GL_SAMPLER_BINDING, unit, &sampler);
            bound += sampler != 0 ? 1 : 0;
        }
        return bound;
    };
    EXPECT_EQ(samplers(), 0);
    const auto fail = [&](const gl::MapPass&) {
        EXPECT_EQ(samplers(), 0) << "in the callback";
        throw std::runtime_error("a host's own");
    };
    by_gl.renderer.reset();
    (void)by_gl.renderer.prepare(plan, by_gl.inputs.size_px);
    EXPECT_THROW(by_gl.renderer.drawMaps(plan, fail), std::runtime_error);
    EXPECT_EQ(state(), before);
    EXPECT_EQ(by_gl.draw(plan), drawn) << "after a call that threw";
    for (const GLenum name : {GL_CULL_FACE, GL_BLEND, GL_STENCIL_TEST, GL_CLIP_DISTANCE3}) {
        glDisable(name);
    }
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    EXPECT_LE(farthest(drawn, vulkan.scene.draw(vulkan.drawing, plan)), 1);
    EglContext::instance().expectSilence();
}

TEST(GlMisuse, IsAnErrorWithASentence)
{
    GNOMON_NEEDS_EGL();
    VulkanSide vulkan(kScreen);
    GlSide by_gl(kScreen);
    const std::vector<Light> suns = lightsOf("sun");
    const Frame frame = vulkan.scene.frameOf(suns);
    for (const char* const refused :
         {"partition=sdsm", "partition=auto quality=best", "filter=depth-id", "filter=id", "filter=smoothies",
          "soften=smoothies", "soften=converge", "motion=step-alternate", "caster-faces=midpoint", "mask-size=half",
          "partition=cascades cascades.pass=layered", "filter=vsm blur=gaussian blur.path=fragment"}) {
        Planner planner(optionsFrom(refused));
        const Plan& plan = planner.plan(frame);
        EXPECT_THROW((void)by_gl.renderer.prepare(plan, {64, 48}), Error) << refused;
    }
    Planner planner(optionsFrom("filter=hard map-size=64"));
    Plan plan = planner.plan(frame);
    EXPECT_THROW(by_gl.renderer.drawMaps(plan, by_gl.scene.callback()), Error) << "without prepare()";
    (void)by_gl.draw(plan);
    EXPECT_THROW(by_gl.renderer.drawMaps(plan, {}), Error);
    gl::MaskInputs inputs = by_gl.inputs;
    inputs.depth = 0;
    EXPECT_THROW(by_gl.renderer.drawMask(plan, inputs), Error);
    inputs = by_gl.inputs;
    inputs.size_px.x += 1;
    EXPECT_THROW(by_gl.renderer.drawMask(plan, inputs), Error);
    inputs = by_gl.inputs;
    inputs.normal = inputs.depth + 1000; // no texture
    EXPECT_THROW(by_gl.renderer.drawMask(plan, inputs), Error);
    EXPECT_NE(glGetError(), static_cast<GLenum>(GL_NO_ERROR)) << "OpenGL says so, too";
    EglContext::instance().forget();
    plan.views[0].place.tile.x = 1U << 20;
    EXPECT_THROW((void)by_gl.renderer.prepare(plan, {64, 48}), Error);
    EXPECT_THROW(gl::ShadowRenderer({nullptr, {}}), Error);
    EXPECT_THROW(gl::ShadowRenderer({[](const char*) -> void* { return nullptr; }, {}}), Error);
    EglContext::instance().expectSilence();
}

} // namespace
} // namespace gnomon::test
