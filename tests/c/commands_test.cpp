// SPDX-License-Identifier: Apache-2.0
// The commands of frames, carried out on paper.
#include "allocation_count.h"
#include "paper_executor.h"

#include <gnomon/gnomon.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace gnomon::test {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 90;

/// A ground and boxes under a sun, a spot and a lamp, one of which moves. The last box moves.
class World {
public:
    explicit World(std::initializer_list<std::array<const char*, 2>> options, std::uint32_t lights = 3)
        : light_count_(lights)
    {
        for (const auto& [key, value] : options) {
            EXPECT_EQ(gnomonSetOption(planner, 0, key, value), GNOMON_OK) << gnomonLastError()->message;
        }
        add({-20.0F, -0.1F, -20.0F}, {20.0F, 0.0F, 20.0F});
        for (int i = 0; i < 5; ++i) {
            add(glm::vec3(-8 + 3 * i, 0, -3), glm::vec3(-7 + 3 * i, 2, -2));
        }
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;
    ~World()
    {
        gnomonFreePlanner(planner);
        gnomonFreeObjects(objects_);
    }

    const GnomonPlan* plan(double time, bool box_moves = true)
    {
        GnomonFrame frame;
        gnomonInitFrame(&frame, sizeof(frame));
        const glm::dvec3 eye(std::sin(time), 3.0, 9.0);
        glm::dmat4 clip = glm::perspective(0.8, 16.0 / 9.0, 0.1, 100.0);
        clip[1][1] *= -1.0;
        clip *= glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
        std::memcpy(frame.camera.clip_from_world, glm::value_ptr(clip), sizeof(frame.camera.clip_from_world));
        std::memcpy(frame.camera.eye_ws, glm::value_ptr(eye), sizeof(frame.camera.eye_ws));
        frame.camera.reversed_z = 0;
        frame.width_px = kWidth;
        frame.height_px = kHeight;
        frame.index = ++index_;
        if (box_moves) {
            const auto x = static_cast<float>(6.0 + std::sin(3.0 * time));
            const GnomonBounds bounds{{x, 0.0F, 0.0F}, {x + 1.0F, 1.0F, 1.0F}};
            EXPECT_EQ(gnomonMoveObjects(objects_, &ids_.back(), &bounds, 1), GNOMON_OK);
        }
        std::array<GnomonLight, 3> lights;
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            GnomonLight& light = lights[i];
            gnomonInitLight(&light, sizeof(light));
            light.key = i;
            light.type = i;
            light.position_ws[1] = 6.0;
            light.direction_ws[0] = i == 0 ? 0.6 : 0.0;
            light.direction_ws[1] = i == 0 ? -0.8 : -1.0;
            light.direction_ws[2] = 0.0;
            light.outer_half_angle_rad = 0.9;
            light.range_m = i == 0 ? 0.0 : 20.0;
        }
        frame.objects = objects_;
        frame.lights = lights.data();
        frame.light_count = light_count_;
        return gnomonPlan(planner, &frame);
    }

    GnomonPlanner* planner = gnomonMakePlanner(GNOMON_INTERFACE);

private:
    void add(glm::vec3 low, glm::vec3 high)
    {
        const GnomonBounds bounds{{low.x, low.y, low.z}, {high.x, high.y, high.z}};
        EXPECT_EQ(gnomonAddObject(objects_, &bounds, nullptr, &ids_.emplace_back()), GNOMON_OK);
    }

    GnomonObjects* objects_ = gnomonMakeObjects(GNOMON_INTERFACE);
    std::vector<GnomonObjectId> ids_;
    std::uint32_t light_count_;
    std::uint64_t index_ = 0;
};

/// A recorder and its executor.
struct Host {
    GnomonRecorder* recorder = gnomonMakeRecorder(GNOMON_INTERFACE, 256, 256, 0);
    PaperExecutor paper{kWidth, kHeight};

    Host() = default;
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    ~Host() { gnomonFreeRecorder(recorder); }

    void draw(const World& world)
    {
        paper.run(gnomonRecordImages(recorder, world.planner, kWidth, kHeight));
        paper.run(gnomonRecordMaps(recorder, world.planner));
        maps_drawn = paper.ran(GNOMON_DRAW_CASTERS);
        paper.run(gnomonRecordMask(recorder, world.planner, GNOMON_HAS_NORMALS, nullptr));
        mask_drawn = paper.ran(GNOMON_DRAW_TRIANGLE);
    }

    std::uint32_t maps_drawn = 0; // callbacks of the last frame
    std::uint32_t mask_drawn = 0;
};

using Options = std::initializer_list<std::array<const char*, 2>>;

TEST(CCommands, NameWhatIsThere)
{
    const std::array<Options, 9> kOptions{{
        {{"filter", "hard"}, {"partition", "single"}},
        {{"filter", "raymarch"}, {"keep-still", "always"}},
        {{"filter", "pcss"}, {"map-format", "r32f"}, {"keep-still", "always"}},
        {{"filter", "pcf"}, {"motion", "step-blend"}, {"soften", "blur"}, {"soften.size", "half"}},
        {{"filter", "vsm"}, {"keep-still", "always"}, {"soften", "blur"}},
        {{"filter", "evsm"}, {"map-sampling", "trilinear"}, {"partition", "cascades"}},
        {{"filter", "lvsm"}, {"lvsm.placement", "lloyd"}, {"msaa", "4"}},
        {{"filter", "lvsm"}, {"lvsm.placement", "gaps"}, {"blur", "none"}, {"msaa", "1"}},
        {{"filter", "raymarch"}, {"partition", "virtual"}, {"texels", "1048576"}},
    }};
    std::set<std::string> modules;
    for (std::size_t i = 0; i < kOptions.size(); ++i) {
        SCOPED_TRACE(i);
        const bool sun_alone = i == 3; // positions of a sun alternate
        World world(kOptions[i], sun_alone ? 1 : 3);
        Host host;
        for (int frame = 0; frame < 8; ++frame) {
            ASSERT_NE(world.plan(0.1 * frame), nullptr) << gnomonLastError()->message;
            host.draw(world);
            EXPECT_GT(host.mask_drawn, 0U);
            EXPECT_TRUE(frame > 0 || host.maps_drawn > 0);
        }
        modules.insert(host.paper.modules().begin(), host.paper.modules().end());
    }
    for (const char* const module :
         {"mask_hard.frag", "mask_raymarch.frag", "mask_pcss.frag", "mask_lvsm.frag", "depth_blocks.comp",
          "moments.comp", "blur_moments_samples.comp", "blur.comp", "mip.comp", "soften.frag", "soften_spread.frag",
          "depth_layers_place.comp", "depth_layers_part.comp"}) {
        EXPECT_TRUE(modules.contains(module)) << module;
    }
}

TEST(CCommands, DrawNothingThatHasNotChanged)
{
    World world({{"filter", "pcf"}, {"motion", "snap"}});
    Host host;
    world.plan(0.0);
    host.draw(world);
    const std::uint32_t all = host.maps_drawn;
    EXPECT_GT(all, 0U);
    world.plan(0.0, false);
    host.draw(world);
    EXPECT_EQ(host.maps_drawn, 0U);
    EXPECT_EQ(gnomonRecordImages(host.recorder, world.planner, kWidth, kHeight)->command_count, 0U);
    EXPECT_EQ(gnomonLoseRecorded(host.recorder, 0), GNOMON_OK);
    host.draw(world);
    EXPECT_EQ(host.maps_drawn, all) << "maps were lost";
    EXPECT_EQ(gnomonLoseRecorded(host.recorder, 1), GNOMON_OK);
    EXPECT_EQ(gnomonRecordMaps(host.recorder, world.planner), nullptr) << "there are no images";
    host.paper.forget();
    host.draw(world);
    EXPECT_EQ(host.maps_drawn, all);
}

TEST(CCommands, ChangeWithTheOptions)
{
    World world({{"filter", "evsm"}});
    Host host;
    for (const char* const filter : {"evsm", "raymarch", "vsm", "hard"}) {
        EXPECT_EQ(gnomonSetOption(world.planner, 0, "filter", filter), GNOMON_OK);
        world.plan(0.0);
        host.draw(world);
        EXPECT_GT(host.maps_drawn, 0U) << filter;
    }
    EXPECT_EQ(gnomonRecordImages(host.recorder, world.planner, 80, 45)->changed, 1U) << "another size";
    const GnomonCommandList* const without = gnomonRecordImages(host.recorder, world.planner, 0, 0);
    ASSERT_NE(without, nullptr);
    EXPECT_EQ(gnomonRecordMask(host.recorder, world.planner, 0, nullptr), nullptr) << "there is no mask";
}

TEST(CCommands, SayWhatIsNotRecorded)
{
    for (const auto& [key, value, found] :
         std::initializer_list<std::array<const char*, 3>>{{"filter", "depth-id", "depth-id"},
                                                           {"soften", "converge", "converge"},
                                                           {"mask-size", "half", "mask-size half"},
                                                           {"motion", "step-alternate", "step-alternate"}}) {
        World world({{key, value}}, 1);
        Host host;
        ASSERT_NE(world.plan(0.0), nullptr) << value << ": " << gnomonLastError()->message;
        EXPECT_EQ(gnomonRecordImages(host.recorder, world.planner, kWidth, kHeight), nullptr) << value;
        EXPECT_NE(std::string(gnomonLastError()->found).find(found), std::string::npos) << gnomonLastError()->found;
    }
}

TEST(CCommands, RefuseWrongCalls)
{
    EXPECT_EQ(gnomonMakeRecorder(GNOMON_INTERFACE + 1, 256, 256, 0), nullptr);
    EXPECT_EQ(gnomonMakeRecorder(GNOMON_INTERFACE, 0, 256, 0), nullptr);
    for (const std::uint32_t alignment : {0U, 8U, 24U, 1U << 20U}) {
        EXPECT_EQ(gnomonMakeRecorder(GNOMON_INTERFACE, 256, alignment, 0), nullptr) << alignment;
    }
    gnomonFreeRecorder(nullptr);
    World world({{"filter", "pcf"}});
    Host host;
    EXPECT_EQ(gnomonRecordMaps(host.recorder, world.planner), nullptr) << "there is no plan";
    EXPECT_EQ(gnomonRecordMaps(nullptr, world.planner), nullptr);
    EXPECT_EQ(gnomonRecordMaps(host.recorder, nullptr), nullptr);
    EXPECT_EQ(gnomonLoseRecorded(nullptr, 0), GNOMON_REFUSED);
    world.plan(0.0);
    EXPECT_EQ(gnomonRecordMaps(host.recorder, world.planner), nullptr) << "there are no images";
    EXPECT_EQ(gnomonRecordMask(host.recorder, world.planner, 0, nullptr), nullptr);
    host.draw(world);
    EXPECT_EQ(gnomonRecordMask(host.recorder, world.planner, 8, nullptr), nullptr) << "there is no such image";
    GnomonPrecision precision;
    gnomonInitPrecision(&precision, sizeof(precision));
    precision.depth_rounding = std::nanf("");
    EXPECT_EQ(gnomonRecordMask(host.recorder, world.planner, 0, &precision), nullptr);
}

TEST(CCommands, AllocateNothingOnceWarm)
{
    World world({{"filter", "evsm"}, {"keep-still", "always"}});
    Host host;
    std::uint64_t allocations = 0;
    for (int frame = 0; frame < 40; ++frame) {
        world.plan(0.01 * frame);
        const std::uint64_t before = heapAllocations();
        (void)gnomonRecordImages(host.recorder, world.planner, kWidth, kHeight);
        (void)gnomonRecordMaps(host.recorder, world.planner);
        (void)gnomonRecordMask(host.recorder, world.planner, 0, nullptr);
        allocations += frame >= 20 ? heapAllocations() - before : 0;
    }
    EXPECT_EQ(allocations, 0U);
}

TEST(CCommands, OutlastAHeapThatIsExhausted)
{
    World world({{"filter", "vsm"}});
    world.plan(0.0);
    const auto record = [&](const Host& host, int call) {
        return call == 0   ? gnomonRecordImages(host.recorder, world.planner, kWidth, kHeight)
               : call == 1 ? gnomonRecordMaps(host.recorder, world.planner)
                           : gnomonRecordMask(host.recorder, world.planner, 0, nullptr);
    };
    int failures = 0;
    for (int failing_call = 0; failing_call < 3; ++failing_call) {
        for (std::uint64_t nth = 1; nth < 60; ++nth) {
            Host host;
            const GnomonCommandList* list = nullptr;
            for (int call = 0; call < failing_call; ++call) {
                host.paper.run(record(host, call));
            }
            {
                const FailingAllocation failing(nth);
                list = record(host, failing_call);
            }
            if (list != nullptr) {
                host.paper.run(list);
            } else {
                ++failures;
                EXPECT_EQ(gnomonLastError()->status, GNOMON_OUT_OF_MEMORY);
            }
            host.draw(world);
        }
    }
    EXPECT_GT(failures, 20);
}

} // namespace
} // namespace gnomon::test
