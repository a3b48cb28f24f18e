// SPDX-License-Identifier: Apache-2.0
// Multi-frustum partitioning. A texel of a lamp's map is as large as it is far from the lamp, and a pixel as it is far
// from the eye. So receivers of a lamp are cut into shells of the camera's depth over the lamp's, and receivers of a
// sun into shells of the camera's depth: receivers in one shell want the same texels, to a factor of two. A lamp's
// surroundings are cut into the faces of a cube. Shells grow together where that costs few texels. Each frustum has a
// map of the size that its part of the picture needs.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006.
// Departures: receivers are cut where their need for texels halves, and not each given to one frustum, so that a floor
// needs no pieces made by hand and nothing pops when an object goes from one to another; frustums fade into each other
// instead. Texels are counted at some hundred points that the camera probably sees (Sight).
#include "partition/multi.h"

#include "light_reach.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

/// Shells are taken where they want kTakeShells times the texels of no shells, and kept up to kKeepShells times.
constexpr double kTakeShells = 0.75;
constexpr double kKeepShells = 0.9;
/// Other shells have to be better for this number of frames on end before what holds still is changed for them: what
/// is known of the picture is some hundred guesses, and they jump.
constexpr std::uint32_t kPatience_frames = 8;
/// One frustum serves all of a shell if the light sees it within this half angle.
constexpr double kWidestHalfAngle_rad = 0.87;
/// Side of a map whose wanted texels are not known.
constexpr double kUnknownSide = 64.0;

/// Keeps the row's positive side. A row that is nearly zero has no side.
void cutBy(const glm::dvec4& row, Slice& slice)
{
    constexpr double kLeast = 1e-9;
    if (const double length = glm::length(glm::dvec3(row)); length > kLeast) {
        slice.cut[slice.cut_count++] = {glm::dvec3(row) / length, row.w / length};
    }
}

/// A part of what a light shines on in one of its directions. Where it begins it fades in over a share of the octave
/// before.
Slice sliceOf(const CameraView& camera, const Slice& way, const FrustumPart& part, double blend)
{
    Slice slice = way;
    slice.depth.axis = glm::dvec4(camera.forward_ws, -glm::dot(camera.forward_ws, camera.eye_ws));
    slice.cut[slice.cut_count++] = depthPlane(camera, camera.near_m - camera.pad_m, true);
    slice.cut[slice.cut_count++] = depthPlane(camera, camera.far_m + camera.pad_m, false);
    if (part.octave != kFromEye) {
        slice.depth.blend_m = blend * beginOfOctave(part.octave - 1);
        slice.depth.begin_m = beginOfOctave(part.octave) - slice.depth.blend_m;
        cutBy(slice.depth.axis - slice.depth.begin_m * slice.depth.over, slice);
    }
    if (part.end != kToEnd) {
        slice.depth.end_m = beginOfOctave(part.end);
        cutBy(slice.depth.end_m * slice.depth.over - slice.depth.axis, slice);
    }
    return slice;
}

/// A lamp's depths are counted along the direction's axis.
Slice countedAlong(const Light& light, Slice way)
{
    way.sector.w = glm::dvec4(way.axis_ws, -glm::dot(way.axis_ws, light.position_ws));
    way.depth.over = way.sector.w;
    return way;
}

/// The id within its light: the same from frame to frame, wherever a frustum that is refitted in each frame ends.
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

/// Octaves of what a shell's places need; 0: any.
int widestShell(const MultiOptions& options)
{
    return options.most_times > 0.0 ? std::max(1, static_cast<int>(std::floor(std::log2(options.most_times)))) : 0;
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
    before_.resize(memories_.size());
    for (const std::uint32_t row : rows_.gone()) {
        memories_[row] = {};
        before_[row] = {};
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
    if (memory.type != layoutOf(input.light)) { // its directions were others
        memory = {};
        memory.type = layoutOf(input.light);
    }
    if (takesTurns(input)) {
        before_[rows_.rowOf(light)] = memory;
    }
    Range& range = ranges_[light];
    range.first = frustums_.size();
    if (input.frame.cut) {
        memory.held.cut();
        memory.cones.clear();
    }
    const bool gathers = input.recipe.options().multi.divide == MultiDivide::receivers;
    if (gathers) {
        gather(input, memory, frustums);
    } else {
        findFrustums(input, memory, range.first, frustums);
    }
    sizeFrustums(input, memory, std::span(frustums_).subspan(range.first));
    if (gathers) {
        orderCones(input, memory, range.first);
    } else if (input.recipe.steady()) {
        hold(input, memory.held, range.first);
    }
    range.count = frustums_.size() - range.first;
    if (takesTurns(input)) {
        const std::span<const GrownFrustum> found = frustumsOf(light);
        memory.last.assign(found.begin(), found.end());
    }
}

bool MultiPartition::differs(std::size_t light) const
{
    return !std::ranges::equal(
        frustumsOf(light), before_[rows_.rowOf(light)].last,
        [](const GrownFrustum& a, const GrownFrustum& b) { return a.id == b.id && a.side == b.side; });
}

void MultiPartition::restoreMemory(std::size_t light)
{
    std::swap(memories_[rows_.rowOf(light)], before_[rows_.rowOf(light)]);
}

void MultiPartition::restoreFrustums(const Input& input, std::size_t light)
{
    restoreMemory(light);
    const std::vector<GrownFrustum>& last = memories_[rows_.rowOf(light)].last;
    ranges_[light] = {frustums_.size(), last.size()};
    for (const GrownFrustum& one : last) {
        listReceivers(input, frustums_.emplace_back(one));
    }
}

/// Points tell which shells may pay. Whether they do is told by what the frustums have to hold: of a receiver no more
/// is known than its box, and what is in sight of each shell may be the whole of it.
void MultiPartition::findFrustums(const Input& input, Memory& memory, std::size_t first, FrustumPlanner& frustums)
{
    const glm::dvec2 cell_px(static_cast<double>(input.frame.size_px.x) / Sight::kColumns,
                             static_cast<double>(input.frame.size_px.y) / Sight::kRows);
    findWays(input);
    const DepthShells::Input seen{input.light,          input.camera, ways_,
                                  input.sight.points(), cell_px,      widestShell(input.recipe.options().multi)};
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
    if (seen.widest > 0) { // not asked for to save texels
        pays = shells_.shells().size() > 1;
    } else if (shells_.shells().size() > 1) {
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
    return predict(input, memory, first, frustums);
}

/// Finds out what the frustums from `first` on have to hold, and removes those that hold nothing. Returns how many
/// texels they want together.
double MultiPartition::predict(const Input& input, const Memory& memory, std::size_t first, FrustumPlanner& frustums)
{
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
        const double inner = seen.facing.coarsest_px * texelsPerPixel(input) * (largest - border);
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

/// The first shell serves what wants finer texels than all points, the last what wants coarser ones.
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
    for (std::size_t way = 0; way < ways_.size(); ++way) {
        part.sector = aimed_ ? kCubeFaces : static_cast<std::uint32_t>(way);
        addFrustum(input, sliceOf(input.camera, ways_[way], part, input.recipe.options().cascades.blend), part);
    }
}

/// The directions among which the light is divided.
void MultiPartition::findWays(const Input& input)
{
    ways_.clear();
    aimed_ = false;
    if (input.light.type == LightType::directional) {
        ways_.push_back(wholeSlice(input.light));
        return;
    }
    if (layoutOf(input.light) == LightType::spot) {
        ways_.push_back(countedAlong(input.light, wholeSlice(input.light)));
        return;
    }
    // One whose axis follows what is seen holds nothing still.
    if (const std::optional<Slice> aimed = input.recipe.steady() ? std::nullopt : aim(input)) {
        ways_.push_back(countedAlong(input.light, *aimed));
        aimed_ = true;
        return;
    }
    for (int face = 0; face < static_cast<int>(kCubeFaces); ++face) {
        ways_.push_back(countedAlong(input.light, cubeFace(input.light, face)));
    }
}

/// One direction for all that is seen, if the light sees it within a narrow enough cone.
std::optional<Slice> MultiPartition::aim(const Input& input)
{
    const CameraView& camera = input.camera;
    const std::array<Plane, 2> depths{depthPlane(camera, camera.near_m - camera.pad_m, true),
                                      depthPlane(camera, camera.far_m + camera.pad_m, false)};
    body_.reset(grown(reachBox(input.light, camera.scene_ws), camera.pad_m));
    body_.clip(camera.planes);
    body_.clip(depths);
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
    listReceivers(input, frustum);
    if (frustum.receiver_count > 0) {
        frustums_.push_back(frustum);
    }
}

/// Those of a frustum's receivers that the light reaches.
void MultiPartition::listReceivers(const Input& input, GrownFrustum& frustum)
{
    frustum.first_receiver = static_cast<std::uint32_t>(receivers_.size());
    const Aabb reach = grown(reachBox(input.light, input.camera.scene_ws), input.camera.pad_m);
    const std::span<const Aabb> bounds = input.frame.objects->allBounds();
    const std::span cut = std::span(frustum.slice.cut).first(frustum.slice.cut_count);
    for (const std::uint32_t object : input.receivers) {
        const Aabb& box = bounds[object];
        const bool reached =
            glm::all(glm::lessThanEqual(box.min, reach.max)) && glm::all(glm::greaterThanEqual(box.max, reach.min));
        if (reached && classify(cut, grown(box, input.camera.pad_m)) != Containment::outside) {
            receivers_.push_back(object);
        }
    }
    frustum.receiver_count = static_cast<std::uint32_t>(receivers_.size()) - frustum.first_receiver;
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
    held.take(found_, input.recipe.options().multi.fade_frames);
    const double faded_in = held.fadedIn(input.recipe.options().multi.fade_frames);
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
        const std::size_t count = frustums_.size();
        addFrustum(input,
                   sliceOf(input.camera, ways_[one.part.sector], one.part, input.recipe.options().cascades.blend),
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
