// SPDX-License-Identifier: Apache-2.0
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (only receivers that camera and light both see count;
// unseen casters still cast); convex body clipping instead of boxes of boxes.
#include "region.h"

#include "outline.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostCutBoxes = 32;

/// The square pyramid of a light with a place, from its near distance to its reach.
void makeConePlanes(const LightSpace& space, std::vector<Plane>& out)
{
    out.clear();
    if (!space.perspective) {
        return;
    }
    const auto through = [&](const glm::dvec3& normal, double offset) {
        out.push_back({normal, offset - glm::dot(normal, space.origin_ws)});
    };
    for (const glm::dvec3& side : {space.right_ws, -space.right_ws, space.up_ws, -space.up_ws}) {
        through(glm::normalize(side + space.forward_ws * space.tangent), 0.0);
    }
    through(space.forward_ws, -space.near_m);
    through(-space.forward_ws, space.reach_m);
}

} // namespace

Aabb grown(const Aabb& box, double by_m)
{
    const glm::vec3 by(static_cast<float>(by_m));
    return {box.min - by, box.max + by};
}

Outcome Region::gatherReceivers(const RegionInput& input)
{
    const LightSpace& space = input.space;
    const glm::dmat3 axes(space.right_ws, space.up_ws, space.depth_ws);
    const glm::dmat3 sizes(glm::abs(axes[0]), glm::abs(axes[1]), glm::abs(axes[2]));
    makeConePlanes(space, cone_planes_);
    Aabb receivers_ws;
    glm::dvec3 low(kInfinity);
    glm::dvec3 high(-kInfinity);
    boxes_measured_ = true;
    cut_boxes_ = 0;
    const std::span<const Aabb> bounds = input.objects.allBounds();
    for (const std::uint32_t object : input.seen) {
        const Aabb& box = bounds[object];
        // Padded, because a light without a range ends where the scene does: at the very corner of a box.
        if (space.perspective && classify(cone_planes_, grown(box, input.view.pad_m)) == Containment::outside) {
            continue;
        }
        receivers_ws.min = glm::min(receivers_ws.min, box.min);
        receivers_ws.max = glm::max(receivers_ws.max, box.max);
        if (!space.perspective) {
            const glm::dvec3 centre = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
            const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5;
            // A vector times a matrix: its dot product with each axis.
            low = glm::min(low, centre * axes - half * sizes);
            high = glm::max(high, centre * axes + half * sizes);
            continue;
        }
        boxes_measured_ = boxes_measured_ && measureBox(input, box, low, high);
    }
    if (receivers_ws.empty()) {
        return {OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
    }
    // Directional coordinates are from the world's origin, which is where LightSpace puts its own.
    boxes_measured_ = boxes_measured_ && low.x <= high.x;
    boxes_rect_ = {glm::dvec2(low), glm::dvec2(high)};
    boxes_near_m_ = low.z;
    boxes_far_m_ = high.z;

    // From a box inwards, because a camera's frustum may have no end.
    body_.reset(grown(receivers_ws, input.view.pad_m));
    body_.clip(input.view.planes);
    body_.clip(std::span(input.slice.cut).first(input.slice.cut_count));
    body_.clip(cone_planes_);
    if (!measureBody(space)) {
        return {OutcomeKind::no_receiver, "nothing that the camera sees is in the light's reach"};
    }
    if (const glm::dvec2 size = rect_.high - rect_.low;
        !std::isfinite(size.x + size.y + receiver_far_m_ - receiver_near_m_)) {
        return kTooFarApart;
    }
    outlineOf(outline_points_, outline_);
    narrowToBoxes(space);
    return {};
}

/// Widens bounds of coordinates as LightSpace::project() has them by a box. A box that reaches behind the light has no
/// bounded image, but its part in the cone does. False: too many were cut already, because it takes a microsecond.
bool Region::measureBox(const RegionInput& input, const Aabb& box, glm::dvec3& low, glm::dvec3& high)
{
    const LightSpace& space = input.space;
    const auto add = [&](const glm::dvec3& c) {
        const glm::dvec3 p(c.x / c.z, c.y / c.z, c.z);
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    bool is_before = true;
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        corners[static_cast<std::size_t>(i)] = space.coordinates(glm::dvec3(box.corner(i)));
        is_before = is_before && corners[static_cast<std::size_t>(i)].z >= space.near_m;
    }
    if (is_before) {
        std::ranges::for_each(corners, add);
        return true;
    }
    if (cut_boxes_ == kMostCutBoxes) {
        return false;
    }
    ++cut_boxes_;
    caster_body_.reset(grown(box, input.view.pad_m));
    caster_body_.clip(cone_planes_);
    caster_body_.clip(std::span(input.slice.cut).first(input.slice.cut_count));
    for (const glm::dvec3& p : caster_body_.points()) {
        add(space.coordinates(p));
    }
    return true;
}

bool Region::measureBody(const LightSpace& space)
{
    if (body_.empty()) {
        return false;
    }
    glm::dvec3 low(kInfinity);
    glm::dvec3 high(-kInfinity);
    glm::dvec3 low_ws(kInfinity);
    glm::dvec3 high_ws(-kInfinity);
    outline_points_.clear();
    for (const glm::dvec3& corner : body_.points()) {
        const glm::dvec3 p = space.project(corner);
        low = glm::min(low, p);
        high = glm::max(high, p);
        low_ws = glm::min(low_ws, corner);
        high_ws = glm::max(high_ws, corner);
        outline_points_.emplace_back(p.x, p.y);
    }
    rect_ = {glm::dvec2(low), glm::dvec2(high)};
    receiver_near_m_ = low.z;
    receiver_far_m_ = high.z;
    centre_ws_ = (low_ws + high_ws) * 0.5;
    return true;
}

void Region::narrowToBoxes(const LightSpace& space)
{
    if (!boxes_measured_) {
        return;
    }
    // The body is cut from the box of all boxes; seen from the light the boxes themselves may take less room.
    rect_.low = glm::max(rect_.low, boxes_rect_.low);
    rect_.high = glm::max(glm::min(rect_.high, boxes_rect_.high), rect_.low);
    receiver_near_m_ = std::max(receiver_near_m_, boxes_near_m_);
    receiver_far_m_ = std::max(std::min(receiver_far_m_, boxes_far_m_), receiver_near_m_);
    if (space.perspective) {
        receiver_near_m_ = std::max(receiver_near_m_, space.near_m);
    }
    narrowOutline();
}

/// Clips the outline by the rectangle. Based on: I. Sutherland, G. Hodgman, "Reentrant polygon clipping", 1974.
void Region::narrowOutline()
{
    for (int side = 0; side < 4; ++side) {
        const int axis = side & 1;
        const double sign = side < 2 ? 1.0 : -1.0;
        const double limit = side < 2 ? rect_.low[axis] : rect_.high[axis];
        const auto inside = [&](const glm::dvec2& p) {
            return sign * (p[axis] - limit);
        };
        outline_points_.clear();
        for (std::size_t i = 0; i < outline_.size(); ++i) {
            const glm::dvec2& a = outline_[i];
            const glm::dvec2& b = outline_[(i + 1) % outline_.size()];
            const double da = inside(a);
            const double db = inside(b);
            if (da >= 0.0) {
                outline_points_.push_back(a);
            }
            if ((da < 0.0) != (db < 0.0)) {
                glm::dvec2 cut = a + (b - a) * (da / (da - db));
                cut[axis] = limit;
                outline_points_.push_back(cut);
            }
        }
        // Nothing is left where rounding alone held the two apart.
        if (outline_points_.empty()) {
            outline_points_.push_back((rect_.low + rect_.high) * 0.5);
        }
        outline_.swap(outline_points_);
    }
}

void Region::widen(double by)
{
    widenOutline(outline_, by, outline_points_);
    rect_ = {rect_.low - by, rect_.high + by};
}

void Region::addSidePlane(const LightSpace& space, const glm::dvec2& normal, double offset, double pad)
{
    // normal . xy + offset + pad >= 0, as a plane along the rays of light.
    const glm::dvec3 across = space.right_ws * normal.x + space.up_ws * normal.y;
    if (!space.perspective) {
        caster_planes_.push_back({across, offset + pad - glm::dot(across, space.origin_ws)});
        return;
    }
    const glm::dvec3 side = across + space.forward_ws * (offset + pad);
    const glm::dvec3 unit = glm::normalize(side);
    caster_planes_.push_back({unit, -glm::dot(unit, space.origin_ws)});
}

/// The body swept toward the light: the sides of its outline along the rays, and those of its faces that look away
/// from the light.
void Region::addOutlinePlanes(const LightSpace& space, double pad, double pad_m, double rounding)
{
    body_.planes(body_planes_);
    for (const Plane& face : body_planes_) {
        const bool looks_away =
            space.perspective ? face.distance(space.origin_ws) > 0.0 : glm::dot(face.normal, space.forward_ws) < -1e-6;
        if (looks_away) {
            caster_planes_.push_back({face.normal, face.d + pad_m});
        }
    }
    for (std::size_t i = 0; i < outline_.size(); ++i) {
        const glm::dvec2 edge = outline_[(i + 1) % outline_.size()] - outline_[i];
        const double length = glm::length(edge);
        if (!(length > rounding)) {
            continue;
        }
        const glm::dvec2 normal(-edge.y / length, edge.x / length);
        double offset = -glm::dot(normal, outline_[i]);
        for (const glm::dvec2& p : outline_) {
            offset = std::max(offset, -glm::dot(normal, p));
        }
        addSidePlane(space, normal, offset, pad);
    }
}

void Region::makeCasterPlanes(const RegionInput& input, const CasterReach& reach)
{
    const LightSpace& space = input.space;
    const double rounding = space.perspective ? 1e-7 : input.view.pad_m;
    const double pad = reach.pad + rounding;

    caster_planes_.clear();
    addSidePlane(space, {1.0, 0.0}, -reach.rect.low.x, pad);
    addSidePlane(space, {-1.0, 0.0}, reach.rect.high.x, pad);
    addSidePlane(space, {0.0, 1.0}, -reach.rect.low.y, pad);
    addSidePlane(space, {0.0, -1.0}, reach.rect.high.y, pad);
    const double pad_m = (space.perspective ? pad * reach.far_m : pad) + input.view.pad_m;
    caster_planes_.push_back({-space.depth_ws, reach.far_m + pad_m + glm::dot(space.depth_ws, space.origin_ws)});
    if (space.perspective) {
        caster_planes_.push_back({space.forward_ws, -space.near_m - glm::dot(space.forward_ws, space.origin_ws)});
    }
    if (!reach.whole) {
        addOutlinePlanes(space, pad, pad_m, rounding);
    }
}

/// A receiver that does not cast is in the map for its own shadows alone, and hides all that is behind it: as a lamp's
/// housing would the room. For a map that is not for what is seen alone (`whole`) any receiver may be.
void Region::leaveOutOthers(const RegionInput& input, bool whole, std::size_t first,
                            std::vector<std::uint32_t>& casters)
{
    const auto is_other = [&](std::uint32_t object) {
        const ObjectFlags flags = input.objects.flags(object);
        const bool in_map = flags.casts || (whole ? flags.receives : std::ranges::binary_search(input.seen, object));
        return !in_map || (flags.groups & input.groups) == 0;
    };
    casters.erase(std::remove_if(casters.begin() + static_cast<std::ptrdiff_t>(first), casters.end(), is_other),
                  casters.end());
}

Outcome Region::gatherCasters(const RegionInput& input, const CasterReach& reach, std::vector<std::uint32_t>& casters)
{
    makeCasterPlanes(input, reach);
    const std::size_t first = casters.size();
    input.objects.query(caster_planes_, ObjectSet::Want::casters, casters, input.groups);
    if (casters.size() != first && input.draws_receivers) {
        casters.resize(first);
        input.objects.query(caster_planes_, ObjectSet::Want::all, casters);
        leaveOutOthers(input, reach.whole, first, casters);
    }
    if (casters.size() == first) {
        return {OutcomeKind::no_caster, "nothing can throw a shadow on what the camera sees"};
    }
    measureCasters(input, std::span(casters).subspan(first));
    return {};
}

void Region::measureCasters(const RegionInput& input, std::span<const std::uint32_t> casters)
{
    const LightSpace& space = input.space;
    const glm::dvec3 size = glm::abs(space.depth_ws);
    const std::span<const Aabb> bounds = input.objects.allBounds();
    int cut_boxes = 0;
    caster_near_m_ = kInfinity;
    for (const std::uint32_t object : casters) {
        const Aabb& box = bounds[object];
        const glm::dvec3 centre = (glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5;
        const glm::dvec3 half = (glm::dvec3(box.max) - glm::dvec3(box.min)) * 0.5;
        const double depth_m = glm::dot(space.depth_ws, centre - space.origin_ws) - glm::dot(size, half);
        if (depth_m >= caster_near_m_) {
            continue;
        }
        // A floor or wall that passes the light has its nearest corner behind it, and says nothing; its part in the
        // cone does. Only for the first few, because clipping takes a microsecond.
        const bool passes = space.perspective && depth_m < space.near_m;
        if (!passes || cut_boxes == kMostCutBoxes) {
            caster_near_m_ = depth_m;
        } else {
            ++cut_boxes;
            caster_near_m_ = std::min(caster_near_m_, depthInCone(space, grown(box, input.view.pad_m)));
        }
    }
    // All of them only near the cone: its near distance holds for any.
    if (caster_near_m_ == kInfinity) {
        caster_near_m_ = space.near_m;
    }
}

/// Depth of the nearest point of a box that is in the light's cone; infinity when none is.
double Region::depthInCone(const LightSpace& space, const Aabb& box)
{
    caster_body_.reset(box);
    caster_body_.clip(cone_planes_);
    double nearest_m = kInfinity;
    for (const glm::dvec3& corner : caster_body_.points()) {
        nearest_m = std::min(nearest_m, space.coordinates(corner).z);
    }
    return nearest_m;
}

} // namespace gnomon
