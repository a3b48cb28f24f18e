// SPDX-License-Identifier: Apache-2.0
// The buffers that shaders read, and rows for casters, in a host's memory.
#include "handles.h"

#include <gnomon/pack/caster_rows.h>
#include <gnomon/pack/page_table.h>
#include <gnomon/pack/shading_buffers.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

using namespace gnomon;
using namespace gnomon::c;

namespace {

constexpr std::uint32_t kBuffers = GNOMON_BUFFER_PAGES + 1;

/// The images of a plan's maps, which are as large as its pages. Without pages a size of 1 stands for them.
std::vector<pack::MapImage> imagesOf(const FlatPlan& flat)
{
    std::vector<pack::MapImage> images;
    for (const GnomonPages& pages : flat.pages) {
        images.push_back({{std::max(pages.width, 1U), std::max(pages.height, 1U)}, pages.levels});
    }
    return images;
}

const std::vector<glm::uvec2>& pageTable(GnomonPlanner& own)
{
    if (!own.has_page_table) {
        pack::fillPageTable(*own.plan, own.page_table);
        own.has_page_table = true;
    }
    return own.page_table;
}

std::size_t elementsOf(GnomonPlanner& own, std::uint32_t buffer)
{
    switch (buffer) {
    case GNOMON_BUFFER_CONSTANTS:
        return 1;
    case GNOMON_BUFFER_LIGHTS:
        return std::max<std::size_t>(own.plan->lights.size(), 1);
    case GNOMON_BUFFER_VIEWS:
        return std::max<std::size_t>(own.plan->views.size(), shared::kFewViews);
    case GNOMON_BUFFER_OBJECTS:
        return pack::objectVectorCount(*own.plan);
    default:
        return pageTable(own).size();
    }
}

std::size_t bytesOf(GnomonPlanner& own, std::uint32_t buffer)
{
    constexpr std::array<std::size_t, kBuffers> kElement{sizeof(shared::GpuConstants), sizeof(shared::GpuLight),
                                                         sizeof(shared::GpuView), sizeof(glm::vec4),
                                                         sizeof(glm::uvec2)};
    return elementsOf(own, buffer) * kElement[buffer];
}

/// Fills in elements by `fill`, and copies them to memory that may be aligned anyhow.
template <class T, class Fill>
void fillElements(GnomonPlanner& own, std::uint32_t buffer, void* out, const Fill& fill)
{
    std::vector<T> elements(elementsOf(own, buffer));
    fill(std::span<T>(elements));
    if (!elements.empty()) {
        std::memcpy(out, elements.data(), elements.size() * sizeof(T));
    }
}

shared::GpuConstants constantsOf(const GnomonPlanner& own, std::uint32_t options, const GnomonPrecision* precision)
{
    requireIndex(options, own.flat.pages.size(), "options");
    const pack::DrawPrecision exact =
        precision != nullptr ? taken(readStruct<GnomonPrecision, pack::DrawPrecision>(precision, "GnomonPrecision"))
                             : pack::DrawPrecision{};
    shared::GpuConstants constants{};
    pack::fillConstants(*own.plan, options, own.plan->made_for.size_px, imagesOf(own.flat)[options], exact, constants);
    return constants;
}

void fill(GnomonPlanner& own, std::uint32_t buffer, std::uint32_t options, const GnomonPrecision* precision, void* out)
{
    switch (buffer) {
    case GNOMON_BUFFER_CONSTANTS: {
        const shared::GpuConstants constants = constantsOf(own, options, precision);
        std::memcpy(out, &constants, sizeof(constants));
        break;
    }
    case GNOMON_BUFFER_LIGHTS:
        fillElements<shared::GpuLight>(own, buffer, out, [&](auto lights) { pack::fillLights(*own.plan, lights); });
        break;
    case GNOMON_BUFFER_VIEWS:
        fillElements<shared::GpuView>(own, buffer, out,
                                      [&](auto views) { pack::fillViews(*own.plan, imagesOf(own.flat), views); });
        break;
    case GNOMON_BUFFER_OBJECTS:
        fillElements<glm::vec4>(own, buffer, out, [&](auto vectors) { pack::fillObjects(*own.plan, vectors); });
        break;
    default:
        fillElements<glm::uvec2>(own, buffer, out,
                                 [&](auto entries) { std::ranges::copy(pageTable(own), entries.begin()); });
    }
}

void requireRoom(std::uint64_t has, std::uint64_t needs, const char* unit)
{
    if (has < needs) {
        throw WrongCall{
            "out has room for " + std::to_string(has) + " " + unit + ", and it takes " + std::to_string(needs), ""};
    }
}

void requireFinite(std::span<const float> numbers, const char* name)
{
    if (!std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); })) {
        throw WrongCall{std::string("a number of ") + name + " is not finite", ""};
    }
}

void writeRows(const View& view, std::span<const float> transforms, double bias_m, float* out)
{
    const pack::CasterRows rows(view);
    std::array<glm::vec4, pack::casterRowCount(false)> written;
    for (; !transforms.empty(); transforms = transforms.subspan(12)) {
        const pack::Rows3x4 world_from_object{glm::make_vec4(transforms.data()), glm::make_vec4(transforms.data() + 4),
                                              glm::make_vec4(transforms.data() + 8)};
        const glm::vec4* end = rows.write(world_from_object, written.data(), bias_m);
        const auto floats = static_cast<std::size_t>(end - written.data()) * 4;
        std::memcpy(out, written.data(), floats * sizeof(float));
        out += floats;
    }
}

} // namespace

extern "C" {

GnomonStatus gnomonBufferBytes(GnomonPlanner* planner, uint32_t buffer, size_t* bytes) noexcept
{
    return guarded("asking for a buffer's size", [&] {
        GnomonPlanner& own = planned(planner);
        requireIndex(buffer, kBuffers, "buffer");
        required(bytes, "bytes") = bytesOf(own, buffer);
    });
}

GnomonStatus gnomonFillBuffer(GnomonPlanner* planner, uint32_t buffer, uint32_t options,
                              const GnomonPrecision* precision, void* out, size_t bytes) noexcept
{
    return guarded("filling in a buffer", [&] {
        GnomonPlanner& own = planned(planner);
        requireIndex(buffer, kBuffers, "buffer");
        const std::size_t needs = bytesOf(own, buffer);
        requireRoom(bytes, needs, "bytes");
        if (needs > 0) {
            required(static_cast<unsigned char*>(out), "out");
            fill(own, buffer, options, precision, out);
        }
    });
}

GnomonStatus gnomonWriteCasterRows(const GnomonPlanner* planner, uint32_t view, const float* world_from_object,
                                   uint32_t objects, double bias_m, float* out, size_t floats) noexcept
{
    return guarded("writing rows of casters", [&] {
        const Plan& plan = *planned(planner).plan;
        requireIndex(view, plan.views.size(), "view");
        if (objects == 0) {
            return;
        }
        const std::span transforms(&required(world_from_object, "world_from_object"), std::size_t{objects} * 12);
        const std::uint64_t rows = pack::casterRowCount(plan.views[view].projection.orthographic);
        requireRoom(floats, objects * rows * 4, "floats");
        requireFinite(transforms, "world_from_object");
        if (!std::isfinite(bias_m)) {
            throw WrongCall{"bias_m is not finite", "give 0 for none"};
        }
        writeRows(plan.views[view], transforms, bias_m, &required(out, "out"));
    });
}

} // extern "C"
