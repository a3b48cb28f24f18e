// SPDX-License-Identifier: Apache-2.0
// The second step of a plan: how each light is divided among frustums, and what maps they want. One table has them all,
// whatever divided them.
#pragma once

#include "auto/auto_choice.h"
#include "partition/multi.h"
#include "partition/virtual.h"
#include "plan/sights.h"
#include "store/map_store.h"

#include <span>
#include <vector>

namespace gnomon {

/// A row of the table.
struct LightFrustum {
    Slice slice;
    std::span<const std::uint32_t> receivers;
    double strength = 1.0;          // strength of the warp, with fit auto
    std::uint32_t tenant = 0;       // whose maps it has: index of Frustums::keys()
    std::uint32_t number = 0;       // which of them
    std::uint32_t wanted_side = 0;  // texels for which slice.texel counts; 0: for as many as the map gets
    std::uint32_t gpu_cascades = 0; // number of cascades that the GPU fits to parts of this map; 0: it is fitted here
    const VirtualPage* page = nullptr; // null: it is no page
};

/// One position that a light shines from, and its frustums.
struct LightPosition {
    std::uint32_t light = 0; // index into Frame::lights
    Light at;                // the light, shining from there
    SunPosition sun = SunPosition::only;
    std::uint32_t slot = 0; // which of its light's maps it has
    bool read = true;       // in this frame
    std::uint32_t first_frustum = 0;
    std::uint32_t frustum_count = 0;
};

class Frustums {
public:
    /// Finds what lights want that may have maps, and says in the plan what was chosen for them.
    void divide(const Sights& sights, std::uint32_t rested, Plan& plan);
    /// It is divided otherwise than in the frame before. Then it may have to wait (Schedule::foresee()).
    [[nodiscard]] bool differs(std::uint32_t light) const { return multi_.differs(light); }
    /// It is divided as in the frame before.
    void keepDivision(const Sights& sights, std::uint32_t light);
    /// It waits: the next frame goes on from the frame before.
    void keepMemory(std::uint32_t light) { multi_.restoreMemory(light); }
    /// The texels of all the maps that a light wants.
    [[nodiscard]] std::uint64_t texelsWanted(const Sights& sights, std::uint32_t light) const;
    /// ok, or why a light of partition virtual has no pages.
    [[nodiscard]] const Outcome& outcomeOf(std::uint32_t light) const { return virtual_.outcomeOf(light); }
    [[nodiscard]] const VirtualPartition& pages() const { return virtual_; }
    /// Fills the table.
    void list(const Sights& sights, const Plan& plan);
    /// Nothing is known of the frame before.
    void forget();

    // The table, until the next frame.

    /// Whose maps they are: a light, or of partition multi each of its frustums, after each other.
    [[nodiscard]] std::span<const std::uint64_t> keys() const { return keys_; }
    /// By tenant.
    [[nodiscard]] std::span<MapWish> wishes() { return wishes_; }
    [[nodiscard]] std::span<const MapWish> wishes() const { return wishes_; }
    /// A light's tenants are from the one to before the other.
    [[nodiscard]] std::uint32_t firstTenant(std::uint32_t light) const { return first_tenants_[light]; }
    [[nodiscard]] std::uint32_t endTenant(std::uint32_t light) const { return first_tenants_[light + 1]; }
    /// The tenant's share of the light's claim to texels: 0 .. 1.
    [[nodiscard]] double worthOf(std::uint32_t light, std::uint32_t tenant) const;
    /// None of a light that cannot have any.
    [[nodiscard]] std::span<const LightPosition> positionsOf(std::uint32_t light) const;
    [[nodiscard]] std::span<const LightFrustum> of(const LightPosition& position) const
    {
        return std::span(frustums_).subspan(position.first_frustum, position.frustum_count);
    }

private:
    [[nodiscard]] static MultiPartition::Input inputOf(const Sights& sights, std::uint32_t index, const Light& light);
    [[nodiscard]] MapWish decide(const Sights& sights, std::uint32_t index, LightPlan& planned);
    [[nodiscard]] MapWish wishOf(const Sights& sights, const Light& light, const GrownFrustum& frustum) const;
    void listTenants(const Sights& sights);
    void addPositions(const Sights& sights, std::uint32_t index, const SunSteps& steps);
    void addGrown(const LightPosition& position);
    void addPages(const LightPosition& position);
    void addDivided(const Sights& sights, const LightPosition& position);
    void addSegments(const Sights& sights, const LightPosition& position, std::uint32_t count);

    AutoChooser chooser_;
    MultiPartition multi_;
    VirtualPartition virtual_;
    std::vector<MapWish> own_wishes_; // by light, of those that neither of both divides
    std::vector<std::uint64_t> keys_;
    std::vector<MapWish> wishes_;
    std::vector<std::uint32_t> first_tenants_;   // by light, and one past the last
    std::vector<std::uint32_t> first_positions_; // by light, and one past the last
    std::vector<LightPosition> positions_;
    std::vector<LightFrustum> frustums_;
    // Scratch.
    FrustumPlanner planner_;
    std::vector<Slice> slices_;
};

} // namespace gnomon
