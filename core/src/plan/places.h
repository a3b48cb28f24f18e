// SPDX-License-Identifier: Apache-2.0
// The third step of a plan: where each frustum's maps lie, and how lights share what room there is. When they want more
// texels than their budget has, those get smaller maps that the picture owes least to. None is left out for that.
#pragma once

#include "plan/frustums.h"
#include "store/map_store.h"
#include "store/texel_shares.h"

#include <vector>

namespace gnomon {

class Places {
public:
    explicit Places(const std::vector<Setup>& setups);
    void furnish(Sights& sights, Frustums& frustums);
    /// How much smaller maps are than they were wanted, and the pages that all of them have.
    void report(const Frustums& frustums, Plan& plan) const;
    /// Forgets all maps: after a plan that ended half way nobody knows what they hold.
    void renew(const std::vector<Setup>& setups);

    [[nodiscard]] MapStore& store() { return store_; }
    [[nodiscard]] const MapStore& store() const { return store_; }
    /// All of what a light wants has room, or nothing is drawn of it.
    [[nodiscard]] bool hasRoom(const Frustums& frustums, std::uint32_t light, const Recipe& recipe) const;

private:
    void shrink(Sights& sights, Frustums& frustums, std::uint32_t options);
    void claimFor(std::uint32_t light, double share, const Frustums& frustums);

    MapStore store_;
    std::vector<std::uint32_t> wished_sides_;  // by tenant, before they share what room there is
    std::vector<std::uint64_t> wished_texels_; // by options
    // Scratch.
    std::vector<double> square_areas_; // by options, of the squares that hold what is wished
    TexelShares shares_;
    std::vector<TexelClaim> claims_;
    std::vector<std::uint32_t> claimants_; // tenants
};

} // namespace gnomon
