// SPDX-License-Identifier: Apache-2.0
#include "plan/places.h"

#include <algorithm>
#include <bit>

namespace gnomon {
namespace {

/// Side of a page in what squares are measured by, whatever its texels: halved it is a whole number still.
constexpr std::uint32_t kPageSide = 1U << 15U;

std::uint32_t squareSide(const PageSquares& squares, std::uint32_t map_side)
{
    return kPageSide >> squares.levelOf(map_side);
}

double squareArea(const PageSquares& squares, const MapWish& wish)
{
    const double side = squareSide(squares, wish.side);
    return side * side * wish.squares();
}

double areaOf(const PageSquares& squares)
{
    return static_cast<double>(kPageSide) * kPageSide * squares.mostPages();
}

void addPages(const std::vector<Setup>& setups, MapStore& store)
{
    for (const Setup& setup : setups) {
        const std::uint64_t side = setup.recipe.resolved.largest_side();
        const std::uint64_t budget = setup.recipe.options().budget_texels;
        const std::uint64_t most = setup.recipe.options().max_layers;
        store.addPages(static_cast<std::uint32_t>(side),
                       static_cast<std::uint32_t>(budget == 0 ? most : std::min(most, budget / (side * side))));
    }
}

} // namespace

Places::Places(const std::vector<Setup>& setups)
{
    addPages(setups, store_);
}

void Places::renew(const std::vector<Setup>& setups)
{
    MapStore fresh;
    addPages(setups, fresh);
    store_ = std::move(fresh);
}

bool Places::hasRoom(const Frustums& frustums, std::uint32_t light, const Recipe& recipe) const
{
    const std::uint32_t end = frustums.endTenant(light);
    for (std::uint32_t tenant = frustums.firstTenant(light); tenant < end; ++tenant) {
        if (!store_.hasRoom(tenant)) {
            return false;
        }
    }
    return recipe.grows() || recipe.hasPages() || frustums.firstTenant(light) < end;
}

void Places::furnish(Sights& sights, Frustums& frustums)
{
    const std::size_t options_count = sights.setups().size();
    store_.follow(*sights.frame().objects, frustums.keys());
    wished_sides_.clear();
    wished_texels_.assign(options_count, 0);
    square_areas_.assign(options_count, 0.0);
    for (const MapWish& wish : frustums.wishes()) {
        wished_sides_.push_back(wish.side);
        if (wish.count > 0) {
            wished_texels_[wish.options] += std::uint64_t{wish.side} * wish.side * wish.squares();
            square_areas_[wish.options] += squareArea(store_.squaresOf(wish.options), wish);
        }
    }
    for (std::uint32_t options = 0; options < options_count; ++options) {
        if (square_areas_[options] > areaOf(store_.squaresOf(options))) {
            shrink(sights, frustums, options);
        }
    }
    store_.furnish(frustums.wishes());
}

void Places::shrink(Sights& sights, Frustums& frustums, std::uint32_t options)
{
    const LightShares& shares = sights.findShares(options);
    claims_.clear();
    claimants_.clear();
    for (std::uint32_t light = 0; light < sights.frame().lights.size(); ++light) {
        if (sights.frame().lights[light].options == options) {
            claimFor(light, shares.shareOf(light), frustums);
        }
    }
    shares_.share(claims_, areaOf(store_.squaresOf(options)));
    for (std::size_t i = 0; i < claims_.size(); ++i) {
        MapWish& wish = frustums.wishes()[claimants_[i]];
        wish.side = std::max(wish.side / (claims_[i].largest / claims_[i].side), 1U);
    }
}

/// A light's claim for texels, shared among its frustums by the errors that they were made for.
void Places::claimFor(std::uint32_t light, double share, const Frustums& frustums)
{
    for (std::uint32_t tenant = frustums.firstTenant(light); tenant < frustums.endTenant(light); ++tenant) {
        const MapWish& wish = frustums.wishes()[tenant];
        if (wish.count == 0) {
            continue;
        }
        TexelClaim& claim = claims_.emplace_back();
        claimants_.push_back(tenant);
        claim.weight = frustums.worthOf(light, tenant) * share;
        claim.maps = wish.squares();
        const PageSquares& squares = store_.squaresOf(wish.options);
        claim.largest = squareSide(squares, wish.side);
        claim.smallest = squareSide(squares, std::min(kSmallestMap, wish.side));
        claim.wanted = claim.largest;
        const MapWish& before = store_.wishBefore(tenant);
        claim.before =
            before.options == wish.options && before.count == wish.count ? squareSide(squares, before.side) : 0;
    }
}

void Places::report(const Frustums& frustums, Plan& plan) const
{
    store_.report(plan);
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        plan.pages[i].wanted_texels = wished_texels_[i];
    }
    for (std::uint32_t light = 0; light < plan.lights.size(); ++light) {
        for (std::uint32_t tenant = frustums.firstTenant(light); tenant < frustums.endTenant(light); ++tenant) {
            if (store_.hasRoom(tenant)) {
                const std::uint32_t times = wished_sides_[tenant] / store_.sideOf(tenant);
                plan.lights[light].halved =
                    std::max(plan.lights[light].halved, static_cast<std::uint32_t>(std::bit_width(times)) - 1);
            }
        }
    }
}

} // namespace gnomon
