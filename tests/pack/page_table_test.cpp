// SPDX-License-Identifier: Apache-2.0
// The table of pages leads a shader to the view that serves a point.
#include <gnomon/pack/page_table.h>
#include <gnomon/planner.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace gnomon::pack {
namespace {

/// As gnomon/lib/light_visibility.glsl has it.
std::uint32_t pageAt(const Plan& plan, std::uint32_t light, const std::vector<glm::uvec2>& words, const glm::dvec3& p)
{
    const LightPlan& planned = plan.lights[light];
    const ViewSector& root = plan.views[planned.first_view + planned.view_count - 1].serves.sector;
    glm::dvec2 at = glm::dvec2(glm::dot(root.x, glm::dvec4(p, 1.0)), glm::dot(root.y, glm::dvec4(p, 1.0))) * 0.5 + 0.5;
    const std::uint32_t nodes = words[light].x;
    std::uint32_t word = 0x10000U;
    while (word > 0xFFFFU) {
        at += at;
        const glm::uvec2 high(at.x >= 1.0 ? 1U : 0U, at.y >= 1.0 ? 1U : 0U);
        at -= glm::dvec2(high);
        word = words[nodes + 2 * (word >> 16U) + high.y][static_cast<int>(high.x)];
    }
    return planned.first_view + word;
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
            Light sun;
            sun.key = i;
            sun.direction_ws = glm::normalize(glm::dvec3(0.4 - 0.5 * i, -0.8, 0.3));
            sun.casts_shadow = i != 1;
            lights.push_back(sun);
        }
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
    EXPECT_EQ(words[1].x, 0U) << "it has no pages";
    for (const std::uint32_t light : {0U, 2U}) {
        const LightPlan& planned = plan.lights[light];
        ASSERT_EQ(planned.view_count, 64U);
        std::set<std::uint32_t> found;
        for (double x = -55.0; x <= 55.0; x += 0.173)
            for (double z = -55.0; z <= 25.0; z += 0.191) {
                const glm::dvec3 p(x, 0.1, z);
                std::uint32_t first = planned.first_view;
                while (first + 1 < planned.first_view + planned.view_count && !plan.views[first].serves.sector.holds(p))
                    ++first;
                const std::uint32_t page = pageAt(plan, light, words, p);
                ASSERT_EQ(page, first) << x << ", " << z;
                found.insert(page);
            }
        EXPECT_GT(found.size(), 30U);
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
