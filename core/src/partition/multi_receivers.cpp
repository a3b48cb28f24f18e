// SPDX-License-Identifier: Apache-2.0
// Each receiver wants as many texels per degree of the light as its nearest part has pixels. Receivers are taken from
// near to far. Each goes into the first frustum that holds it and has at least the texels it wants, but not more than
// four times as many; else into the one that has to grow least for that; else into one of its own. A receiver that no
// one frustum can hold is cut into six at most.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006.
// Departures: the nearest part is not that of a bounding sphere, but of what camera and light see of the receiver's
// box. A frustum ends at the rectangle around its receivers, not at its cone. A pixel does not know its receiver: it
// takes the finest frustum that holds it, which has at least the texels that its receiver wants. So nothing is drawn
// twice where receivers join or are cut: a frustum fades out across its own border, which is half a blend outside of
// its receivers.
#include "partition/multi_receivers.h"

#include "light_reach.h"
#include "partition/depth_shells.h"
#include "region.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A receiver is cut into no more pieces: the faces of a cube.
constexpr std::uint32_t kMostCuts = kCubeFaces;
/// A light with kEnoughCones frustums gets more only where none can turn to a receiver: coarse texels beat none.
constexpr std::size_t kEnoughCones = 16;
/// The texels of a frustum that holds still are so much finer than its receivers want at first, so that they last.
constexpr double kFinerHeld = 0.7;
/// And one that begins to hold still takes so much of the largest map: what it holds will move.
constexpr double kLargestHeld = 0.6;

bool isSun(const Light& light)
{
    return light.type == LightType::directional;
}

double between(const Light& light, const glm::dvec3& a, const glm::dvec3& b)
{
    return isSun(light) ? glm::distance(a, b) : std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The smallest one around both; with `fixed` the smallest with a's own centre.
LightCone joined(const Light& light, const LightCone& a, const LightCone& b, bool fixed)
{
    const double apart = between(light, a.centre, b.centre);
    if (apart + b.radius <= a.radius) {
        return a;
    }
    if (fixed) {
        return {a.centre, std::max(a.radius, apart + b.radius)};
    }
    if (apart + a.radius <= b.radius) {
        return b;
    }
    LightCone both{a.centre, 0.5 * (a.radius + b.radius + apart)};
    const double gone = both.radius - a.radius;
    if (isSun(light)) {
        both.centre += (b.centre - a.centre) * (gone / apart);
    } else { // along the great circle from a to b
        const glm::dvec3 aside = b.centre - a.centre * glm::dot(a.centre, b.centre);
        const double length = glm::length(aside);
        both.centre =
            length > 0.0 ? glm::normalize(a.centre * std::cos(gone) + aside / length * std::sin(gone)) : a.centre;
        both.radius = std::max(between(light, both.centre, a.centre) + a.radius,
                               between(light, both.centre, b.centre) + b.radius);
    }
    return both;
}

/// Half the width of the map that shows a cone and its blend, as LightRect has it; infinite: no map does.
double halfOf(const ReceiverCones::Input& input, const LightCone& cone)
{
    if (isSun(input.light)) {
        return cone.radius * (1.0 + input.blend);
    }
    const double half = cone.radius < 1.5 ? std::tan(cone.radius) * (1.0 + input.blend) : kInfinity;
    return half <= kWidestTangent ? half : kInfinity;
}

double sideOf(const ReceiverCones::Input& input, const ReceiverCone& cone)
{
    return 2.0 * halfOf(input, cone.cone) / cone.texel;
}

Plane acrossView(const CameraView& camera, double depth_m, double sign)
{
    const glm::dvec3 normal = sign * camera.forward_ws;
    return {normal, -glm::dot(normal, camera.eye_ws) - sign * depth_m};
}

} // namespace

glm::dvec3 axisOf(const Light& light, const LightCone& cone)
{
    return isSun(light) ? light.direction_ws : cone.centre;
}

Plane planeOf(const glm::dvec4& row)
{
    const double length = glm::length(glm::dvec3(row));
    return {glm::dvec3(row) / length, row.w / length};
}

std::span<ReceiverCone> ReceiverCones::gather(const Input& input, std::span<const ReceiverCone> held,
                                              std::span<const ReceiverHome> homes)
{
    cones_.assign(held.begin(), held.end());
    for (ReceiverCone& cone : cones_) {
        cone.cone.radius = 0.0;
        cone.coarsest = cone.texel;
        cone.pieces = 0;
        cone.joined = false;
    }
    listPieces(input);
    std::ranges::sort(pieces_, {}, [](const Piece& one) { return std::tuple(one.depth_m, one.object, one.number); });
    for (Piece& piece : pieces_) {
        place(input, homes, piece);
    }
    measure(input);
    return cones_;
}

/// Clips each receiver to the part that camera and light see, and cuts it where it is too large.
void ReceiverCones::listPieces(const Input& input)
{
    pieces_.clear();
    points_.clear();
    const CameraView& camera = input.camera;
    const Aabb reach = grown(reachBox(input.light, camera.scene_ws), camera.pad_m);
    const std::array<Plane, 2> depths{depthPlane(camera, camera.near_m - camera.pad_m, true),
                                      depthPlane(camera, camera.far_m + camera.pad_m, false)};
    const bool has_cone = layoutOf(input.light) == LightType::spot;
    const LightSpace space = lightSpaceOf(input.light, input.light.direction_ws,
                                          has_cone ? input.light.outer_half_angle_rad : 0.0, camera.scene_ws);
    for (const std::uint32_t object : input.receivers) {
        const Aabb box = grown(input.objects.allBounds()[object], camera.pad_m);
        const Aabb lit{glm::max(box.min, reach.min), glm::min(box.max, reach.max)};
        if (lit.empty()) {
            continue;
        }
        body_.reset(lit);
        body_.clip(camera.planes).clip(depths);
        for (const glm::dvec3& side : {space.right_ws, -space.right_ws, space.up_ws, -space.up_ws}) {
            if (has_cone) {
                const glm::dvec3 normal = glm::normalize(side + space.forward_ws * space.tangent);
                body_.clip(Plane{normal, camera.pad_m - glm::dot(normal, space.origin_ws)});
            }
        }
        const std::size_t points = points_.size();
        const Piece piece = pieceOf(input, object, 0);
        const double side = 2.0 * halfOf(input, piece.cone) / piece.texel;
        if (piece.point_count > 0 && side > input.largest_texels) {
            points_.resize(points);
            chop(input, piece);
        } else if (piece.point_count > 0) {
            pieces_.push_back(piece);
        }
    }
}

/// By the faces of a cube, where it is too wide for a lamp's frustum. Where it is too large for a map its near part
/// wants most, so it is cut across the view.
void ReceiverCones::chop(const Input& input, const Piece& whole)
{
    whole_ = body_;
    const bool too_wide = halfOf(input, whole.cone) == kInfinity;
    double far_m = 0.0;
    for (const glm::dvec3& p : whole_.points()) {
        far_m = std::max(far_m, input.camera.depthOf(p));
    }
    const double near_m = std::max(whole.depth_m, input.camera.pad_m);
    const double octaves = input.camera.perspective && far_m > near_m ? std::log2(far_m / near_m) : 0.0;
    const auto slices = static_cast<std::uint32_t>(std::clamp(std::ceil(octaves), 1.0, static_cast<double>(kMostCuts)));
    const std::uint32_t count = too_wide ? kCubeFaces : slices;
    for (std::uint32_t i = 0; i < count; ++i) {
        body_ = whole_;
        if (too_wide) {
            const ViewSector face = cubeFace(input.light, static_cast<int>(i)).sector;
            for (const glm::dvec4& side : {face.x, -face.x, face.y, -face.y}) {
                body_.clip(planeOf(face.w + side));
            }
        } else if (count > 1) {
            const auto end = [&](std::uint32_t slice) {
                return near_m * std::pow(far_m / near_m, double(slice) / count);
            };
            body_.clip(acrossView(input.camera, i > 0 ? end(i) - input.camera.pad_m : 0.0, 1.0));
            body_.clip(acrossView(input.camera, (i + 1 < count ? end(i + 1) : far_m) + input.camera.pad_m, -1.0));
        }
        if (const Piece piece = pieceOf(input, whole.object, i + 1); piece.point_count > 0) {
            pieces_.push_back(piece);
        }
    }
}

/// The body as a piece. Depth over distance is quasi-concave on it, so its corners have the least.
ReceiverCones::Piece ReceiverCones::pieceOf(const Input& input, std::uint32_t object, std::uint32_t number)
{
    Piece piece;
    piece.object = object;
    piece.number = number;
    piece.first_point = static_cast<std::uint32_t>(points_.size());
    piece.joined = input.objects.flags(object).joined;
    piece.depth_m = kInfinity;
    piece.texel = kInfinity;
    const double least_m = 1e-3 * extentOf(input.light, input.camera.scene_ws).near_m; // no caster is so near
    for (const glm::dvec3& p : body_.points()) {
        const double from_light_m = isSun(input.light) ? 1.0 : glm::distance(p, input.light.position_ws);
        if (from_light_m <= least_m) {
            continue; // a cut body's apex has no direction
        }
        const double depth_m = std::max(input.camera.depthOf(p), input.camera.pad_m);
        const double pixel_m = input.camera.perspective ? input.pixel_m * depth_m : input.pixel_m;
        piece.depth_m = std::min(piece.depth_m, depth_m);
        piece.texel = std::min(piece.texel, pixel_m / (input.texels_per_pixel * from_light_m));
        points_.push_back(p);
    }
    piece.point_count = static_cast<std::uint32_t>(points_.size()) - piece.first_point;
    if (piece.point_count > 0) {
        piece.cone = coneAround(input, std::span(points_).last(piece.point_count));
    }
    return piece;
}

/// Nearly the smallest. Based on: M. Badoiu, K. Clarkson, "Smaller core-sets for balls", 2003: from any centre on, one
/// goes towards the farthest point by ever smaller shares of the way.
LightCone ReceiverCones::coneAround(const Input& input, std::span<const glm::dvec3> points)
{
    const Light& light = input.light;
    const LightSpace space = lightSpaceOf(light, light.direction_ws, 0.0, input.camera.scene_ws);
    seen_.clear();
    glm::dvec3 centre(0.0);
    for (const glm::dvec3& p : points) {
        const glm::dvec3 across = space.coordinates(p);
        seen_.push_back(isSun(light) ? glm::dvec3(across.x, across.y, 0.0) : glm::normalize(p - light.position_ws));
        centre += seen_.back() / static_cast<double>(points.size());
    }
    constexpr int kSteps = 16;
    LightCone best{{}, kInfinity};
    for (int step = 0; step < kSteps; ++step) {
        const double length = glm::length(centre);
        if (!isSun(light)) {
            centre = length > 0.0 ? centre / length : seen_.front();
        }
        const glm::dvec3 farthest = *std::ranges::max_element(seen_, {}, [&](const glm::dvec3& p) {
            return glm::dot(p - centre, p - centre); // for unit directions it grows with the angle
        });
        const double radius = between(light, centre, farthest);
        best = radius < best.radius ? LightCone{centre, radius} : best;
        centre += (farthest - centre) / (step + 2.0);
    }
    return best;
}

/// Makes a cone hold a piece, too. False: it cannot.
bool ReceiverCones::grow(const Input& input, const Piece& piece, ReceiverCone& cone)
{
    const bool begins = input.steady && !cone.held; // to hold still: what is in it will move
    const double most_times = input.most_times * (begins ? kFinerHeld : 1.0);
    cone.cone = joined(input.light, cone.cone, piece.cone, cone.held);
    cone.texel = cone.held ? cone.texel : std::min(cone.texel, piece.texel);
    cone.coarsest = std::max(cone.coarsest, piece.texel);
    return cone.texel <= piece.texel && cone.coarsest <= cone.texel * most_times &&
           sideOf(input, cone) <= input.largest_texels * (begins ? kLargestHeld : 1.0);
}

void ReceiverCones::put(std::size_t in, const ReceiverCone& grown, Piece& piece)
{
    ReceiverCone& cone = cones_[in];
    cone = grown;
    cone.joined = cone.joined || piece.joined;
    ++cone.pieces;
    piece.in = static_cast<std::uint32_t>(in);
}

bool ReceiverCones::putHome(const Input& input, std::span<const ReceiverHome> homes, Piece& piece)
{
    const auto home = std::ranges::lower_bound(homes, piece.key(), {}, &ReceiverHome::piece);
    if (home == homes.end() || home->piece != piece.key()) {
        return false;
    }
    const auto cone = std::ranges::find(cones_, home->cone, &ReceiverCone::id);
    if (cone == cones_.end()) {
        return false;
    }
    ReceiverCone grown = *cone;
    const bool holds = grow(input, piece, grown);
    if (holds) {
        put(static_cast<std::size_t>(cone - cones_.begin()), grown, piece);
    }
    return holds;
}

void ReceiverCones::place(const Input& input, std::span<const ReceiverHome> homes, Piece& piece)
{
    if (putHome(input, homes, piece)) {
        return;
    }
    ReceiverCone best;
    best.id = piece.object * (kMostCuts + 1) + piece.number;
    best.cone = piece.cone;
    best.texel = best.coarsest = piece.texel;
    std::size_t in = cones_.size();
    double least = kInfinity;
    const auto find = [&](bool coarser) {
        for (std::size_t i = 0; i < cones_.size() && least > 0.0; ++i) {
            ReceiverCone grown = cones_[i];
            const double texels = grown.pieces > 0 ? sideOf(input, grown) * sideOf(input, grown) : 0.0;
            bool holds = grow(input, piece, grown);
            if (coarser && !grown.held) {
                const double half = halfOf(input, grown.cone);
                grown.texel = std::max(grown.texel, 2.0 * half / (input.largest_texels * kLargestHeld));
                holds = half < kInfinity;
            }
            const double more = sideOf(input, grown) * sideOf(input, grown) - texels;
            if (holds && more < least) {
                best = grown;
                in = i;
                least = more;
            }
        }
    };
    find(false);
    if (in == cones_.size() && cones_.size() >= kEnoughCones) {
        find(true);
    }
    if (in == cones_.size()) {
        cones_.emplace_back();
    }
    put(in, best, piece);
}

void ReceiverCones::listHomes(std::vector<ReceiverHome>& out) const
{
    out.clear();
    for (const Piece& piece : pieces_) {
        out.push_back({piece.key(), cones_[piece.in].id});
    }
    std::ranges::sort(out, {}, &ReceiverHome::piece);
}

/// The rectangles around what is in the cones, each across its own axis.
void ReceiverCones::measure(const Input& input)
{
    for (ReceiverCone& cone : cones_) {
        if (cone.pieces > 0) {
            cone.rect = {glm::dvec2(kInfinity), glm::dvec2(-kInfinity)};
        }
    }
    for (const Piece& piece : pieces_) {
        ReceiverCone& cone = cones_[piece.in];
        const LightSpace space = lightSpaceOf(input.light, axisOf(input.light, cone.cone), 0.0, input.camera.scene_ws);
        for (const glm::dvec3& p : std::span(points_).subspan(piece.first_point, piece.point_count)) {
            const glm::dvec2 q(space.project(p));
            cone.rect.low = glm::min(cone.rect.low, q);
            cone.rect.high = glm::max(cone.rect.high, q);
        }
    }
}

} // namespace gnomon
