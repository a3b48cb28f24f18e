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

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr std::size_t kMostShells = 6;
/// Two shells are one where that needs no more than so many times their texels: each is some passes.
constexpr double kMergeCost = 1.3;
/// Shells are taken where they want so many times the texels of none, and kept up to the second.
constexpr double kTakeShells = 0.75;
constexpr double kKeepShells = 0.9;
/// One frustum serves all of a shell if the light sees it within this half angle.
constexpr double kWidestHalfAngle_rad = 0.87;
/// Of a map that serves receivers of which no point is known.
constexpr double kUnknownSide = 64.0;

int octaveOf(double depth_m)
{
    constexpr double kNearest_m = 1e-3;
    constexpr double kFarthest_m = 1e6;
    return static_cast<int>(std::floor(std::log2(std::clamp(depth_m, kNearest_m, kFarthest_m))));
}

double depthOf(int octave)
{
    return std::ldexp(1.0, octave);
}

/// Which face of a cube around a light a direction leads through: as cubeFace() counts them.
std::size_t faceOf(const glm::dvec3& d)
{
    const glm::dvec3 a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return static_cast<std::size_t>(2 * axis) + (d[axis] < 0.0 ? 1 : 0);
}

Slice sectorOf(const Light& light, std::size_t sector)
{
    return light.type == LightType::point ? cubeFace(light, static_cast<int>(sector)) : wholeSlice(light);
}

/// How far a light reaches, and no farther than the scene.
Aabb reachOf(const Light& light, const Aabb& scene_ws)
{
    if (light.type == LightType::directional || light.range_m <= 0.0) {
        return scene_ws;
    }
    const glm::vec3 range(static_cast<float>(light.range_m));
    const glm::vec3 place(light.position_ws);
    return {glm::max(scene_ws.min, place - range), glm::min(scene_ws.max, place + range)};
}

std::uint32_t largestSide(const MultiPartition::Input& input)
{
    const std::uint32_t largest = input.recipe.resolved.largest_side();
    return input.light.map_size != 0 ? std::clamp(input.light.map_size, kSmallestMap, largest) : largest;
}

} // namespace

void MultiPartition::Cell::add(const Cell& other)
{
    if (!other.used) {
        return;
    }
    rect.low = used ? glm::min(rect.low, other.rect.low) : other.rect.low;
    rect.high = used ? glm::max(rect.high, other.rect.high) : other.rect.high;
    density = std::max(density, other.density);
    used = true;
}

double MultiPartition::Cell::texels() const
{
    const glm::dvec2 size = rect.high - rect.low;
    return used ? size.x * size.y * density * density : 0.0;
}

void MultiPartition::Shell::add(const Shell& other)
{
    octave = std::min(octave, other.octave);
    end = std::max(end, other.end);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i].add(other.cells[i]);
    }
}

double MultiPartition::Shell::texels() const
{
    double sum = 0.0;
    for (const Cell& cell : cells) {
        sum += cell.texels();
    }
    return sum;
}

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
    findShells(input);
    mergeShells();
    // Points tell which shells may pay. Whether they do is told by what the frustums have to hold: of a receiver no
    // more is known than its box, and what is in sight of each shell may be the whole of it.
    const bool divides = shells_.size() > 1;
    const double of_shells = addShells(input, memory, frustums);
    const std::size_t count = frustums_.size() - range.first;
    if (divides) {
        while (shells_.size() > 1) {
            shells_[0].add(shells_[1]);
            shells_.erase(shells_.begin() + 1);
        }
        const double of_one = addShells(input, memory, frustums);
        memory.divides = of_shells < (memory.divides ? kKeepShells : kTakeShells) * of_one;
        const auto first = frustums_.begin() + static_cast<std::ptrdiff_t>(range.first);
        const auto one = first + static_cast<std::ptrdiff_t>(count);
        frustums_.erase(memory.divides ? one : first, memory.divides ? frustums_.end() : one);
    }
    range.count = frustums_.size() - range.first;
    sizeFrustums(input, memory, std::span(frustums_).subspan(range.first));
}

/// Appends the frustums of all shells. Returns how many texels they want together.
double MultiPartition::addShells(const Input& input, const Memory& memory, FrustumPlanner& frustums)
{
    const std::size_t first = frustums_.size();
    for (std::size_t i = 0; i < shells_.size(); ++i) {
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
        frustum.wanted = !seen.lies ? 0.0 : seen.error.count == 0 ? kUnknownSide : inner + border;
        frustum.sum = seen.facing.sum_px;
        texels += frustum.wanted * frustum.wanted;
    }
    const auto empty = std::remove_if(frustums_.begin() + static_cast<std::ptrdiff_t>(first), frustums_.end(),
                                      [](const GrownFrustum& one) { return one.wanted <= 0.0; });
    frustums_.erase(empty, frustums_.end());
    return texels;
}

/// A shell for each octave of depth that a lit point is in; one for everything where there is none.
void MultiPartition::findShells(const Input& input)
{
    shells_.clear();
    const Light& light = input.light;
    const std::size_t sectors = light.type == LightType::point ? kSectors : 1;
    std::array<LightSpace, kSectors> spaces;
    for (std::size_t i = 0; i < sectors; ++i) {
        const Slice slice = sectorOf(light, i);
        spaces[i] = lightSpaceOf(light, slice.axis_ws, slice.half_angle_rad, input.camera.scene_ws);
    }
    const glm::dvec2 cell_px(static_cast<double>(input.frame.size_px.x) / Sight::kColumns,
                             static_cast<double>(input.frame.size_px.y) / Sight::kRows);
    for (const SightPoint& point : input.sight.points()) {
        const std::size_t sector = sectors > 1 ? faceOf(point.p_ws - light.position_ws) : 0;
        const std::optional<LitPoint> lit = litPoint(spaces[sector], point);
        if (!lit || !(lit->facing > 0.0)) {
            continue;
        }
        const int octave = input.camera.perspective ? octaveOf(point.depth_m) : 0;
        auto shell = std::ranges::lower_bound(shells_, octave, {}, &Shell::octave);
        if (shell == shells_.end() || shell->octave != octave) {
            shell = shells_.insert(shell, {octave, octave + 1, {}});
        }
        const glm::dvec2 half = 0.5 * lit->facing * cell_px;
        shell->cells[sector].add({{lit->q - half, lit->q + half}, 1.0 / lit->facing, true});
    }
    if (shells_.empty()) {
        shells_.emplace_back();
    }
}

void MultiPartition::mergeShells()
{
    while (shells_.size() > 1) {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + 1 < shells_.size(); ++i) {
            Shell both = shells_[i];
            both.add(shells_[i + 1]);
            const double cost = both.texels() / (shells_[i].texels() + shells_[i + 1].texels());
            if (cost < least) {
                least = cost;
                best = i;
            }
        }
        if (least > kMergeCost && shells_.size() <= kMostShells) {
            return;
        }
        shells_[best].add(shells_[best + 1]);
        shells_.erase(shells_.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    }
}

/// The first shell serves what is nearer than all points, the last what is farther.
void MultiPartition::addShell(const Input& input, std::size_t shell)
{
    const CameraView& camera = input.camera;
    const double blend = input.recipe.options.cascades.blend;
    Slice depths;
    depths.depth.axis = glm::dvec4(camera.forward_ws, -glm::dot(camera.forward_ws, camera.eye_ws));
    if (shell > 0) {
        const double begin_m = depthOf(shells_[shell - 1].end);
        depths.depth.blend_m = blend * (begin_m - depthOf(shells_[shell - 1].octave));
        depths.depth.begin_m = begin_m - depths.depth.blend_m;
    }
    depths.cut[depths.cut_count++] =
        depthPlane(camera, shell > 0 ? depths.depth.begin_m : camera.near_m - camera.pad_m, true);
    if (shell + 1 < shells_.size()) {
        depths.depth.end_m = depthOf(shells_[shell].end);
    }
    depths.cut[depths.cut_count++] =
        depthPlane(camera, shell + 1 < shells_.size() ? depths.depth.end_m : camera.far_m + camera.pad_m, false);
    const auto add = [&](const Slice& way, std::size_t sector) {
        Slice slice = depths;
        slice.axis_ws = way.axis_ws;
        slice.half_angle_rad = way.half_angle_rad;
        slice.near_share = way.near_share;
        slice.sector = way.sector;
        addFrustum(input, slice,
                   static_cast<std::uint32_t>((shells_[shell].octave + 64) * 8) + static_cast<std::uint32_t>(sector));
    };
    if (input.light.type != LightType::point) {
        add(wholeSlice(input.light), 0);
        return;
    }
    if (const std::optional<Slice> aimed = aimAt(input, depths)) {
        add(*aimed, kSectors);
        return;
    }
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
        add(cubeFace(input.light, static_cast<int>(sector)), sector);
    }
}

/// One frustum for all that is seen of a shell, if the light sees it within a narrow enough cone.
std::optional<Slice> MultiPartition::aimAt(const Input& input, const Slice& shell)
{
    body_.reset(grown(reachOf(input.light, input.camera.scene_ws), input.camera.pad_m));
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

void MultiPartition::addFrustum(const Input& input, const Slice& slice, std::uint32_t id)
{
    GrownFrustum frustum;
    frustum.id = id;
    frustum.slice = slice;
    frustum.first_receiver = static_cast<std::uint32_t>(receivers_.size());
    const Aabb reach = grown(reachOf(input.light, input.camera.scene_ws), input.camera.pad_m);
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
        claims_.push_back({frustum.sum, frustum.wanted, largestSide(input), 1, frustum.side_before, 0});
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

} // namespace gnomon
