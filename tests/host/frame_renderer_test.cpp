// SPDX-License-Identifier: Apache-2.0
// Renderers that change while frames are in flight, and renderers that share a scene: every frame is, bit for bit, what
// a renderer of its own would have drawn.
#include "host/frame_renderer.h"
#include "small_scene.h"

#include "scene/state.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::host::test {
namespace {

constexpr WantedImages kAll{.colour = true, .linear = true, .masks = true, .geometry = true};

RenderOptions optionsOf(Filter filter, MapFormat format, Partition partition)
{
    RenderOptions options;
    options.width = 128;
    options.height = 80;
    options.shadow.map_size = 128;
    options.shadow.technique.filter = filter;
    options.shadow.technique.partition = partition;
    options.shadow.format = format;
    return options;
}

/// The moment that a frame shows.
struct Moment {
    RenderOptions options;
    double time_s = 0.0;
    Eye eye;
};

void expectSame(const Picture& a, const Picture& b)
{
    EXPECT_TRUE(a.colour.values == b.colour.values);
    EXPECT_TRUE(a.linear.values == b.linear.values);
    EXPECT_TRUE(a.object_ids.values == b.object_ids.values);
    EXPECT_TRUE(a.depth.values == b.depth.values);
    EXPECT_TRUE(a.normals.values == b.normals.values);
    ASSERT_EQ(a.masks.size(), b.masks.size());
    for (std::size_t light = 0; light < a.masks.size(); ++light) {
        EXPECT_TRUE(a.masks[light].values == b.masks[light].values) << "light " << light;
    }
}

/// With the pane in the shadow of the box that moves.
scene::Scene sceneWithShadedGlass()
{
    scene::Scene scene = smallScene();
    scene.nodes[kGlassNode].transform.translation = {-2.5F, 1.0F, -0.6F};
    scene::finishScene(scene);
    return scene;
}

class FrameRenderers : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    [[nodiscard]] scene::State at(double time_s) const { return scene::evaluate(scene_, time_s); }

    /// By a renderer that never had other options, one frame after the other. All moments have the same options.
    std::vector<Picture> drawnAlone(const std::vector<Moment>& moments)
    {
        RenderOptions options = moments.front().options;
        options.frames_in_flight = 1;
        const SceneOnGpu uploaded(gpu_, scene_, at(0.0));
        FrameRenderer renderer(uploaded, options);
        std::vector<Picture> pictures;
        for (const Moment& moment : moments) {
            const scene::State state = at(moment.time_s);
            renderer.draw(state, moment.eye, lightsOf(scene_, state));
            pictures.push_back(renderer.read(kAll));
        }
        return pictures;
    }

    scene::Scene scene_ = sceneWithShadedGlass();
    Gpu gpu_{{.gpu = "software", .validate = true}};
};

/// Nothing is waited for but the frame before the last; what is drawn is read back by the frames themselves.
class Film {
public:
    explicit Film(FrameRenderer& renderer, Gpu& gpu) : renderer_(renderer), gpu_(gpu) {}

    void add(const scene::Scene& scene, scene::State state, const Eye& eye)
    {
        states_.push_back(std::move(state));
        read_.push_back(std::make_unique<ReadBack>(gpu_, kAll));
        renderer_.submit(states_.back(), eye, lightsOf(scene, states_.back()), read_.back().get());
    }
    [[nodiscard]] std::vector<Picture> finish()
    {
        renderer_.finish();
        std::vector<Picture> pictures;
        for (const auto& one : read_) {
            pictures.push_back(one->picture());
        }
        return pictures;
    }

private:
    FrameRenderer& renderer_;
    Gpu& gpu_;
    std::deque<scene::State> states_;
    std::vector<std::unique_ptr<ReadBack>> read_;
};

TEST_F(FrameRenderers, ChangeTheirTechniqueWithFramesInFlight)
{
    std::vector<RenderOptions> techniques{optionsOf(Filter::pcf, MapFormat::d32f, Partition::single),
                                          optionsOf(Filter::hard, MapFormat::d16, Partition::cascades),
                                          optionsOf(Filter::vsm, MapFormat::rg32f, Partition::single),
                                          optionsOf(Filter::pcf, MapFormat::r32f, Partition::sdsm),
                                          optionsOf(Filter::raymarch, MapFormat::d32f, Partition::cascades)};
    techniques.push_back(techniques.front());
    techniques.back().shadows = false;
    constexpr std::size_t kFrames = 2; // of each, so that both slots have it before the next one comes
    const SceneOnGpu uploaded(gpu_, scene_, at(0.0));
    FrameRenderer renderer(uploaded, techniques.front());
    Film film(renderer, gpu_);
    std::vector<std::vector<Moment>> moments;
    for (const RenderOptions& technique : techniques) {
        renderer.setShadows(technique.shadows ? std::optional(technique.shadow) : std::nullopt);
        moments.emplace_back();
        for (std::size_t i = 0; i < kFrames; ++i) {
            const double step = static_cast<double>(moments.size() * kFrames + i);
            Moment moment{technique, 0.1 * step, smallEye()};
            moment.eye.position_ws.x += 0.05 * step;
            film.add(scene_, at(moment.time_s), moment.eye);
            moments.back().push_back(moment);
        }
    }
    const std::vector<Picture> pictures = film.finish();
    for (std::size_t technique = 0; technique < moments.size(); ++technique) {
        const std::vector<Picture> alone = drawnAlone(moments[technique]);
        for (std::size_t i = 0; i < kFrames; ++i) {
            SCOPED_TRACE("technique " + std::to_string(technique) + ", frame " + std::to_string(i));
            expectSame(pictures[technique * kFrames + i], alone[i]);
        }
    }
}

TEST_F(FrameRenderers, ChangeTheirSizeWithFramesInFlight)
{
    RenderOptions options = optionsOf(Filter::pcf, MapFormat::d32f, Partition::cascades);
    options.shadow.technique.fit = Fit::uniform; // an automatic one remembers the frames before
    options.anti_aliasing = AntiAliasing::fxaa;
    options.bloom.on = true;
    const SceneOnGpu uploaded(gpu_, scene_, at(0.0));
    FrameRenderer renderer(uploaded, options);
    Film film(renderer, gpu_);
    std::vector<Moment> moments;
    constexpr std::array<std::array<std::uint32_t, 2>, 4> kSizes{{{128, 80}, {161, 90}, {161, 90}, {64, 101}}};
    for (const auto& [width, height] : kSizes) {
        options.width = width;
        options.height = height;
        moments.push_back({options, 0.1 * static_cast<double>(moments.size()), smallEye()});
        renderer.resize(width, height);
        film.add(scene_, at(moments.back().time_s), moments.back().eye);
    }
    EXPECT_EQ(renderer.options().height, 101U);
    EXPECT_THROW(renderer.resize(0, 10), Error);
    const std::vector<Picture> pictures = film.finish();
    for (std::size_t i = 0; i < moments.size(); ++i) {
        SCOPED_TRACE("frame " + std::to_string(i));
        ASSERT_EQ(pictures[i].colour.width, moments[i].options.width);
        expectSame(pictures[i], drawnAlone({moments[i]}).front());
    }
}

/// The scene has a flag that deforms: its vertices are shared, and each renderer is at another time.
TEST_F(FrameRenderers, ShareAScene)
{
    const std::vector<RenderOptions> techniques{optionsOf(Filter::pcf, MapFormat::d32f, Partition::single),
                                                optionsOf(Filter::msm, MapFormat::rgba16, Partition::cascades)};
    const SceneOnGpu uploaded(gpu_, scene_, at(0.0));
    FrameRenderer first(uploaded, techniques[0]);
    FrameRenderer second(uploaded, techniques[1]);
    Film first_film(first, gpu_);
    Film second_film(second, gpu_);
    std::vector<Moment> of_first;
    std::vector<Moment> of_second;
    constexpr std::array<std::array<double, 2>, 4> kTimes{{{0.0, 0.7}, {0.4, 0.7}, {0.4, 0.2}, {0.4, 0.4}}};
    for (const auto& [first_s, second_s] : kTimes) {
        of_first.push_back({techniques[0], first_s, smallEye()});
        of_second.push_back({techniques[1], second_s, smallEye()});
        first_film.add(scene_, at(first_s), smallEye());
        second_film.add(scene_, at(second_s), smallEye());
    }
    const std::vector<Picture> by_first = first_film.finish();
    const std::vector<Picture> by_second = second_film.finish();
    const std::vector<Picture> first_alone = drawnAlone(of_first);
    const std::vector<Picture> second_alone = drawnAlone(of_second);
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
        SCOPED_TRACE("frame " + std::to_string(i));
        expectSame(by_first[i], first_alone[i]);
        expectSame(by_second[i], second_alone[i]);
    }
}

TEST_F(FrameRenderers, UploadAScenesMemoryOnce)
{
    const SceneOnGpu uploaded(gpu_, scene_, at(0.0));
    const RenderOptions options = optionsOf(Filter::pcf, MapFormat::d32f, Partition::single);
    const auto sceneBytes = [](const std::vector<vulkan::MemoryUse>& uses) {
        VkDeviceSize bytes = 0;
        for (const vulkan::MemoryUse& use : uses) {
            bytes += std::string_view(use.purpose).starts_with("scene positions") ? use.bytes : 0;
        }
        return bytes;
    };
    const VkDeviceSize before = sceneBytes(uploaded.memory());
    const FrameRenderer first(uploaded, options);
    const FrameRenderer second(uploaded, options);
    EXPECT_GT(before, 0U);
    EXPECT_EQ(sceneBytes(uploaded.memory()), before);
    EXPECT_EQ(sceneBytes(second.memory()), before);
}

} // namespace
} // namespace gnomon::host::test
