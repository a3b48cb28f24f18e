// SPDX-License-Identifier: Apache-2.0
// MultiPartition's part once a light's receivers are gathered (multi_receivers.h): it gives the cones maps, and keeps
// them from frame to frame.
#include "partition/multi.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gnomon {
namespace {

/// The part of a map's side that is left for what its frustum has to show.
double innerTexels(const MultiPartition::Input& input, std::uint32_t side)
{
    const double still = input.recipe.steady() ? 1.0 : 0.0; // that much a map that pans may be off its place
    return side - 2.0 * input.recipe.resolved.borderOf(side) - still;
}

/// The step whose texels are 0.7 to 0.84 times as large.
int finerStep(double texel)
{
    return static_cast<int>(std::floor(4.0 * std::log2(texel))) - 1;
}

/// 1 m before a perspective camera, or anywhere before another.
double pixelSide_m(const Frame& frame, const CameraView& camera)
{
    const glm::dmat4 rows = glm::transpose(camera.clip_from_world);
    const double unit = camera.perspective ? glm::length(glm::dvec3(rows[3])) : std::abs(rows[3].w);
    double side_m = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        const glm::dvec3 row(rows[axis]);
        const double across = glm::length(row - camera.forward_ws * glm::dot(camera.forward_ws, row));
        side_m = std::max(side_m, 2.0 * unit / (across * frame.size_px[axis]));
    }
    return side_m;
}

double shareOfFade(const MultiPartition::Input& input)
{
    return 1.0 / (input.recipe.options.multi.fade_frames + 1.0);
}

} // namespace

void MultiPartition::gather(const Input& input, Memory& memory, FrustumPlanner& frustums)
{
    const ShadowOptions& options = input.recipe.options;
    const bool steady = input.recipe.steady();
    const double most_times = options.multi.most_times > 0.0 ? std::max(options.multi.most_times, 2.0) : 4.0;
    const double largest = innerTexels(input, largestSide(input));
    gathered_ = cones_.gather({input.light, input.camera, *input.frame.objects, input.receivers,
                               pixelSide_m(input.frame, input.camera), options.multi.texels_per_pixel, most_times,
                               largest, options.cascades.blend, steady},
                              memory.cones, memory.homes);
    const std::size_t first = frustums_.size();
    for (ReceiverCone& cone : gathered_) {
        if (steady && !cone.held) {
            cone.id = memory.next_cone++;
            cone.promised = finerStep(cone.texel);
            cone.texel = texelOfStep(cone.promised);
        }
        if (cone.pieces > 0) {
            addCone(input, cone);
        }
    }
    (void)predict(input, memory, first, frustums);
    for (GrownFrustum& frustum : std::span(frustums_).subspan(first)) {
        const std::uint32_t all = largestSide(input);
        const double around = all - innerTexels(input, all);
        frustum.wanted = kTooSmallSide * (frustum.size / coneOf(frustum.id).texel + around);
    }
}

ReceiverCone& MultiPartition::coneOf(std::uint32_t id)
{
    return *std::ranges::find(gathered_, id, &ReceiverCone::id);
}

void MultiPartition::addCone(const Input& input, const ReceiverCone& cone)
{
    GrownFrustum frustum;
    frustum.id = cone.id;
    frustum.slice = sliceOf(cone, input.light, input.camera, input.recipe.options.cascades.blend);
    listReceivers(input, frustum);
    if (frustum.receiver_count > 0) {
        frustums_.push_back(frustum);
    }
}

/// Puts a light's frustums in their order, after sizeFrustums().
void MultiPartition::orderCones(const Input& input, Memory& memory, std::size_t first)
{
    const std::size_t count = frustums_.size() - first;
    for (GrownFrustum& frustum : std::span(frustums_).subspan(first)) {
        frustum.texel = frustum.size / innerTexels(input, frustum.side);
    }
    if (input.recipe.steady()) {
        holdCones(input, memory, std::span(frustums_).subspan(first, count));
        cones_.listHomes(memory.homes);
        addFadingCones(input, memory);
    }
    std::ranges::sort(std::span(frustums_).subspan(first), {},
                      [](const GrownFrustum& one) { return std::pair(one.texel, one.id); });
}

/// Texels stay as they are while the map has room for what it shows, and are not made finer before they are much too
/// coarse. A frustum whose texels have to change is another one.
void MultiPartition::holdCones(const Input& input, Memory& memory, std::span<GrownFrustum> found)
{
    const bool at_once = memory.cones.empty() || input.recipe.options.multi.fade_frames == 0;
    std::vector<ReceiverCone>& now = memory.cones;
    now.clear();
    for (ReceiverCone& cone : gathered_) {
        const auto frustum = std::ranges::find(found, cone.id, &GrownFrustum::id);
        const bool lives = frustum != found.end();
        if (lives) {
            const double inner = innerTexels(input, frustum->side);
            const std::optional<int> held = cone.held ? std::optional(cone.step) : std::nullopt;
            const int step = std::max(cone.promised, stepFrom(held, frustum->size, inner, false));
            if (cone.held && cone.step != step) {
                ReceiverCone old = cone;
                old.pieces = 0;
                cone.id = frustum->id = memory.next_cone++;
                cone.held = false;
                now.push_back(old);
            }
            if (!cone.held) {
                cone.step = step;
                cone.opacity = at_once ? 1.0 : 0.0;
            }
            cone.opacity = std::min(1.0, cone.opacity + shareOfFade(input));
            cone.side = frustum->side;
            cone.sum = frustum->sum;
            frustum->texel = frustum->slice.texel = texelOfStep(cone.step);
            frustum->slice.faded_in = cone.opacity;
        }
        cone.pieces = lives ? cone.pieces : 0;
        cone.held = true;
        now.push_back(cone);
    }
}

/// A cone that no receiver is in any longer fades out, and is forgotten.
void MultiPartition::addFadingCones(const Input& input, Memory& memory)
{
    for (ReceiverCone& cone : memory.cones) {
        if (cone.pieces > 0) {
            continue;
        }
        cone.opacity = input.recipe.options.multi.fade_frames == 0 ? 0.0 : cone.opacity - shareOfFade(input);
        const std::size_t count = frustums_.size();
        if (cone.opacity > 0.0 && cone.side > 0) {
            addCone(input, cone);
        }
        if (frustums_.size() > count) {
            GrownFrustum& frustum = frustums_.back();
            frustum.side = cone.side;
            frustum.sum = cone.sum;
            frustum.texel = frustum.slice.texel = texelOfStep(cone.step);
            frustum.slice.faded_in = cone.opacity;
            frustum.fades_out = true;
        }
    }
    std::erase_if(memory.cones, [](const ReceiverCone& cone) { return cone.pieces == 0 && !(cone.opacity > 0.0); });
}

} // namespace gnomon
