// SPDX-License-Identifier: Apache-2.0
// What a planner keeps of lights that take turns to be drawn (ShadowOptions::draw_budget_texels).
#pragma once

#include "cascade_turns.h"
#include "store/draw_turns.h"
#include "store/light_rows.h"
#include "store/map_store.h"

#include <gnomon/frame.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// Whose map a view of the plan has. What of it has to be drawn is said when all views are known.
struct ViewMap {
    const MapPlace* place = nullptr; // null: the view is of the plan before, with nothing to draw
    bool read = true;                // in this frame
    bool own_turn = false;           // it is a cascade that takes turns by itself
    bool may_wait = false;           // and the view that it had shows what it has to
    bool waits = false;              // its turn has not come
};

/// A light in one frame.
struct LightTurn {
    bool bounded = false;     // its options have a bound, and it may have maps
    bool by_cascade = false;  // its cascades take turns each by itself
    bool is_same = false;     // it is asked for as in the plan before, which it was in
    bool keeps_views = false; // those of the plan before can stand for it
    /// It waits, and that was known before its views were planned: it would have been divided otherwise.
    bool kept_back = false;
    bool waits = false;
    double share = 0.0;
    std::uint64_t texels = 0; // that have to be drawn for it, or are thought to have
};

/// A light in the plan before, by its key.
struct KnownLight {
    LightType type = LightType::directional;
    std::uint32_t options = 0;
    std::uint32_t map_size = 0;
    std::uint32_t first_view = 0; // of LightTurns::views
    std::uint32_t view_count = 0; // 0: it had none, or does not take turns
    std::uint32_t waited = 0;
    std::uint64_t texels = 0; // that had to be drawn for it, or were thought to
    Outcome outcome;
};

struct LightTurns {
    LightRows rows;
    std::vector<KnownLight> known; // by row
    std::vector<std::uint64_t> keys;
    std::vector<View> views; // of the plan before
    std::vector<std::uint32_t> casters;
    std::uint64_t objects = 0;     // ObjectSet::identity()
    std::vector<LightTurn> lights; // of the frame
    // By MapId::index, of cascades that take turns by themselves: what a map was planned for, and what it would be now.
    std::vector<ViewGround> grounds;
    std::vector<ViewGround> next_grounds;
    // Scratch.
    Region seen; // of a cascade, without room
    DrawTurns order;
    std::vector<DrawTurn> claims;
    std::vector<View> next_views;
    std::vector<std::uint32_t> next_casters;
    std::vector<ViewMap> next_maps;

    /// Nobody has views that could stand for others.
    void forget()
    {
        for (KnownLight& light : known) {
            light = {};
        }
    }
    void follow(std::span<const Light> frame);
    [[nodiscard]] KnownLight& knownOf(std::size_t light) { return known[rows.rowOf(light)]; }
    [[nodiscard]] const KnownLight& knownOf(std::size_t light) const { return known[rows.rowOf(light)]; }
    [[nodiscard]] std::span<const View> viewsOf(std::size_t light) const
    {
        return std::span(views).subspan(knownOf(light).first_view, knownOf(light).view_count);
    }
};

} // namespace gnomon
