// SPDX-License-Identifier: Apache-2.0
// The fourth step of a plan: each frustum's projection, and who is drawn with it.
#pragma once

#include "frustum_planner.h"
#include "plan/places.h"
#include "plan/view_map.h"

#include <gnomon/object_ids.h>

#include <optional>
#include <vector>

namespace gnomon {

class Schedule;

class Views {
public:
    /// Fills in the plan's views, casters, ids and volumes, and says of each light what became of it. A light that
    /// waits is left out.
    void fit(const Sights& sights, const Frustums& frustums, const Places& places, Schedule& schedule, Plan& plan);
    /// By view of the plan.
    [[nodiscard]] std::vector<ViewMap>& maps() { return maps_; }

private:
    /// The results of the steps before, and the plan.
    struct Results {
        const Sights& sights;
        const Frustums& frustums;
        const Places& places;
        Schedule& schedule;
        Plan& plan;

        [[nodiscard]] const Setup& setupOf(std::uint32_t light) const
        {
            return sights.setups()[plan.lights[light].options];
        }
    };
    void fitLight(const Results& from, std::uint32_t index);
    [[nodiscard]] static Outcome prospect(const Results& from, std::uint32_t index);
    Outcome fitPositions(const Results& from, std::uint32_t index);
    Outcome fitFrustum(const Results& from, const LightPosition& position, const LightFrustum& frustum);
    Outcome fitWide(const Results& from, const LightPosition& position, const LightFrustum& frustum);
    Outcome placePage(const Results& from, const LightPosition& position, const LightFrustum& frustum);
    void addView(const Results& from, const LightPosition& position, const MapPlace& place, const View& fitted);
    // views_of_ids.cpp
    Outcome handOutIds(const Results& from, std::uint32_t index);
    [[nodiscard]] std::uint64_t idsKey(const Plan& plan, const View& view) const;
    // views_of_volumes.cpp
    void listVolumes(const Results& from, std::uint32_t index);
    Outcome listClosed(const Results& from, std::uint32_t index);

    std::vector<ViewMap> maps_;
    // Scratch.
    FrustumPlanner planner_;
    IdScratch ids_;
    std::vector<bool> shares_bounds_; // by object: Plan::object_bounds has more than its own
};

} // namespace gnomon
