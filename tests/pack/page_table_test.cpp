// SPDX-License-Identifier: Apache-2.0
// The table of pages leads a shader to the view that serves a point.
#include <gnomon/pack/page_table.h>
#include <gnomon/planner.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace gnomon::pack {
namespace {

/// As gnomon/lib/light_visibility.glsl has it.
std::uint32_t pageAt(const Plan& plan, std::uint32_t light, const std::vector<glm::uvec2>& words, const glm::dvec3& p)
{
    const glm::dvec3 from = p - plan.made_for.lights[light].position_ws;
    const glm::dvec3 far = glm::abs(from);
    const int axis = far.x >= std::max(far.y, far.z) ? 0 : far.y >= far.z ? 1 : 2;
    const glm::uvec2 root = words[6 * light + static_cast<unsigned>(2 * axis + (from[axis] < 0.0 ? 1 : 0))];
    const ViewSector& sector = plan.views[root.y].serves.sector;
    const glm::dvec4 h(p, 1.0);
    glm::dvec2 at = glm::dvec2(glm::dot(sector.x, h), glm::dot(sector.y, h)) / glm::dot(sector.w, h) + 1.0;
    std::uint32_t node = root.x;
    std::uint32_t word = 0x10000U;
    while (word > 0xFFFFU) {
        const glm::uvec2 high(at.x >= 1.0 ? 1U : 0U, at.y >= 1.0 ? 1U : 0U);
        at = 2.0 * (at - glm::dvec2(high));
        node += word >> 16U;
        word = words[node + high.y][static_cast<int>(high.x)];
    }
    return plan.lights[light].first_view + word;
}

struct Yard {
    ObjectSet set;
    std::vector<Light> lights;
    Frame frame;

    Yard()
    {
        set.add({{-60, -1, -60}, {60, 0, 60}});
        for (int i = 0; i < 60; ++i) {
            const glm::vec3 low(static_cast<float>(i * 37 % 100) - 50.0F, 0.0F,
                                static_cast<float>(i * 53 % 100) - 50.0F);
            set.add({low, low + glm::vec3(2.0F, 1.0F + static_cast<float>(i % 5), 1.5F)});
        }
        for (std::uint32_t i = 0; i < 3; ++i) {
            Light& sun = lights.emplace_back();
            sun.key = i;
            sun.direction_ws = glm::normalize(glm::dvec3(0.4 - 0.5 * i, -0.8, 0.3));
            sun.casts_shadow = i != 1;
        }
        Light& spot = lights.emplace_back();
        spot.key = 3;
        spot.type = LightType::spot;
        spot.position_ws = {3, 11, 5};
        spot.direction_ws = glm::normalize(glm::dvec3(-0.3, -0.8, -0.4));
        spot.outer_half_angle_rad = 0.9;
        Light& lamp = lights.emplace_back();
        lamp.key = 4;
        lamp.type = LightType::point;
        lamp.position_ws = {-2, 2.3, 6};
        frame.lights = lights;
        frame.objects = &set;
        glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.9, 16.0 / 9.0, 1000.0, 0.1);
        clip_from_view[1][1] *= -1.0;
        const glm::dvec3 eye(0, 6, 30);
        frame.camera = {eye, clip_from_view * glm::lookAtRH(eye, glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)), true};
    }
};

TEST(PageTable, LeadsToTheFinestPageThatServesAPoint)
{
    const Yard yard;
    Planner planner(
        ShadowOptions{.technique = {Partition::virtual_pages, Fit::uniform, Filter::pcf}, .max_texels = 1U << 20U});
    const Plan& plan = planner.plan(yard.frame);
    std::vector<glm::uvec2> words;
    fillPageTable(plan, words);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_EQ(words[6 + i], glm::uvec2(0)) << "it has no pages";
    for (const std::uint32_t light : {0U, 2U, 3U, 4U}) {
        SCOPED_TRACE("light " + std::to_string(light));
        const LightPlan& planned = plan.lights[light];
        ASSERT_EQ(planned.view_count, 64U) << planned.outcome.reason;
        std::set<std::uint32_t> found;
        std::size_t served = 0;
        for (double x = -55.0; x <= 55.0; x += 0.173)
            for (double z = -55.0; z <= 25.0; z += 0.191) {
                const glm::dvec3 p(x, 0.1, z);
                const std::uint32_t end = planned.first_view + planned.view_count;
                std::uint32_t first = planned.first_view;
                while (first < end && !plan.views[first].serves.sector.holds(p))
                    ++first;
                const std::uint32_t page = pageAt(plan, light, words, p);
                if (first == end) { // no root shows it
                    EXPECT_FALSE(plan.views[page].serves.sector.holds(p));
                    continue;
                }
                ASSERT_EQ(page, first) << x << ", " << z;
                found.insert(page);
                ++served;
            }
        EXPECT_GT(found.size(), 20U);
        EXPECT_GT(served, 20000U);
    }
}

TEST(PageTable, IsEmptyWithoutPages)
{
    const Yard yard;
    Planner planner(ShadowOptions{.technique = kPlainTechnique});
    std::vector<glm::uvec2> words(3);
    fillPageTable(planner.plan(yard.frame), words);
    EXPECT_TRUE(words.empty());
}

} // namespace
} // namespace gnomon::pack
