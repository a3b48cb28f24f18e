// SPDX-License-Identifier: Apache-2.0
// Who draws as the plan says has the same maps as one who draws all of them in every frame. The draughtsman here keeps,
// for each texel, the sum of marks of what was drawn there.
#include "store/map_contents.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>

namespace gnomon {
namespace {

using test::Random;

using Image = std::vector<std::uint64_t>;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b)
{
    return Random(a * 31 + b).bits();
}

/// Of a view's matrix and metric, which all that is drawn depends on.
std::uint64_t markOf(const View& view)
{
    std::uint64_t mark = view.clamp_near ? 1 : 0;
    for (int i = 0; i < 16; ++i)
        mark = mixed(mark, std::bit_cast<std::uint64_t>(view.clip_from_world[i / 4][i % 4] + 0.0));
    for (int i = 0; i < 4; ++i)
        mark = mixed(mark, std::bit_cast<std::uint64_t>(view.metric.metric_ws[i] + 0.0));
    return mark;
}

/// The texels around a box's image; all where the box reaches behind the light.
TexelRect imageOf(const View& view, const Aabb& box)
{
    const double size = view.tile.width;
    glm::dvec2 low(1e9);
    glm::dvec2 high(-1e9);
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 c = view.clip_from_world * glm::dvec4(glm::dvec3(box.corner(i)), 1.0);
        if (c.w <= 0.0)
            return {0, 0, view.tile.width, view.tile.height};
        low = glm::min(low, (glm::dvec2(c) / c.w * 0.5 + 0.5) * size);
        high = glm::max(high, (glm::dvec2(c) / c.w * 0.5 + 0.5) * size);
    }
    low = glm::clamp(glm::floor(low), 0.0, size);
    high = glm::clamp(glm::ceil(high), 0.0, size);
    return {static_cast<std::uint32_t>(low.x), static_cast<std::uint32_t>(low.y),
            static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)};
}

bool inside(const TexelRect& rect, std::uint32_t x, std::uint32_t y)
{
    return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
}

struct Draughtsman {
    using Place = std::tuple<std::uint32_t, TexelPart>;
    std::map<Place, Image> maps;
    std::map<std::uint32_t, Image> kept;
    std::uint32_t kept_layers = 0;
    std::uint64_t still_drawn = 0; // casters
    std::uint64_t moving_drawn = 0;
    std::uint64_t dirty_texels = 0;

    static void draw(Image& image, const View& view, std::span<const std::uint32_t> casters, const ObjectSet& set,
                     const TexelRect& scissor)
    {
        const std::uint64_t mark = markOf(view);
        const std::uint32_t size = view.tile.width;
        for (const std::uint32_t object : casters) {
            const TexelRect rect = imageOf(view, set.bounds(object));
            for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y)
                for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x)
                    if (inside(scissor, x, y))
                        image[y * size + x] += mixed(mark, mixed(object, set.changed(object)));
        }
    }
    static Image cleared(const View& view)
    {
        return Image(std::size_t{view.tile.width} * view.tile.height, markOf(view));
    }
    static TexelRect whole(const View& view) { return {0, 0, view.tile.width, view.tile.height}; }

    void follow(const Plan& plan, const ObjectSet& set)
    {
        kept_layers = plan.pages[0].kept_layers;
        for (const View& view : plan.views) {
            const std::span casters = std::span(plan.casters).subspan(view.first_caster, view.caster_count);
            Image& map = maps[{view.tile.layer, view.part}];
            if (view.redraw && view.kept_layer == kNoIndex) {
                map = cleared(view);
                draw(map, view, casters, set, whole(view));
                still_drawn += casters.size();
            } else if (view.redraw) {
                restore(view, map, casters, set);
            }
        }
    }
    void restore(const View& view, Image& map, std::span<const std::uint32_t> casters, const ObjectSet& set)
    {
        ASSERT_LT(view.kept_layer, kept_layers);
        Image& source = kept[view.kept_layer];
        if (view.redraw_kept) {
            source = cleared(view);
            draw(source, view, casters.first(view.still_count), set, whole(view));
            still_drawn += view.still_count;
            ASSERT_EQ(view.dirty.width, view.tile.width);
            ASSERT_EQ(view.dirty.height, view.tile.height);
        }
        ASSERT_FALSE(view.dirty.empty());
        ASSERT_FALSE(source.empty());
        map.resize(source.size());
        for (std::uint32_t y = 0; y < view.tile.height; ++y)
            for (std::uint32_t x = 0; x < view.tile.width; ++x)
                if (inside(view.dirty, x, y))
                    map[y * view.tile.width + x] = source[y * view.tile.width + x];
        draw(map, view, casters.subspan(view.still_count), set, view.dirty);
        moving_drawn += casters.size() - view.still_count;
        dirty_texels += std::uint64_t{view.dirty.width} * view.dirty.height;
    }
    void check(const Plan& plan, const ObjectSet& set) const
    {
        for (std::size_t i = 0; i < plan.views.size(); ++i) {
            const View& view = plan.views[i];
            const SunSteps& steps = plan.lights[view.light].steps;
            if (steps.alternate && view.sun != steps.read)
                continue;
            Image all = cleared(view);
            draw(all, view, std::span(plan.casters).subspan(view.first_caster, view.caster_count), set, whole(view));
            ASSERT_TRUE(maps.at({view.tile.layer, view.part}) == all) << "view " << i;
        }
    }
};

void checkOrder(const Plan& plan, const ObjectSet& set)
{
    std::set<std::pair<std::uint32_t, TexelPart>> places;
    std::set<std::uint32_t> kept;
    for (const View& view : plan.views) {
        EXPECT_TRUE(places.insert({view.tile.layer, view.part}).second);
        EXPECT_LT(view.tile.layer, plan.pages[0].layers);
        const auto first = plan.casters.begin() + view.first_caster;
        const auto end = first + view.caster_count;
        if (view.kept_layer == kNoIndex) {
            EXPECT_TRUE(std::is_sorted(first, end));
            EXPECT_FALSE(view.redraw_kept);
            EXPECT_TRUE(view.dirty.empty());
            continue;
        }
        EXPECT_TRUE(kept.insert(view.kept_layer).second);
        EXPECT_LT(view.kept_layer, plan.pages[0].kept_layers);
        ASSERT_LE(view.still_count, view.caster_count);
        const auto moving = first + view.still_count;
        EXPECT_TRUE(std::is_sorted(first, moving));
        EXPECT_TRUE(std::is_sorted(moving, end));
        EXPECT_TRUE(std::none_of(first, moving, [&](std::uint32_t c) { return set.flags(c).dynamic; }));
        EXPECT_TRUE(std::all_of(moving, end, [&](std::uint32_t c) { return set.flags(c).dynamic; }));
    }
}

/// A world that anything may happen to.
struct Turmoil {
    explicit Turmoil(std::uint64_t seed) : random(seed)
    {
        set.add({{-30, -0.5, -30}, {30, 0, 30}});
        for (int i = 0; i < 25; ++i)
            add(i % 5 == 0);
        lights = {test::sun({0.4, -1, 0.3}), test::spot({0, 30, 0}, {0.1, -1, 0}, 0.6)};
        lights[1].key = 1;
        options.map_size = 16;
        options.border_texels = 1.0;
        options.technique.motion = static_cast<Motion>(random.below(6));
        options.keep_still = static_cast<KeepStill>(random.below(3));
        options.paired_maps = random.below(3) == 0;
        options.technique.filter = random.below(4) == 0 ? Filter::vsm : Filter::pcf;
        if (random.below(3) == 0) {
            options.technique.partition = Partition::cascades;
            options.cascades.count = 2;
        }
        options.steps.by = random.below(2) == 0 ? StepBy::angle : StepBy::time;
        frame.objects = &set;
    }
    void add(bool dynamic)
    {
        const glm::dvec3 centre = random.inBox({-28, 0.5, -28}, {28, 6, 28});
        const glm::dvec3 half = random.inBox(glm::dvec3(0.1), glm::dvec3(2.0));
        objects.push_back(set.add(test::boxAt(centre, half), {random.below(5) != 0, true, dynamic}));
    }
    void happen()
    {
        for (const std::uint32_t object : objects)
            if (set.flags(object).dynamic && random.below(2) == 0) {
                const Aabb& box = set.bounds(object);
                const glm::vec3 by(random.inBox(glm::dvec3(-0.6), glm::dvec3(0.6)));
                const float far = random.below(20) == 0 ? 70.0F : 0.0F; // out of all maps, and back some time
                const glm::vec3 away(box.min.x > 40.0F ? -70.0F : far, 0.0F, 0.0F);
                set.update(object, {box.min + by + away, box.max + by + away});
            }
        const std::uint32_t what = random.below(60);
        const std::size_t any = random.below(static_cast<std::uint32_t>(objects.size()));
        if (what == 0)
            set.touch(objects[any]);
        if (what == 1)
            add(random.below(2) == 0);
        if (what == 2 && objects.size() > 5) {
            set.remove(objects[any]);
            objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(any));
        }
        if (what == 3 || what == 4)
            eye += random.inBox(glm::dvec3(-1.0), glm::dvec3(1.0));
        if (what == 5)
            lights[1].casts_shadow = !lights[1].casts_shadow;
        if (what == 6)
            lights.size() == 2 ? lights.pop_back() : lights.push_back(test::spot({5, 30, 0}, {0.1, -1, 0}, 0.6));
        if (what == 7)
            speed = random.below(3) == 0 ? 0.0 : random.uniform(-0.004, 0.004);
        if (what == 8 && random.below(4) == 0)
            hour += 0.3;
        hour += speed;
        lights[0].direction_ws = glm::normalize(glm::dvec3(std::sin(hour), -1.0, 0.4 * std::cos(hour)));
        frame.time_s += random.below(30) == 0 ? 0.0 : 0.1;
        frame.camera = test::perspectiveCamera(eye, {0, 0, 0}, 1.0, 1.6, 0.1, 200.0);
        frame.lights = lights;
    }

    Random random;
    ObjectSet set;
    std::vector<std::uint32_t> objects;
    std::vector<Light> lights;
    glm::dvec3 eye{20, 15, 25};
    double hour = 0.3;
    double speed = 0.002;
    Frame frame;
    PlanOptions options;
};

TEST(DrawnMaps, AreAsIfDrawnAnewInEveryFrame)
{
    int restored = 0;
    int reused = 0;
    int pairs = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Turmoil world(seed);
        Planner planner(world.options);
        Draughtsman draughtsman;
        for (int frame = 0; frame < 250; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            world.happen();
            if (frame == 120) {
                planner.reset();
                draughtsman = {};
            }
            const Plan& plan = planner.plan(world.frame);
            ASSERT_NO_FATAL_FAILURE(checkOrder(plan, world.set));
            ASSERT_NO_FATAL_FAILURE(draughtsman.follow(plan, world.set));
            ASSERT_NO_FATAL_FAILURE(draughtsman.check(plan, world.set));
            for (const View& view : plan.views) {
                restored += view.redraw && view.kept_layer != kNoIndex && !view.redraw_kept ? 1 : 0;
                reused += view.redraw ? 0 : 1;
                pairs += view.sun == SunPosition::later ? 1 : 0;
            }
        }
    }
    EXPECT_GT(restored, 5000);
    EXPECT_GT(reused, 5000);
    EXPECT_GT(pairs, 5000);
}

/// Every point of a box, where it was and where it is, is drawn within `dirty`, a texel away from its edge at least;
/// but at the tile's edge.
TEST(Dirty, CoversWhereAMoverWasAndIs)
{
    Random random(21);
    int inside = 0;
    for (int round = 0; round < 3000; ++round) {
        View view;
        view.tile = {0, 0, 0, 64, 48};
        const bool perspective = round % 2 == 1;
        const glm::dvec3 eye = random.inBox(glm::dvec3(-20), glm::dvec3(20));
        view.clip_from_world = (perspective ? test::perspectiveCamera(eye, glm::dvec3(0.0), 1.0)
                                            : test::orthographicCamera(eye, glm::dvec3(0.0), 15.0))
                                   .clip_from_world;
        const glm::dvec3 half = random.inBox(glm::dvec3(0.0), glm::dvec3(3.0));
        const glm::dvec3 centre = round % 8 == 1 ? eye * 0.95 : random.inBox(glm::dvec3(-25), glm::dvec3(25));
        const Aabb box = test::boxAt(centre, half); // each eighth is around the eye, or close before it
        const TexelRect rect = texelsOf(view, box);
        ASSERT_LE(rect.x + rect.width, 64U);
        ASSERT_LE(rect.y + rect.height, 48U);
        for (int sample = 0; sample < 20; ++sample) {
            const glm::dvec3 p = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
            const glm::dvec4 c = view.clip_from_world * glm::dvec4(p, 1.0);
            if (c.w <= 0.0 || std::abs(c.x) >= c.w || std::abs(c.y) >= c.w)
                continue;
            ++inside;
            const glm::dvec2 at = (glm::dvec2(c) / c.w * 0.5 + 0.5) * glm::dvec2(64.0, 48.0);
            ASSERT_FALSE(rect.empty());
            ASSERT_LE(rect.x, std::max(at.x - 1.0, 0.0));
            ASSERT_LE(rect.y, std::max(at.y - 1.0, 0.0));
            ASSERT_GE(rect.x + rect.width, std::min(at.x + 1.0, 64.0));
            ASSERT_GE(rect.y + rect.height, std::min(at.y + 1.0, 48.0));
        }
    }
    EXPECT_GT(inside, 10000);
    EXPECT_EQ(merge({1, 2, 3, 4}, {}).width, 3U);
    const TexelRect both = merge({1, 2, 3, 4}, {10, 1, 2, 2});
    EXPECT_EQ(both.x, 1U);
    EXPECT_EQ(both.y, 1U);
    EXPECT_EQ(both.width, 11U);
    EXPECT_EQ(both.height, 5U);
}

} // namespace
} // namespace gnomon
