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

/// Less is as good as nothing: half a rectangle's width, as LightRect has it.
constexpr double kLeastHalf = 1e-6;

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
    return 1.0 / (input.recipe.options().multi.fade_frames + 1.0);
}

/// The part of the world that a frustum around receivers serves: the pyramid around its rectangle, or of a sun the box.
Slice sliceOf(const ReceiverCone& cone, const Light& light, const CameraView& camera, double blend)
{
    const glm::dvec3 axis = axisOf(light, cone.cone);
    const LightSpace space = lightSpaceOf(light, axis, 0.0, camera.scene_ws);
    const double wider = cone.joined ? 1.0 + blend : 1.0;
    const double least = space.perspective ? kLeastHalf : std::max(camera.pad_m, kLeastHalf);
    glm::dvec2 half = glm::max((cone.rect.high - cone.rect.low) * (0.5 * wider), glm::dvec2(least));
    glm::dvec2 centre = (cone.rect.high + cone.rect.low) * 0.5;
    if (space.perspective) { // a blend may end at the widest frustum
        const glm::dvec2 low = glm::max(centre - half, glm::dvec2(-kWidestTangent));
        const glm::dvec2 high = glm::min(centre + half, glm::dvec2(kWidestTangent));
        centre = (low + high) * 0.5;
        half = (high - low) * 0.5;
    }
    const auto row = [&](const glm::dvec3& v, double d) {
        return glm::dvec4(v, d - glm::dot(v, space.origin_ws));
    };
    const glm::dvec3 along = space.perspective ? space.forward_ws : glm::dvec3(0.0);
    const double one = space.perspective ? 0.0 : 1.0; // parallel rays are held against a constant
    Slice slice;
    slice.axis_ws = axis;
    slice.sector.x = row((space.right_ws - along * centre.x) / half.x, -one * centre.x / half.x);
    slice.sector.y = row((space.up_ws - along * centre.y) / half.y, -one * centre.y / half.y);
    slice.sector.w = row(along, one);
    slice.layered = true;
    slice.rim = cone.joined ? 2.0 * blend / (1.0 + blend) : 0.0; // then it counts half at its receivers' border
    if (space.perspective) {
        const glm::dvec2 most = glm::abs(centre) + half;
        slice.half_angle_rad = std::atan(std::max(most.x, most.y));
        slice.near_share = 1.0 / std::sqrt(1.0 + glm::dot(most, most)); // all that is as far off as that
        slice.depth.over = slice.sector.w;
    }
    slice.depth.axis = glm::dvec4(camera.forward_ws, -glm::dot(camera.forward_ws, camera.eye_ws));
    slice.cut[slice.cut_count++] = depthPlane(camera, camera.near_m - camera.pad_m, true);
    slice.cut[slice.cut_count++] = depthPlane(camera, camera.far_m + camera.pad_m, false);
    for (const glm::dvec4& side : {slice.sector.x, -slice.sector.x, slice.sector.y, -slice.sector.y}) {
        Plane plane = planeOf(slice.sector.w + side);
        plane.d += camera.pad_m;
        slice.cut[slice.cut_count++] = plane;
    }
    return slice;
}

} // namespace

void MultiPartition::gather(const Input& input, Memory& memory, FrustumPlanner& frustums)
{
    const ShadowOptions& options = input.recipe.options();
    const bool steady = input.recipe.steady();
    const double most_times = options.multi.most_times > 0.0 ? std::max(options.multi.most_times, 2.0) : 4.0;
    const double largest = innerTexels(input, largestSide(input));
    gathered_ = cones_.gather({input.light, input.camera, *input.frame.objects, input.receivers,
                               pixelSide_m(input.frame, input.camera), texelsPerPixel(input), most_times, largest,
                               options.cascades.blend, steady},
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
    frustum.slice = sliceOf(cone, input.light, input.camera, input.recipe.options().cascades.blend);
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
    const bool at_once = memory.cones.empty() || input.recipe.options().multi.fade_frames == 0;
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
        cone.opacity = input.recipe.options().multi.fade_frames == 0 ? 0.0 : cone.opacity - shareOfFade(input);
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
