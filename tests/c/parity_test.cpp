// SPDX-License-Identifier: Apache-2.0
// The same frames through both interfaces: 200 of a moving camera, with objects that move, come and go, lights that
// come and go, and options that change.
#include "same_plan.h"
#include "structs.h"

#include <gnomon/pack/page_table.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <set>
#include <string>

namespace gnomon::test {
namespace {

struct Free {
    void operator()(GnomonObjects* objects) const { gnomonFreeObjects(objects); }
    void operator()(GnomonPlanner* planner) const { gnomonFreePlanner(planner); }
};

/// Options of two kinds of lights: by keys, and the same in C++.
struct Setting {
    std::vector<std::array<const char*, 2>> keys; // options 0, then those after an empty key are options 1
    std::array<ShadowOptions, 2> options;
};

std::vector<Setting> settings()
{
    const ShadowOptions small{.max_texels = 1U << 18U};
    std::vector<Setting> all;
    all.push_back({{{"texels", "262144"},
                    {"", ""},
                    {"filter", "pcf"},
                    {"partition", "cube"},
                    {"map-size", "128"},
                    {"draw-budget", "40000"}},
                   {small,
                    {.technique = {.partition = Partition::cube, .filter = Filter::pcf},
                     .map_size = 128,
                     .draw_budget_texels = 40000}}});
    ShadowOptions cascades{.technique = {Partition::cascades, Fit::uniform, Filter::evsm, Soften::none, Motion::snap},
                           .map_size = 128,
                           .max_distance_m = 60.0,
                           .keep_still = KeepStill::always};
    cascades.cascades.ends_m = {4.0, 12.0, 30.0};
    all.push_back({{{"partition", "cascades"},
                    {"fit", "uniform"},
                    {"filter", "evsm"},
                    {"motion", "snap"},
                    {"map-size", "128"},
                    {"max-distance", "60"},
                    {"keep-still", "always"},
                    {"cascades.ends", "4/12/30"},
                    {"", ""},
                    {"filter", "depth-id"},
                    {"partition", "cube"},
                    {"fit", "uniform"},
                    {"map-size", "64"}},
                   {cascades, {.technique = {Partition::cube, Fit::uniform, Filter::depth_id}, .map_size = 64}}});
    all.push_back(
        {{{"partition", "single"},
          {"fit", "uniform"},
          {"filter", "pcf"},
          {"motion", "step-blend"},
          {"", ""},
          {"soften", "converge"}},
         {ShadowOptions{.technique = {Partition::single, Fit::uniform, Filter::pcf, Soften::none, Motion::step_blend}},
          {.technique = {.soften = Soften::converge}}}});
    all.push_back({{{"partition", "virtual"},
                    {"fit", "uniform"},
                    {"filter", "hard"},
                    {"", ""},
                    {"partition", "multi"},
                    {"filter", "msm"}},
                   {ShadowOptions{.technique = {Partition::virtual_pages, Fit::uniform, Filter::hard}},
                    {.technique = {.partition = Partition::multi, .filter = Filter::msm}}}});
    return all;
}

/// A scene, twice: for either interface.
class Stage {
public:
    Stage()
    {
        add({{-40.0F, -0.1F, -40.0F}, {40.0F, 0.0F, 40.0F}}, {.casts = false});
        for (int i = 0; i < 40; ++i) {
            add(box(), {.dynamic = i % 3 == 0, .pieces = 6, .groups = i % 7 == 0 ? 3U : kCommonGroup});
        }
        for (std::uint32_t i = 0; i < 4; ++i) {
            addLight();
        }
    }

    /// Plans the frame by both, and compares. The next frame is another one.
    void step(int number)
    {
        change(number);
        frame_.index = static_cast<std::uint64_t>(number);
        frame_.time_s = number / 30.0;
        frame_.cut = number == 120;
        frame_.lights = lights_;
        frame_.objects = &set_;
        moveCamera(number);
        const GnomonFrame shown = inC();
        expectSameFrame(shown);
        const GnomonPlan* plan = gnomonPlan(c_planner_.get(), &shown);
        ASSERT_NE(plan, nullptr) << gnomonLastError()->message;
        const Plan& wanted = planner_.plan(frame_);
        expectSamePlan(c_planner_.get(), *plan, wanted);
        EXPECT_EQ(wanted.made_for.lights, lights_);
        expectSameBuffers(c_planner_.get(), wanted);
        expectSameRows(c_planner_.get(), wanted);
        noteKinds(wanted);
        views_ += wanted.views.size();
    }

    void use(const Setting& setting)
    {
        for (std::uint32_t options = 0; options < 2; ++options) {
            for (std::uint32_t row = 0; row < gnomonOptionCount(); ++row) {
                const GnomonOption& option = *gnomonOptionAt(row);
                ASSERT_EQ(gnomonSetOption(c_planner_.get(), options, option.key, option.default_value), GNOMON_OK)
                    << gnomonLastError()->message;
            }
        }
        std::uint32_t options = 0;
        for (const auto& [key, value] : setting.keys) {
            options += *key == '\0' ? 1 : 0;
            if (*key != '\0') {
                ASSERT_EQ(gnomonSetOption(c_planner_.get(), options, key, value), GNOMON_OK)
                    << gnomonLastError()->message;
            }
        }
        planner_ = Planner(setting.options);
    }

    /// Changes an option of a planner that has made plans.
    void filterBy(Filter filter, const Setting& setting)
    {
        ASSERT_EQ(gnomonSetOption(c_planner_.get(), 0, "filter", std::string(nameOf(filter)).c_str()), GNOMON_OK);
        std::array options = setting.options;
        options[0].technique.filter = filter;
        planner_ = Planner(options);
    }

    [[nodiscard]] std::size_t views() const { return views_; }
    [[nodiscard]] const std::set<std::string>& kinds() const { return kinds_; }

private:
    void noteKinds(const Plan& plan)
    {
        const auto note = [&](bool has, std::string_view kind) {
            if (has) {
                kinds_.emplace(kind);
            }
        };
        for (const LightPlan& light : plan.lights) {
            kinds_.emplace(nameOf(light.outcome.kind));
            note(light.steps.paired, "paired");
            note(light.sample.joined, "joined");
            note(light.choice.made, "chosen");
            note(light.waited > 0, "waiting");
        }
        for (const View& view : plan.views) {
            note(view.contents.kept_layer != kNoIndex, "kept");
            note(view.serves.slice.bounded(), "slice");
            note(view.serves.sector.bounded(), "sector");
            note(view.projection.orthographic, "orthographic");
        }
        note(!plan.object_ids.empty(), "ids");
        note(!plan.moved_ws.empty(), "moved");
        std::vector<glm::uvec2> pages;
        pack::fillPageTable(plan, pages);
        note(!pages.empty(), "pages");
    }

    double random(double low, double high) { return std::uniform_real_distribution(low, high)(numbers_); }

    Aabb box()
    {
        const glm::vec3 at(random(-25.0, 25.0), 0.0, random(-25.0, 25.0));
        return {at, at + glm::vec3(random(0.3, 3.0), random(0.3, 4.0), random(0.3, 3.0))};
    }

    static GnomonBounds bounds(const Aabb& box)
    {
        return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
    }

    void add(const Aabb& box, const ObjectFlags& flags)
    {
        GnomonObjectFlags c_flags;
        gnomonInitObjectFlags(&c_flags, sizeof(c_flags));
        c_flags.casts = flags.casts ? 1 : 0;
        c_flags.dynamic = flags.dynamic ? 1 : 0;
        c_flags.pieces = flags.pieces;
        c_flags.groups = flags.groups;
        const GnomonBounds c_box = bounds(box);
        GnomonObjectId id;
        ASSERT_EQ(gnomonAddObject(c_set_.get(), &c_box, &c_flags, &id), GNOMON_OK);
        ids_.push_back(set_.add(box, flags));
        EXPECT_EQ(id.index, ids_.back().index);
        c_ids_.push_back(id);
    }

    void addLight()
    {
        Light light;
        light.key = next_key_++;
        light.type = static_cast<LightType>(light.key % 3);
        light.position_ws = {random(-15.0, 15.0), random(3.0, 8.0), random(-15.0, 15.0)};
        light.direction_ws = glm::normalize(glm::dvec3(random(-0.6, 0.6), -1.0, random(-0.6, 0.6)));
        light.outer_half_angle_rad = random(0.3, 0.9);
        light.range_m = random(8.0, 30.0);
        light.near_m = light.key % 2 == 0 ? 0.0 : 0.1;
        light.radius_m = 0.1;
        light.brightness = random(0.5, 2.0);
        light.options = light.type == LightType::directional ? 0 : 1;
        light.map_size = light.key % 5 == 4 ? 32 : 0;
        light.groups = light.key % 4 == 3 ? 2U : kAllGroups;
        light.casts_shadow = light.key % 11 != 10;
        lights_.push_back(light);
    }

    void change(int number)
    {
        for (std::size_t i = 1; i < ids_.size(); i += 3) {
            const Aabb moved = box();
            const GnomonBounds c_moved = bounds(moved);
            EXPECT_TRUE(number % 2 == 0 || set_.update(ids_[i], moved));
            EXPECT_TRUE(number % 2 == 0 || gnomonMoveObjects(c_set_.get(), &c_ids_[i], &c_moved, 1) == GNOMON_OK);
        }
        if (number % 10 == 5) {
            EXPECT_TRUE(set_.remove(ids_.back()));
            EXPECT_EQ(gnomonRemoveObject(c_set_.get(), c_ids_.back()), GNOMON_OK);
            ids_.pop_back();
            c_ids_.pop_back();
        } else if (number % 10 == 8) {
            add(box(), {.pieces = 6});
        }
        if (number % 13 == 6 && lights_.size() > 2) {
            lights_.erase(lights_.begin() + 1);
        } else if (number % 9 == 4) {
            addLight();
        }
        lights_.front().direction_ws = glm::normalize(glm::dvec3(0.3 + 0.002 * number, -1.0, 0.2));
    }

    void moveCamera(int number)
    {
        const double turn = 0.03 * number;
        frame_.camera.eye_ws = {12.0 * std::sin(turn), 3.0 + std::sin(0.1 * number), 12.0 * std::cos(turn)};
        glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(1.0, 16.0 / 9.0, 200.0, 0.1);
        clip_from_view[1][1] = -clip_from_view[1][1];
        frame_.camera.clip_from_world =
            clip_from_view * glm::lookAtRH(frame_.camera.eye_ws, glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
        cells_.clear();
        for (int i = 0; i < 30; ++i) {
            cells_.push_back({{static_cast<float>(random(0.0, 1280.0)), static_cast<float>(random(300.0, 720.0))},
                              static_cast<float>(random(0.002, 0.02)),
                              4.0F});
        }
        requests_ = {{lights_.front().key, frame_.camera.clip_from_world, frame_.size_px, cells_}};
        frame_.requests = requests_;
    }

    GnomonFrame inC()
    {
        c_lights_.clear();
        for (const Light& light : lights_) {
            c_lights_.push_back(lightOf(light));
        }
        c_cells_.clear();
        for (const SeenCell& cell : cells_) {
            c_cells_.push_back({{cell.place_px.x, cell.place_px.y}, cell.depth, cell.edge});
        }
        gnomonInitPageRequests(&c_requests_, sizeof(c_requests_));
        c_requests_.light_key = requests_[0].light_key;
        std::memcpy(c_requests_.clip_from_world, glm::value_ptr(requests_[0].clip_from_world),
                    sizeof(c_requests_.clip_from_world));
        c_requests_.width_px = requests_[0].size_px.x;
        c_requests_.height_px = requests_[0].size_px.y;
        c_requests_.cells = c_cells_.data();
        c_requests_.cell_count = c_cells_.size();
        GnomonFrame out = frameOf(frame_);
        out.objects = c_set_.get();
        out.lights = c_lights_.data();
        out.light_count = static_cast<std::uint32_t>(c_lights_.size());
        out.requests = &c_requests_;
        out.request_count = 1;
        return out;
    }

    void expectSameFrame(const GnomonFrame& shown)
    {
        c::FrameTaker taker;
        const Frame& taken = taker.take(shown);
        EXPECT_EQ(taken.index, frame_.index);
        EXPECT_EQ(taken.time_s, frame_.time_s);
        EXPECT_EQ(taken.camera, frame_.camera);
        EXPECT_EQ(taken.size_px, frame_.size_px);
        EXPECT_TRUE(std::ranges::equal(taken.lights, frame_.lights));
        EXPECT_EQ(taken.cut, frame_.cut);
        EXPECT_EQ(taken.rates, frame_.rates);
        ASSERT_EQ(taken.requests.size(), 1U);
        ASSERT_EQ(taken.requests[0].cells.size(), cells_.size());
        EXPECT_EQ(std::memcmp(taken.requests[0].cells.data(), cells_.data(), cells_.size() * sizeof(SeenCell)), 0);
    }

    std::mt19937 numbers_{7};
    ObjectSet set_;
    std::vector<ObjectId> ids_;
    std::vector<Light> lights_;
    std::vector<SeenCell> cells_;
    std::vector<PageRequests> requests_;
    Frame frame_;
    Planner planner_;
    std::unique_ptr<GnomonObjects, Free> c_set_{gnomonMakeObjects(GNOMON_INTERFACE)};
    std::unique_ptr<GnomonPlanner, Free> c_planner_{gnomonMakePlanner(GNOMON_INTERFACE)};
    std::vector<GnomonObjectId> c_ids_;
    std::vector<GnomonLight> c_lights_;
    std::vector<GnomonSeenCell> c_cells_;
    GnomonPageRequests c_requests_{};
    std::uint32_t next_key_ = 0;
    std::size_t views_ = 0;
    std::set<std::string> kinds_; // what the plans had
};

TEST(CParity, PlansAreThoseOfCppOver200Frames)
{
    constexpr int kFrames = 200;
    const std::vector<Setting> all = settings();
    Stage stage;
    for (int frame = 0; frame < kFrames && !HasFailure(); ++frame) {
        SCOPED_TRACE(frame);
        const std::size_t part = static_cast<std::size_t>(frame) * all.size() / kFrames;
        if (frame % (kFrames / static_cast<int>(all.size())) == 0) {
            stage.use(all[part]);
        }
        if (frame == 25) {
            stage.filterBy(Filter::pcss, all[part]);
        }
        stage.step(frame);
    }
    // The frames have something of everything.
    EXPECT_GT(stage.views(), 2000U);
    EXPECT_EQ(stage.kinds(), (std::set<std::string>{"chosen", "ids", "joined", "kept", "moved", "no_caster",
                                                    "no_receiver", "no_shadow_wanted", "ok", "orthographic", "pages",
                                                    "paired", "sector", "slice", "waiting"}));
}

} // namespace
} // namespace gnomon::test
