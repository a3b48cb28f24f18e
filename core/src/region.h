// SPDX-License-Identifier: Apache-2.0
// The region of one frustum of a light: the body that the camera sees and the light reaches, and the casters that can
// shade it.
#pragma once

#include "light_space.h"
#include "partition/partition.h"

#include <span>
#include <vector>

namespace gnomon {

inline constexpr Outcome kTooFarApart{OutcomeKind::degenerate,
                                      "the numbers of camera, light and scene are too far apart to plan a map by"};

/// Larger by so much on all sides.
[[nodiscard]] Aabb grown(const Aabb& box, double by_m);

struct RegionInput {
    const LightSpace& space;
    const Slice& slice;
    const CameraView& view;
    const ObjectSet& objects;
    std::span<const std::uint32_t> seen; // receivers that the camera sees, ascending
    bool draws_receivers = false;        // Recipe::drawsReceivers()
    std::uint32_t groups = kAllGroups;   // Light::groups
};

/// From where casters can throw a shadow into a map.
struct CasterReach {
    LightRect rect;     // the map's rectangle
    double pad = 0.0;   // how far outside what is seen texels count, because a filter's kernel looks that far
    double far_m = 0.0; // depth behind which nothing casts
    bool whole = false; // all of the rectangle counts, not only what is seen
};

class Region {
public:
    /// ok or no_receiver. Keeps its memory.
    Outcome gatherReceivers(const RegionInput& input);
    /// Makes outline() and rect() larger by so much on all sides; after gatherReceivers() said ok.
    void widen(double by);
    /// ok or no_caster; after gatherReceivers() said ok for the same input. Appends the casters to `casters`,
    /// ascending.
    Outcome gatherCasters(const RegionInput& input, const CasterReach& reach, std::vector<std::uint32_t>& casters);

    /// Valid after gatherReceivers() said ok, until the next one.
    [[nodiscard]] const ConvexBody& body() const { return body_; }
    /// The seen and lit body, seen from the light: convex, counter-clockwise, one corner at least, within rect().
    [[nodiscard]] std::span<const glm::dvec2> outline() const { return outline_; }
    [[nodiscard]] const LightRect& rect() const { return rect_; }
    /// Depths as LightSpace::depth_ws measures them, from its origin.
    [[nodiscard]] double receiverNear_m() const { return receiver_near_m_; }
    [[nodiscard]] double receiverFar_m() const { return receiver_far_m_; }
    /// Valid after gatherCasters() said ok.
    [[nodiscard]] double casterNear_m() const { return caster_near_m_; }
    [[nodiscard]] glm::dvec3 centre_ws() const { return centre_ws_; }

private:
    bool measureBox(const RegionInput& input, const Aabb& box, glm::dvec3& low, glm::dvec3& high);
    bool measureBody(const LightSpace& space);
    void narrowToBoxes(const LightSpace& space);
    void narrowOutline();
    void measureCasters(const RegionInput& input, std::span<const std::uint32_t> casters);
    double depthInCone(const LightSpace& space, const Aabb& box);
    static void leaveOutOthers(const RegionInput& input, bool whole, std::size_t first,
                               std::vector<std::uint32_t>& casters);
    void makeCasterPlanes(const RegionInput& input, const CasterReach& reach);
    void addOutlinePlanes(const LightSpace& space, double pad, double pad_m, double rounding);
    void addSidePlane(const LightSpace& space, const glm::dvec2& normal, double offset, double pad);

    ConvexBody body_;
    ConvexBody caster_body_;
    LightRect rect_;
    LightRect boxes_rect_;
    bool boxes_measured_ = false;
    int cut_boxes_ = 0;
    double receiver_near_m_ = 0.0;
    double receiver_far_m_ = 0.0;
    double boxes_near_m_ = 0.0;
    double boxes_far_m_ = 0.0;
    double caster_near_m_ = 0.0;
    glm::dvec3 centre_ws_{0.0};
    std::vector<Plane> cone_planes_;
    std::vector<Plane> body_planes_;
    std::vector<Plane> caster_planes_;
    std::vector<glm::dvec2> outline_;
    std::vector<glm::dvec2> outline_points_;
};

} // namespace gnomon
