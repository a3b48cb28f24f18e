// SPDX-License-Identifier: Apache-2.0
// Multi-frustum partitioning. What of a light's receivers is seen at like distances from the eye needs like texels, so
// it is cut into shells of the camera's depth, each at most twice as far as it is near; and what of a shell the light
// sees all around it, into the faces of a cube. Near ones first, shells grow together where that costs few texels. Each
// frustum has a map of the size that its part of the picture asks for.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006.
// Departures: receivers are cut where what they need halves, and not each given to one frustum, so that a floor needs
// no pieces made by hand and nothing pops when an object goes from one to another; frustums fade into each other
// instead. Texels are counted in those some hundred points that the camera probably sees (Sight).
#include "partition/multi.h"

#include "light_reach.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace gnomon {
namespace {

/// Shells are taken where they want so many times the texels of none, and kept up to the second.
constexpr double kTakeShells = 0.75;
constexpr double kKeepShells = 0.9;
/// TexelClaim::staying of a map that holds still. With another side its texels are other ones, too.
constexpr double kHoldsSide = 2.0;
/// Other shells have to be the better ones for so many frames on end before what holds still is changed for them: what
/// is known of the picture is some hundred guesses, and they jump.
constexpr std::uint32_t kPatience_frames = 8;
/// One frustum serves all of a shell if the light sees it within this half angle.
constexpr double kWidestHalfAngle_rad = 0.87;
/// Of a map of which nobody can tell how fine it should be.
constexpr double kUnknownSide = 64.0;

/// What a part's depths of the camera are. Where it begins it fades in over a share of the octave before.
Slice depthsOf(const CameraView& camera, const FrustumPart& part, double blend)
{
    Slice depths;
    depths.depth.axis = glm::dvec4(camera.forward_ws, -glm::dot(camera.forward_ws, camera.eye_ws));
    const bool begins = part.octave != kFromEye;
    const bool ends = part.end != kToEnd;
    if (begins) {
        depths.depth.blend_m = blend * depthOfOctave(part.octave - 1);
        depths.depth.begin_m = depthOfOctave(part.octave) - depths.depth.blend_m;
    }
    if (ends) {
        depths.depth.end_m = depthOfOctave(part.end);
    }
    depths.cut[depths.cut_count++] =
        depthPlane(camera, begins ? depths.depth.begin_m : camera.near_m - camera.pad_m, true);
    depths.cut[depths.cut_count++] = depthPlane(camera, ends ? depths.depth.end_m : camera.far_m + camera.pad_m, false);
    return depths;
}

Slice inSector(const Slice& depths, const Slice& way)
{
    Slice slice = depths;
    slice.axis_ws = way.axis_ws;
    slice.half_angle_rad = way.half_angle_rad;
    slice.near_share = way.near_share;
    slice.sector = way.sector;
    return slice;
}

/// Of its light: the same from frame to frame, wherever a frustum that is refitted in each frame ends.
std::uint32_t idOf(const FrustumPart& part)
{
    return static_cast<std::uint32_t>(part.octave - kFromEye) << 3U | part.sector;
}

/// And of one that holds still, of its end and its texels too.
std::uint32_t idOf(const HeldFrustum& held)
{
    const auto end = static_cast<std::uint32_t>(held.part.end - kFromEye);
    const auto step = static_cast<std::uint32_t>(held.step + 512) & 1023U;
    return idOf(held.part) | end << 10U | step << 17U | 1U << 27U;
}

std::uint32_t largestSide(const MultiPartition::Input& input)
{
    const std::uint32_t largest = input.recipe.resolved.largest_side();
    return input.light.map_size != 0 ? std::clamp(input.light.map_size, kSmallestMap, largest) : largest;
}

} // namespace

void MultiPartition::follow(std::span<const Light> lights)
{
    keys_.clear();
    for (const Light& light : lights) {
        keys_.push_back(light.key);
    }
    rows_.follow(keys_);
    memories_.resize(std::max<std::size_t>(memories_.size(), rows_.end()));
    for (const std::uint32_t row : rows_.gone()) {
        memories_[row] = {};
    }
    ranges_.assign(lights.size(), {});
    frustums_.clear();
    receivers_.clear();
}

std::span<const GrownFrustum> MultiPartition::frustumsOf(std::size_t light) const
{
    return std::span(frustums_).subspan(ranges_[light].first, ranges_[light].count);
}

void MultiPartition::divide(const Input& input, std::size_t light, FrustumPlanner& frustums)
{
    Memory& memory = memories_[rows_.rowOf(light)];
    Range& range = ranges_[light];
    range.first = frustums_.size();
    if (input.frame.cut) {
        memory.held.cut();
    }
    findFrustums(input, memory, range.first, frustums);
    sizeFrustums(input, memory, std::span(frustums_).subspan(range.first));
    if (input.recipe.steady()) {
        hold(input, memory.held, range.first);
    }
    range.count = frustums_.size() - range.first;
}

/// Points tell which shells may pay. Whether they do is told by what the frustums have to hold: of a receiver no more
/// is known than its box, and what is in sight of each shell may be the whole of it.
void MultiPartition::findFrustums(const Input& input, Memory& memory, std::size_t first, FrustumPlanner& frustums)
{
    const glm::dvec2 cell_px(static_cast<double>(input.frame.size_px.x) / Sight::kColumns,
                             static_cast<double>(input.frame.size_px.y) / Sight::kRows);
    const DepthShells::Input seen{input.light, input.camera, input.sight.points(), cell_px};
    if (memory.held.fading()) { // one change after the other
        shells_.findAgain(seen, memory.divides ? std::span<const int>(memory.ends) : std::span<const int>());
        (void)addShells(input, memory, frustums);
        return;
    }
    const bool known = !memory.frustums.empty();
    const bool waits = known && input.recipe.steady() && memory.patience > 0;
    const bool suffice = shells_.find(seen, memory.ends,
                                      !known  ? KeepShells::none
                                      : waits ? KeepShells::all
                                              : KeepShells::good_enough);
    const double of_shells = addShells(input, memory, frustums);
    bool pays = false;
    if (shells_.shells().size() > 1) {
        const auto one = static_cast<std::ptrdiff_t>(frustums_.size());
        shells_.join();
        pays = of_shells < (memory.divides ? kKeepShells : kTakeShells) * addShells(input, memory, frustums);
        const bool divides = waits ? memory.divides : pays;
        const auto begin = frustums_.begin();
        frustums_.erase(begin + (divides ? one : static_cast<std::ptrdiff_t>(first)),
                        divides ? frustums_.end() : begin + one);
    }
    const bool stays = suffice && pays == memory.divides;
    memory.patience = waits && !stays ? memory.patience - 1 : kPatience_frames;
    memory.divides = waits ? memory.divides : pays;
}

/// Appends the frustums of all shells. Returns how many texels they want together.
double MultiPartition::addShells(const Input& input, const Memory& memory, FrustumPlanner& frustums)
{
    const std::size_t first = frustums_.size();
    for (std::size_t i = 0; i < shells_.shells().size(); ++i) {
        addShell(input, i);
    }
    const std::uint32_t largest = largestSide(input);
    const double border = 2.0 * input.recipe.resolved.borderOf(largest);
    double texels = 0.0;
    for (GrownFrustum& frustum : std::span(frustums_).subspan(first)) {
        const auto known = std::ranges::find(memory.frustums, frustum.id, &Known::id);
        if (known != memory.frustums.end()) {
            frustum.strength = known->strength;
            frustum.side_before = known->side;
        }
        const Prediction seen = frustums.predict({input.frame, input.recipe, input.camera, receiversOf(frustum),
                                                  receiversOf(frustum), input.light, frustum.slice, largest},
                                                 input.sight, frustum.strength);
        const double inner = seen.facing.coarsest_px * input.recipe.options.multi.texels_per_pixel * (largest - border);
        frustum.wanted = !seen.lies ? 0.0 : inner > 0.0 ? inner + border : kUnknownSide;
        frustum.sum = seen.facing.sum_px;
        frustum.size = seen.size;
        texels += frustum.wanted * frustum.wanted;
    }
    const auto empty = std::remove_if(frustums_.begin() + static_cast<std::ptrdiff_t>(first), frustums_.end(),
                                      [](const GrownFrustum& one) { return one.wanted <= 0.0; });
    frustums_.erase(empty, frustums_.end());
    return texels;
}

/// The first shell serves what is nearer than all points, the last what is farther.
void MultiPartition::addShell(const Input& input, std::size_t shell)
{
    const std::span<const DepthShell> shells = shells_.shells();
    FrustumPart part{kFromEye, kToEnd, 0};
    if (shell > 0) {
        part.octave = shells[shell - 1].end;
    }
    if (shell + 1 < shells.size()) {
        part.end = shells[shell].end;
    }
    addSectors(input, depthsOf(input.camera, part, input.recipe.options.cascades.blend), part);
}

void MultiPartition::addSectors(const Input& input, const Slice& depths, FrustumPart part)
{
    const auto add = [&](const Slice& way, std::size_t sector) {
        part.sector = static_cast<std::uint32_t>(sector);
        addFrustum(input, inSector(depths, way), part);
    };
    if (input.light.type != LightType::point) {
        add(wholeSlice(input.light), 0);
        return;
    }
    // One whose axis follows what is seen holds nothing still.
    const std::optional<Slice> aimed = input.recipe.steady() ? std::nullopt : aimAt(input, depths);
    if (aimed) {
        add(*aimed, kCubeFaces);
        return;
    }
    for (std::size_t sector = 0; sector < kCubeFaces; ++sector) {
        add(cubeFace(input.light, static_cast<int>(sector)), sector);
    }
}

/// One frustum for all that is seen of a shell, if the light sees it within a narrow enough cone.
std::optional<Slice> MultiPartition::aimAt(const Input& input, const Slice& shell)
{
    body_.reset(grown(reachBox(input.light, input.camera.scene_ws), input.camera.pad_m));
    body_.clip(input.camera.planes);
    body_.clip(std::span(shell.cut).first(shell.cut_count));
    if (body_.empty()) {
        return std::nullopt;
    }
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& p : body_.points()) {
        const glm::dvec3 d = p - input.light.position_ws;
        const double length = glm::length(d);
        if (!(length > input.light.near_m)) {
            return std::nullopt;
        }
        sum += d / length;
    }
    if (!(glm::length(sum) > 1e-3 * static_cast<double>(body_.points().size()))) {
        return std::nullopt;
    }
    Slice aimed;
    aimed.axis_ws = glm::normalize(sum);
    double cosine = 1.0;
    for (const glm::dvec3& p : body_.points()) {
        cosine = std::min(cosine, glm::dot(aimed.axis_ws, glm::normalize(p - input.light.position_ws)));
    }
    constexpr double kRoom_rad = 0.02;
    aimed.half_angle_rad = std::acos(std::clamp(cosine, -1.0, 1.0)) + kRoom_rad;
    // All that is as far off as the light's near distance, to whichever side of the axis.
    aimed.near_share = std::cos(std::min(aimed.half_angle_rad, kWidestHalfAngle_rad));
    return aimed.half_angle_rad <= kWidestHalfAngle_rad ? std::optional(aimed) : std::nullopt;
}

void MultiPartition::addFrustum(const Input& input, const Slice& slice, const FrustumPart& part)
{
    GrownFrustum frustum;
    frustum.id = idOf(part);
    frustum.part = part;
    frustum.slice = slice;
    frustum.first_receiver = static_cast<std::uint32_t>(receivers_.size());
    const Aabb reach = grown(reachBox(input.light, input.camera.scene_ws), input.camera.pad_m);
    const std::span<const Aabb> bounds = input.frame.objects->allBounds();
    const std::span cut = std::span(slice.cut).first(slice.cut_count);
    for (const std::uint32_t object : input.receivers) {
        const Aabb& box = bounds[object];
        const bool reached =
            glm::all(glm::lessThanEqual(box.min, reach.max)) && glm::all(glm::greaterThanEqual(box.max, reach.min));
        if (reached && classify(cut, grown(box, input.camera.pad_m)) != Containment::outside) {
            receivers_.push_back(object);
        }
    }
    frustum.receiver_count = static_cast<std::uint32_t>(receivers_.size()) - frustum.first_receiver;
    if (frustum.receiver_count > 0) {
        frustums_.push_back(frustum);
    }
}

/// Halves of halves of the largest side, which fill squares of the pages.
void MultiPartition::sizeFrustums(const Input& input, Memory& memory, std::span<GrownFrustum> found)
{
    const ShadowOptions& options = input.recipe.options;
    claims_.clear();
    for (const GrownFrustum& frustum : found) {
        TexelClaim& claim = claims_.emplace_back();
        claim.weight = frustum.sum;
        claim.wanted = frustum.wanted;
        claim.largest = largestSide(input);
        claim.before = frustum.side_before;
        if (input.recipe.steady()) {
            claim.staying = memory.held.fading() ? std::numeric_limits<double>::infinity() : kHoldsSide;
        }
    }
    shares_.share(claims_,
                  options.map_size ? std::numeric_limits<double>::infinity() : static_cast<double>(options.max_texels));
    for (std::size_t i = 0; i < found.size(); ++i) {
        found[i].side = claims_[i].side;
    }
    memory.frustums.clear();
    for (const GrownFrustum& frustum : found) {
        memory.frustums.push_back({frustum.id, frustum.side, frustum.strength});
    }
}

/// Gives each frustum texels that hold still, and adds those that fade out.
void MultiPartition::hold(const Input& input, HeldFrustums& held, std::size_t first)
{
    found_.clear();
    for (GrownFrustum& frustum : std::span(frustums_).subspan(first)) {
        // A texel less: that much the map may be off its place.
        const double texels = frustum.side - 2.0 * input.recipe.resolved.borderOf(frustum.side) - 1.0;
        const int step = held.stepOf(frustum.part, frustum.size, texels);
        found_.push_back({frustum.part, step, frustum.side, frustum.sum, false});
    }
    held.take(found_, input.recipe.options.multi.fade_frames);
    const double faded_in = held.fadedIn(input.recipe.options.multi.fade_frames);
    for (std::size_t i = 0; i < found_.size(); ++i) {
        GrownFrustum& frustum = frustums_[first + i];
        frustum.id = idOf(held.now[i]);
        frustum.slice.texel = texelOfStep(held.now[i].step);
        frustum.slice.faded_in = held.now[i].came ? faded_in : 1.0;
    }
    addFading(input, held);
    const auto order = [&](const GrownFrustum& one) {
        return std::tuple(held.blockOf(one.part), !one.fades_out, one.part.octave, one.part.sector);
    };
    std::ranges::sort(std::span(frustums_).subspan(first), {}, order);
    held.step();
}

void MultiPartition::addFading(const Input& input, const HeldFrustums& held)
{
    for (const HeldFrustum& one : held.before) {
        const bool around = input.light.type == LightType::point;
        const Slice way = around ? cubeFace(input.light, static_cast<int>(one.part.sector)) : wholeSlice(input.light);
        const std::size_t count = frustums_.size();
        addFrustum(input, inSector(depthsOf(input.camera, one.part, input.recipe.options.cascades.blend), way),
                   one.part);
        if (frustums_.size() > count) {
            GrownFrustum& frustum = frustums_.back();
            frustum.id = idOf(one);
            frustum.side = one.side;
            frustum.sum = one.sum;
            frustum.slice.texel = texelOfStep(one.step);
            frustum.fades_out = true;
        }
    }
}

} // namespace gnomon
