// SPDX-License-Identifier: Apache-2.0
// The fifth step of a plan: which maps still hold what they should, what is drawn, and who waits. Where a frame may not
// draw all that is out of date, lights take turns, and cascades of a light do with CascadeOptions::room. A light or
// cascade that waits keeps the views of the plan before.
//
// Most turns are taken when all is fitted, because only then is it known how much there is to draw. A light that
// `multi` would divide otherwise would lose its squares meanwhile, so its turn is taken before furnishing, by an upper
// bound.
#pragma once

#include "cascade_turns.h"
#include "plan/places.h"
#include "plan/view_map.h"
#include "store/draw_turns.h"
#include "store/light_rows.h"

#include <span>
#include <vector>

namespace gnomon {

/// The camera's view with room around its picture.
struct WideSight {
    bool looked = false; // in this frame
    Frame frame;
    CameraView camera;
    std::vector<std::uint32_t> receivers;
};

/// The view for which the map of a cascade is planned that may wait by itself.
struct WideTurn {
    Outcome outcome; // not ok: it needs no map
    const WideSight* seen = nullptr;
    ViewGround* ground = nullptr; // to be filled in
    bool may_wait = false;        // the view that it had shows all that is seen
};

class Schedule {
public:
    explicit Schedule(const std::vector<Setup>& setups);
    /// Takes the views of the plan before out of the plan.
    void begin(Plan& plan);
    /// Takes the turns of lights that `multi` would divide otherwise. Those that wait are divided as before.
    void foresee(Sights& sights, Frustums& frustums, const Places& places, const Plan& plan);
    /// Maps that others need room of, or that have another size now, hold nothing that could be kept.
    void keepRoom(const Frustums& frustums, const Places& places);
    /// Takes all other turns, and says in the plan what is drawn of each map.
    void take(const Sights& sights, Frustums& frustums, Places& places, std::vector<ViewMap>& maps, Plan& plan);
    /// Sums up in the plan what is drawn, and how long others wait.
    static void report(Plan& plan);
    /// Nobody has views that could stand for others.
    void forget();

    // For Views:

    [[nodiscard]] bool isKeptBack(std::uint32_t light) const { return takes_turns_ && lights_[light].kept_back; }
    /// It may wait without the other cascades of its light. The first one may not: it is drawn in each frame.
    [[nodiscard]] bool hasOwnTurn(const LightPosition& position, const Slice& slice) const;
    [[nodiscard]] WideTurn wideTurn(const Sights& sights, const Places& places, const LightPosition& position,
                                    const LightFrustum& frustum);

private:
    /// A light in one frame.
    struct Turn {
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
    struct LightBefore {
        LightType type = LightType::directional;
        std::uint32_t options = 0;
        std::uint32_t map_size = 0;
        std::uint32_t first_view = 0; // index into views_
        std::uint32_t view_count = 0; // 0: it had none, or does not take turns
        std::uint32_t waited = 0;
        std::uint64_t texels = 0; // that had to be drawn for it, or were thought to
        Outcome outcome;
    };
    /// The results of the steps before.
    struct Results {
        const Sights& sights;
        Frustums& frustums;
        MapStore& store;
        std::vector<ViewMap>& maps;
        Plan& plan;
    };

    void follow(std::span<const Light> frame);
    [[nodiscard]] LightBefore& lightBefore(std::size_t light) { return before_[rows_.rowOf(light)]; }
    [[nodiscard]] const LightBefore& lightBefore(std::size_t light) const { return before_[rows_.rowOf(light)]; }
    /// The light's views in the plan before.
    [[nodiscard]] std::span<const View> viewsOf(std::size_t light) const
    {
        return std::span(views_).subspan(lightBefore(light).first_view, lightBefore(light).view_count);
    }
    void foreseeOf(Sights& sights, Frustums& frustums, const MapStore& store, const Plan& plan, std::uint32_t options);
    [[nodiscard]] bool isAsBefore(const Sights& sights, std::uint32_t light) const;
    void takeOf(const Results& results, std::uint32_t options);
    [[nodiscard]] static std::uint64_t texelsDue(const Results& results, std::uint32_t view);
    void putViewsBack(const Results& results);
    void addBack(const Frame& frame, View view, std::span<const std::uint32_t> casters, const ViewMap& map);
    void note(const Results& results);
    static void draw(const Results& results);
    // schedule_cascades.cpp
    [[nodiscard]] const View* viewBefore(const MapStore& store, std::uint32_t light, const MapId& map) const;
    WideSight& lookWide(const Sights& sights, std::uint32_t options);
    void claimByCascade(const Results& results, std::uint32_t light);
    void noteGrounds(const Results& results);

    bool takes_turns_ = false; // some lights: their options bound what is drawn in a frame
    LightRows rows_;
    std::vector<LightBefore> before_; // by row
    std::vector<View> views_;         // views of the plan before
    std::vector<std::uint32_t> casters_;
    std::uint64_t objects_ = 0;   // ObjectSet::identity()
    std::vector<Turn> lights_;    // the frame's lights
    std::vector<WideSight> wide_; // by options
    // By MapId::index, of cascades that take turns by themselves: what a map was planned for, and what it would be now.
    std::vector<ViewGround> grounds_;
    std::vector<ViewGround> next_grounds_;
    // Scratch.
    std::vector<std::uint64_t> keys_;
    Region seen_; // the part that a cascade sees, without room
    DrawTurns order_;
    std::vector<DrawTurn> claims_;
    std::vector<View> next_views_;
    std::vector<std::uint32_t> next_casters_;
    std::vector<ViewMap> next_maps_;
};

} // namespace gnomon
