// SPDX-License-Identifier: Apache-2.0
#include "plan/frustums.h"

#include <algorithm>

namespace gnomon {
namespace {

/// The key of a light's own maps, or of those of one of its frustums.
std::uint64_t tenantKey(const Light& light, std::uint32_t frustum)
{
    return std::uint64_t{light.key} << 32U | frustum;
}

std::uint64_t texelsOf(const MapWish& wish)
{
    return std::uint64_t{wish.side} * wish.side * wish.count * wish.positions * (wish.keeps_still ? 2 : 1);
}

} // namespace

void Frustums::forget()
{
    chooser_ = {};
    multi_ = {};
    virtual_ = {};
}

void Frustums::divide(const Sights& sights, std::uint32_t rested, Plan& plan)
{
    const Frame& frame = sights.frame();
    own_wishes_.assign(frame.lights.size(), {});
    chooser_.follow(frame.lights);
    multi_.follow(frame.lights);
    virtual_.follow(frame.lights);
    for (std::uint32_t index = 0; index < frame.lights.size(); ++index) {
        LightPlan& planned = plan.lights[index];
        const Setup& setup = sights.setups()[planned.options];
        if (planned.outcome.kind != OutcomeKind::ok || !setup.recipe.hasMaps()) {
            continue;
        }
        if (setup.recipe.hasPages()) {
            if (setup.sees()) {
                virtual_.divide({frame, setup.recipe, setup.camera, sights.receiversOf(index), setup.sight,
                                 frame.lights[index], rested},
                                index);
            }
        } else if (!setup.recipe.grows()) {
            own_wishes_[index] = decide(sights, index, planned);
        } else if (setup.sees()) {
            // From where its maps are drawn.
            const Light light = sampledLight(frame.lights[index], sights.lights()[index].sample);
            multi_.divide(inputOf(sights, index, light), index, planner_);
        }
    }
}

void Frustums::keepDivision(const Sights& sights, std::uint32_t light)
{
    multi_.restoreFrustums(inputOf(sights, light, sights.frame().lights[light]), light);
}

MultiPartition::Input Frustums::inputOf(const Sights& sights, std::uint32_t index, const Light& light)
{
    const Setup& setup = sights.setups()[light.options];
    return {sights.frame(), setup.recipe, setup.camera, sights.receiversOf(index), setup.sight, light};
}

/// The maps of a light, by its options or by what is predicted of it.
MapWish Frustums::decide(const Sights& sights, std::uint32_t index, LightPlan& planned)
{
    const Light& light = sights.frame().lights[index];
    const Setup& setup = sights.setups()[light.options];
    const Recipe& recipe = setup.recipe;
    if (!recipe.predicts()) {
        return recipe.wishOf(light, light.options, *recipe.partition, 0);
    }
    if (setup.sees()) {
        const std::span receivers = sights.receiversOf(index);
        const Slice none;
        planned.choice = chooser_
                             .decide({sights.frame(), recipe, setup.camera, receivers, receivers, light, none},
                                     setup.sight, index, planner_)
                             .told;
    }
    const AutoDecision& decision = chooser_.decisionOf(recipe, index);
    return recipe.wishOf(light, light.options, *decision.partition, decision.told.halvings);
}

MapWish Frustums::wishOf(const Sights& sights, const Light& light, const GrownFrustum& frustum) const
{
    const Recipe& recipe = sights.setups()[light.options].recipe;
    MapWish wish = recipe.wishOf(light, light.options, *recipe.partition, 0);
    wish.side = frustum.side;
    return wish;
}

std::uint64_t Frustums::texelsWanted(const Sights& sights, std::uint32_t light) const
{
    std::uint64_t texels = texelsOf(own_wishes_[light]);
    for (const GrownFrustum& frustum : multi_.frustumsOf(light)) {
        texels += texelsOf(wishOf(sights, sights.frame().lights[light], frustum));
    }
    return texels;
}

void Frustums::list(const Sights& sights, const Plan& plan)
{
    listTenants(sights);
    positions_.clear();
    frustums_.clear();
    first_positions_.clear();
    for (std::uint32_t index = 0; index < plan.lights.size(); ++index) {
        const LightPlan& planned = plan.lights[index];
        const Setup& setup = sights.setups()[planned.options];
        first_positions_.push_back(static_cast<std::uint32_t>(positions_.size()));
        if (planned.outcome.kind == OutcomeKind::ok && setup.recipe.hasMaps() && setup.sees()) {
            addPositions(sights, index, planned.steps);
        }
    }
    first_positions_.push_back(static_cast<std::uint32_t>(positions_.size()));
}

/// Each frustum of `multi` is a tenant of its own, so that the others keep their maps when one comes, goes or is sized
/// anew.
void Frustums::listTenants(const Sights& sights)
{
    keys_.clear();
    wishes_.clear();
    first_tenants_.clear();
    const std::span lights = sights.frame().lights;
    for (std::uint32_t index = 0; index < lights.size(); ++index) {
        first_tenants_.push_back(static_cast<std::uint32_t>(keys_.size()));
        if (own_wishes_[index].count > 0) {
            keys_.push_back(tenantKey(lights[index], 0));
            wishes_.push_back(own_wishes_[index]);
        }
        for (const GrownFrustum& frustum : multi_.frustumsOf(index)) {
            keys_.push_back(tenantKey(lights[index], frustum.id));
            wishes_.push_back(wishOf(sights, lights[index], frustum));
        }
        for (const VirtualPage& page : virtual_.pagesOf(index)) {
            const Recipe& recipe = sights.setups()[lights[index].options].recipe;
            keys_.push_back(tenantKey(lights[index], page.id));
            wishes_.push_back(recipe.wishOf(lights[index], lights[index].options, *recipe.partition, 0));
            wishes_.back().side = virtual_.sideOf(index);
        }
    }
    first_tenants_.push_back(static_cast<std::uint32_t>(keys_.size()));
}

double Frustums::worthOf(std::uint32_t light, std::uint32_t tenant) const
{
    const std::span<const GrownFrustum> grown = multi_.frustumsOf(light);
    double sum = 0.0;
    for (const GrownFrustum& frustum : grown) {
        sum += frustum.sum;
    }
    return sum > 0.0 ? grown[tenant - first_tenants_[light]].sum / sum : 1.0;
}

std::span<const LightPosition> Frustums::positionsOf(std::uint32_t light) const
{
    return std::span(positions_)
        .subspan(first_positions_[light], first_positions_[light + 1] - first_positions_[light]);
}

/// A position keeps its slot, that is its maps, for as long as the sun has it.
void Frustums::addPositions(const Sights& sights, std::uint32_t index, const SunSteps& steps)
{
    const Light& light = sights.frame().lights[index];
    const LightSight& sight = sights.lights()[index];
    const Recipe& recipe = sights.setups()[light.options].recipe;
    for (const bool later : {false, true}) {
        if (later && !steps.paired) {
            break;
        }
        LightPosition position;
        position.light = index;
        position.at = light;
        if (steps.stepping) {
            position.at.direction_ws = later ? steps.later_ws : steps.earlier_ws;
        }
        position.at = sampledLight(position.at, sight.sample);
        if (steps.paired) {
            position.sun = later ? SunPosition::later : SunPosition::earlier;
        }
        position.read = !steps.alternate || position.sun == steps.read;
        if (recipe.pairs(light)) {
            position.slot = later ? 1 - sight.earlier_slot : sight.earlier_slot;
        }
        position.first_frustum = static_cast<std::uint32_t>(frustums_.size());
        if (recipe.hasPages()) {
            addPages(position);
        } else if (recipe.grows()) {
            addGrown(position);
        } else {
            addDivided(sights, position);
        }
        position.frustum_count = static_cast<std::uint32_t>(frustums_.size()) - position.first_frustum;
        positions_.push_back(position);
    }
}

void Frustums::addGrown(const LightPosition& position)
{
    std::uint32_t tenant = first_tenants_[position.light];
    for (const GrownFrustum& one : multi_.frustumsOf(position.light)) {
        frustums_.push_back({one.slice, multi_.receiversOf(one), one.strength, tenant++, 0, one.side, 0});
    }
}

void Frustums::addPages(const LightPosition& position)
{
    std::uint32_t tenant = first_tenants_[position.light];
    for (const VirtualPage& one : virtual_.pagesOf(position.light)) {
        LightFrustum& frustum = frustums_.emplace_back();
        frustum.tenant = tenant++;
        frustum.page = &one;
    }
}

void Frustums::addDivided(const Sights& sights, const LightPosition& position)
{
    const Setup& setup = sights.setups()[position.at.options];
    const Recipe& recipe = setup.recipe;
    // A recipe with maps that predicts nothing has one. NOLINTNEXTLINE(clang-analyzer-core.uninitialized.UndefReturn)
    const AutoDecision* const decision = recipe.predicts() ? &chooser_.decisionOf(recipe, position.light) : nullptr;
    const PartitionTraits& partition = decision != nullptr ? *decision->partition : *recipe.partition;
    slices_.clear();
    partition.divide({position.at, setup.camera, recipe.options().cascades}, slices_);
    if (const std::uint32_t segments = recipe.resolved.segments(); segments > 1) {
        addSegments(sights, position, segments);
    }
    for (std::uint32_t i = 0; i < slices_.size(); ++i) {
        frustums_.push_back({slices_[i], sights.receiversOf(position.light),
                             recipe.searchesWarp() ? decision->strengths[i] : 1.0, first_tenants_[position.light], i, 0,
                             partition.fits_on_gpu ? recipe.mapsOf(partition) : 0});
    }
}

/// Puts them in the place of the one slice that there is.
void Frustums::addSegments(const Sights& sights, const LightPosition& position, std::uint32_t count)
{
    const Setup& setup = sights.setups()[position.at.options];
    const std::span receivers = sights.receiversOf(position.light);
    const Slice whole = slices_.front();
    slices_.clear();
    planner_.divideTsm({sights.frame(), setup.recipe, setup.camera, receivers, receivers, position.at, whole,
                        wishes_[first_tenants_[position.light]].side},
                       count, setup.recipe.options().cascades.blend, slices_);
}

} // namespace gnomon
