// SPDX-License-Identifier: Apache-2.0
#include "same_plan.h"

#include <gnomon/pack/caster_rows.h>
#include <gnomon/pack/page_table.h>
#include <gnomon/pack/shading_buffers.h>

#include <glm/gtc/type_ptr.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace gnomon::test {
namespace {

/// The bytes of a buffer through C.
template <class T>
std::vector<T> filled(GnomonPlanner* planner, std::uint32_t buffer, std::uint32_t options = 0,
                      const GnomonPrecision* precision = nullptr)
{
    std::size_t bytes = 0;
    EXPECT_EQ(gnomonBufferBytes(planner, buffer, &bytes), GNOMON_OK);
    EXPECT_EQ(bytes % sizeof(T), 0U);
    std::vector<T> out(bytes / sizeof(T));
    EXPECT_EQ(gnomonFillBuffer(planner, buffer, options, precision, out.data(), bytes), GNOMON_OK)
        << gnomonLastError()->message;
    return out;
}

template <class T>
void expectSameBytes(const std::vector<T>& shown, const std::vector<T>& wanted, const char* buffer)
{
    ASSERT_EQ(shown.size(), wanted.size()) << buffer;
    EXPECT_TRUE(wanted.empty() || std::memcmp(shown.data(), wanted.data(), wanted.size() * sizeof(T)) == 0) << buffer;
}

} // namespace

void expectSameBuffers(GnomonPlanner* planner, const Plan& plan)
{
    std::vector<pack::MapImage> images;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        const glm::uvec2 size(std::max(plan.pages[i].width, 1U), std::max(plan.pages[i].height, 1U));
        images.push_back({size, plan.pages[i].width == 0 ? 1 : pack::mipLevels((*plan.options)[i], size.x, size.y)});
    }
    GnomonPrecision c_precision;
    gnomonInitPrecision(&c_precision, sizeof(c_precision));
    c_precision.sub_pixel_bits = 8;
    c_precision.normal_error_rad = 0.01F;
    const pack::DrawPrecision precision{.sub_pixel_bits = 8, .normal_error_rad = 0.01F};
    for (std::uint32_t i = 0; i < plan.pages.size(); ++i) {
        std::vector<shared::GpuConstants> constants(1);
        pack::fillConstants(plan, i, plan.made_for.size_px, images[i], precision, constants[0]);
        expectSameBytes(filled<shared::GpuConstants>(planner, GNOMON_BUFFER_CONSTANTS, i, &c_precision), constants,
                        "constants");
    }
    std::vector<shared::GpuLight> lights(plan.lights.size());
    pack::fillLights(plan, lights);
    expectSameBytes(filled<shared::GpuLight>(planner, GNOMON_BUFFER_LIGHTS), lights, "lights");
    std::vector<shared::GpuView> views(std::max<std::size_t>(plan.views.size(), shared::kFewViews));
    pack::fillViews(plan, images, views);
    expectSameBytes(filled<shared::GpuView>(planner, GNOMON_BUFFER_VIEWS), views, "views");
    std::vector<glm::vec4> objects(pack::objectVectorCount(plan));
    pack::fillObjects(plan, objects);
    expectSameBytes(filled<glm::vec4>(planner, GNOMON_BUFFER_OBJECTS), objects, "objects");
    std::vector<glm::uvec2> pages;
    pack::fillPageTable(plan, pages);
    expectSameBytes(filled<glm::uvec2>(planner, GNOMON_BUFFER_PAGES), pages, "pages");
}

void expectSameRows(const GnomonPlanner* planner, const Plan& plan)
{
    std::array<float, 24> transforms{};
    for (std::size_t i = 0; i < transforms.size(); ++i) { // any numbers
        transforms[i] = 2.0F * std::sin(static_cast<float>(7 * i + plan.number));
    }
    for (std::uint32_t i = 0; i < plan.views.size(); ++i) {
        const std::uint32_t rows = pack::casterRowCount(plan.views[i].projection.orthographic);
        std::vector<float> shown(std::size_t{rows} * 8);
        ASSERT_EQ(gnomonWriteCasterRows(planner, i, transforms.data(), 2, 0.01, shown.data(), shown.size()), GNOMON_OK);
        std::vector<glm::vec4> wanted(std::size_t{rows} * 2);
        const pack::CasterRows writer(plan.views[i]);
        glm::vec4* out = wanted.data();
        for (const float* from : {transforms.data(), transforms.data() + 12}) {
            out = writer.write({glm::make_vec4(from), glm::make_vec4(from + 4), glm::make_vec4(from + 8)}, out, 0.01);
        }
        EXPECT_EQ(std::memcmp(shown.data(), wanted.data(), shown.size() * sizeof(float)), 0) << "rows of view " << i;
    }
}

} // namespace gnomon::test
