// SPDX-License-Identifier: Apache-2.0
// What a planner keeps, and its steps: those of all lights together are in planner.cpp, how they share what room there
// is in planner_room.cpp, whose turn it is to be drawn in planner_turns.cpp, cascades that take turns by themselves in
// planner_cascades.cpp, and those of one light in planner_light.cpp.
#pragma once

#include "auto/auto_choice.h"
#include "camera_view.h"
#include "frame_memory.h"
#include "frustum_planner.h"
#include "light_shares.h"
#include "light_turns.h"
#include "motion/sun_steps.h"
#include "partition/multi.h"
#include "recipe.h"
#include "scene_memory.h"
#include "soften/moved_boxes.h"
#include "store/map_store.h"

#include <gnomon/object_ids.h>
#include <gnomon/planner.h>

#include <optional>
#include <span>
#include <vector>

namespace gnomon {

/// One of a planner's options, and what the camera sees that they count for.
struct Setup {
    explicit Setup(const ShadowOptions& options) : recipe(options) {}

    Recipe recipe;
    bool looked = false; // in this frame
    CameraView camera;
    std::vector<std::uint32_t> receivers;
    bool sighted = false; // `sight` is of this frame: where the recipe predicts, or lights share what room there is
    Sight sight;
    std::vector<WorldLayer> layers; // with layers of the world: this frame's
    /// Where cascades take turns by themselves: the frame with room around its picture, and what is seen so.
    struct Wide {
        bool looked = false; // in this frame
        Frame frame;
        CameraView camera;
        std::vector<std::uint32_t> receivers;
    } wide;
};

/// One position that a light shines from.
struct Stand {
    std::uint32_t light = 0; // index into Frame::lights
    Light at;                // the light, shining from there
    SunPosition sun = SunPosition::only;
    std::uint32_t slot = 0; // which of its light's maps it has
    bool read = true;       // in this frame
};

/// One of the slices of a light, and what is known of it before it is planned.
struct PlannedSlice {
    Slice slice;
    std::span<const std::uint32_t> receivers;
    double strength = 1.0;     // of the warp, with fit auto
    std::uint32_t tenant = 0;  // whose maps it has
    std::uint32_t frustum = 0; // which of them
};

struct Planner::Impl {
    /// Without any options it has the default ones, and `unusable` says why nobody plans by them.
    explicit Impl(std::span<const ShadowOptions> options, Outcome why_unusable = {});

    std::vector<Setup> setups; // at least one
    Outcome unusable;          // not ok: no light has a map, in any frame
    Outcome fault;             // not ok: no light has a map in this frame
    bool some_nowhere = false; // objects of this frame
    MapStore store;
    SunCourses suns;
    SunCourses suns_before; // as they were before this frame
    AutoChooser chooser;
    MultiPartition multi;
    std::uint64_t frames = 0; // planned so far: whose turn it is
    bool spoilt = false;      // a plan ended half way, because something threw
    MovedBoxes moved;
    bool takes_turns = false; // some lights: their options bound what is drawn in a frame
    LightTurns turns;
    SceneMemory scene;
    std::uint64_t converging = 0; // frames since the last cut: which sample is this frame's

    Plan plan;
    FrameMemory told;         // that `plan` was made from
    bool camera_moves = true; // since the frame before
    bool settled = false;     // and that it would be made from again: nothing in it was to be drawn or fading

    // Scratch.
    std::vector<Light> lights; // this frame's, with their near distances
    std::vector<std::uint32_t> near_casters;
    FrustumPlanner frustums;
    std::vector<Slice> slices;
    std::vector<PlannedSlice> planned_slices;
    /// Of the store's tenants: a light, or of partition multi each of its frustums, after each other.
    std::vector<std::uint64_t> keys;
    std::vector<MapWish> wishes;
    std::vector<MapWish> own_wishes;          // by light, of those that `multi` does not divide
    std::vector<ViewMap> view_maps;           // by view
    std::vector<std::uint32_t> first_tenants; // by light, and one past the last
    std::vector<std::uint32_t> wished_sides;  // by tenant, before they share what room there is
    std::vector<std::uint64_t> wished_texels; // by options
    std::vector<double> square_areas;         // of the squares that hold them
    LightShares light_shares;
    TexelShares texel_shares;
    std::vector<TexelClaim> claims;
    std::vector<std::uint32_t> claimants; // tenants
    /// Of what the camera sees, what is in the reach of each light that has one, light after light.
    std::vector<std::uint32_t> in_reach;
    std::vector<std::uint32_t> reach_ends; // where each light's end
    std::vector<Plane> planes;
    std::vector<std::uint32_t> all_receivers; // of the scene, where a steady map measures level depth
    std::vector<std::uint32_t> merged;

    void addPages(MapStore& to) const;
    [[nodiscard]] bool repeats(const Frame& frame) const;
    void repeatPlan(const Frame& frame);
    void makePlan(const Frame& frame);
    void setNearDistances(Frame& frame);
    void begin(const Frame& frame);
    void noteMovement(const Frame& frame);
    void look(const Frame& frame, Setup& setup);
    void listReceivers(const Frame& frame);
    void admit(const Frame& frame);
    [[nodiscard]] Outcome layer(const Frame& frame, Setup& setup);
    void listInReach(const Frame& frame, const Light& light);
    [[nodiscard]] std::span<const std::uint32_t> receiversOf(std::uint32_t index, const Light& light) const;
    MapWish decide(const Frame& frame, std::uint32_t index);
    void divide(const Frame& frame, std::uint32_t index);
    void listTenants(const Frame& frame);
    [[nodiscard]] MapWish wishOf(const Light& light, const GrownFrustum& frustum) const;
    void shareRoom(const Frame& frame);
    void findShares(const Frame& frame, std::uint32_t options);
    void shrinkWishes(const Frame& frame, std::uint32_t options);
    void claimFor(std::uint32_t light);
    void reportRoom();
    void foreseeTurns(const Frame& frame);
    void foreseeTurns(const Frame& frame, std::uint32_t options);
    [[nodiscard]] bool canKeepViews(std::uint32_t index) const;
    [[nodiscard]] std::uint64_t texelsWanted(const Light& light, std::uint32_t index) const;
    void keepRoomOfTurns();
    [[nodiscard]] bool isKeptBack(std::uint32_t index) const;
    [[nodiscard]] std::uint64_t texelsDue(const Frame& frame, std::uint32_t index);
    [[nodiscard]] std::uint64_t texelsDueOf(const Frame& frame, std::uint32_t view);
    [[nodiscard]] bool isAsBefore(const Frame& frame, std::uint32_t index) const;
    [[nodiscard]] bool turnsByCascade(const Light& light) const;
    static void lookWide(const Frame& frame, Setup& setup);
    [[nodiscard]] const View* viewBefore(std::uint32_t light, const MapId& map) const;
    [[nodiscard]] bool hasOwnTurn(const Stand& stand, const Slice& slice) const;
    Outcome planWideSlice(const Frame& frame, const Stand& stand, Setup& setup, const PlannedSlice& slice);
    void claimByCascade(const Frame& frame, std::uint32_t index);
    void noteGrounds();
    [[nodiscard]] static std::uint64_t drawBudget(const Frame& frame, const ShadowOptions& options);
    void takeTurns(const Frame& frame);
    void takeTurns(const Frame& frame, std::uint32_t options);
    void putViewsBack(const Frame& frame);
    void noteTurns(const Frame& frame);
    void drawViews(const Frame& frame);
    Outcome handOut(const Frame& frame, std::uint32_t index);
    IdScratch id_scratch;
    std::vector<bool> shares_bounds; // by object: Plan::object_bounds has more than its own
    [[nodiscard]] std::uint64_t idsKey(const View& view) const;
    void planLight(const Frame& frame, std::uint32_t index);
    [[nodiscard]] bool hasRoom(std::uint32_t index, const Setup& setup) const;
    Outcome prospect(const Frame& frame, std::uint32_t index, const Setup& setup) const;
    std::uint32_t followSun(const Frame& frame, const Recipe& recipe, const Light& light, SunSteps& steps);
    [[nodiscard]] LightSample sampleAt(const Frame& frame, std::uint32_t index) const;
    Outcome planStands(const Frame& frame, std::uint32_t index, std::uint32_t earlier_slot);
    void planStand(const Frame& frame, const Stand& stand, std::optional<Outcome>& best);
    void listSlices(const Frame& frame, const Stand& stand, const Setup& setup);
    const PartitionTraits& partitionOf(const Setup& setup, const Stand& stand);
    Outcome planSlice(const Frame& frame, const Stand& stand, Setup& setup, const PlannedSlice& slice);
    void addView(const Stand& stand, const MapPlace& place, const View& planned);
    void planVolumes(const Frame& frame, std::uint32_t index);
    Outcome listVolumes(const Frame& frame, std::uint32_t index);
};

} // namespace gnomon
