// SPDX-License-Identifier: Apache-2.0
// Which maps the lights of a frame want, and how they share what room there is: when they want more texels than their
// budget has, those get smaller maps that the picture owes least to. None is left out for that.
#include "planner_impl.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

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

/// Of a light's own maps, or of one of its frustums.
std::uint64_t tenantKey(const Light& light, std::uint32_t frustum)
{
    return std::uint64_t{light.key} << 32U | frustum;
}

} // namespace

/// Each frustum is a tenant of its own, so that the others keep their maps when one comes, goes or is sized anew.
void Planner::Impl::listTenants(const Frame& frame)
{
    keys.clear();
    wishes.clear();
    first_tenants.clear();
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        const Light& light = frame.lights[index];
        first_tenants.push_back(static_cast<std::uint32_t>(keys.size()));
        if (own_wishes[index].count > 0) {
            keys.push_back(tenantKey(light, 0));
            wishes.push_back(own_wishes[index]);
        }
        for (const GrownFrustum& frustum : multi.frustumsOf(index)) {
            keys.push_back(tenantKey(light, frustum.id));
            wishes.push_back(wishOf(light, frustum));
        }
    }
    first_tenants.push_back(static_cast<std::uint32_t>(keys.size()));
}

MapWish Planner::Impl::wishOf(const Light& light, const GrownFrustum& frustum) const
{
    const Recipe& recipe = setups[light.options].recipe;
    MapWish wish = recipe.wishOf(light, light.options, *recipe.partition, 0);
    wish.side = frustum.side;
    return wish;
}

void Planner::Impl::shareRoom(const Frame& frame)
{
    wished_sides.clear();
    wished_texels.assign(setups.size(), 0);
    square_areas.assign(setups.size(), 0.0);
    for (const MapWish& wish : wishes) {
        wished_sides.push_back(wish.side);
        if (wish.count > 0) {
            wished_texels[wish.options] += std::uint64_t{wish.side} * wish.side * wish.squares();
            square_areas[wish.options] += squareArea(store.squaresOf(wish.options), wish);
        }
    }
    for (std::uint32_t options = 0; options < setups.size(); ++options) {
        if (square_areas[options] > areaOf(store.squaresOf(options))) {
            shrinkWishes(frame, options);
        }
    }
    store.furnish(wishes);
}

void Planner::Impl::shrinkWishes(const Frame& frame, std::uint32_t options)
{
    findShares(frame, options);
    claims.clear();
    claimants.clear();
    for (std::uint32_t light = 0; light < frame.lights.size(); ++light) {
        if (frame.lights[light].options == options) {
            claimFor(light);
        }
    }
    texel_shares.share(claims, areaOf(store.squaresOf(options)));
    for (std::size_t i = 0; i < claims.size(); ++i) {
        MapWish& wish = wishes[claimants[i]];
        wish.side = std::max(wish.side / (claims[i].largest / claims[i].side), 1U);
    }
}

/// What the picture owes to each light, by what is seen with one of the options.
void Planner::Impl::findShares(const Frame& frame, std::uint32_t options)
{
    Setup& setup = setups[options];
    const bool sees = setup.camera.outcome.kind == OutcomeKind::ok && !setup.receivers.empty();
    if (sees && !setup.sighted) {
        setup.sight.look(frame, setup.camera, setup.receivers);
        setup.sighted = true;
    }
    light_shares.find(frame.lights, setup.camera, sees ? setup.sight.points() : std::span<const SightPoint>());
}

/// What a light's maps claim. Frustums that it was divided among share what it is worth by what they err.
void Planner::Impl::claimFor(std::uint32_t light)
{
    const std::span<const GrownFrustum> grown = multi.frustumsOf(light);
    double sum = 0.0;
    for (const GrownFrustum& frustum : grown) {
        sum += frustum.sum;
    }
    for (std::uint32_t tenant = first_tenants[light]; tenant < first_tenants[light + 1]; ++tenant) {
        const MapWish& wish = wishes[tenant];
        if (wish.count == 0) {
            continue;
        }
        const double part = sum > 0.0 ? grown[tenant - first_tenants[light]].sum / sum : 1.0;
        TexelClaim& claim = claims.emplace_back();
        claimants.push_back(tenant);
        claim.weight = part * light_shares.shareOf(light);
        claim.maps = wish.squares();
        const PageSquares& squares = store.squaresOf(wish.options);
        claim.largest = squareSide(squares, wish.side);
        claim.smallest = squareSide(squares, std::min(kSmallestMap, wish.side));
        claim.wanted = claim.largest;
        const MapWish& before = store.wishBefore(tenant);
        claim.before =
            before.options == wish.options && before.count == wish.count ? squareSide(squares, before.side) : 0;
    }
}

/// Of each light, how much smaller its maps are than it wanted them; of all, what is drawn and who waits.
void Planner::Impl::reportRoom()
{
    store.report(plan);
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        plan.pages[i].wanted_texels = wished_texels[i];
    }
    for (const View& view : plan.views) {
        MapPages& pages = plan.pages[plan.lights[view.light].options];
        pages.drawn_texels += texelsToDraw(view);
        pages.waiting_maps += view.waited > 0 ? 1 : 0;
    }
    for (std::uint32_t light = 0; light < plan.lights.size(); ++light) {
        MapPages& pages = plan.pages[plan.lights[light].options];
        pages.waiting_lights += plan.lights[light].waited > 0 ? 1 : 0;
        pages.longest_wait = std::max(pages.longest_wait, plan.lights[light].waited);
        for (std::uint32_t tenant = first_tenants[light]; tenant < first_tenants[light + 1]; ++tenant) {
            if (store.hasRoom(tenant)) {
                const std::uint32_t times = wished_sides[tenant] / store.sideOf(tenant);
                plan.lights[light].halved =
                    std::max(plan.lights[light].halved, static_cast<std::uint32_t>(std::bit_width(times)) - 1);
            }
        }
    }
}

} // namespace gnomon
