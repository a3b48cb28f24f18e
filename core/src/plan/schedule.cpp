// SPDX-License-Identifier: Apache-2.0
#include "plan/schedule.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// A view of the plan before as one of this plan, with nothing to draw.
View asDrawn(const View& before, std::uint32_t light)
{
    View view = before;
    view.light = light;
    view.contents.presumes = view.contents.makes;
    view.contents.kept_presumes = view.contents.kept_makes;
    view.contents.redraw = false;
    view.contents.redraw_kept = false;
    view.contents.waited = before.contents.waited + 1;
    view.contents.dirty = {};
    return view;
}

/// How many texels of the maps of some options a frame may draw.
std::uint64_t drawBudget(const Frame& frame, const ShadowOptions& options)
{
    std::uint64_t texels = options.draw_budget_texels > 0 ? options.draw_budget_texels : kNoDrawBudget;
    const double rate = frame.draw_ms_per_texel;
    if (options.draw_budget_ms > 0.0 && std::isfinite(rate) && rate > 0.0) {
        const double affordable = std::floor(options.draw_budget_ms / rate);
        if (affordable < static_cast<double>(texels)) {
            texels = static_cast<std::uint64_t>(affordable);
        }
    }
    return texels;
}

} // namespace

Schedule::Schedule(const std::vector<Setup>& setups)
    : takes_turns_(std::ranges::any_of(setups, [](const Setup& one) { return one.recipe.takesTurns(); })),
      wide_(setups.size())
{
}

void Schedule::forget()
{
    for (LightBefore& light : before_) {
        light = {};
    }
}

void Schedule::begin(Plan& plan)
{
    if (takes_turns_) {
        std::swap(plan.views, views_);
        std::swap(plan.casters, casters_);
    }
    for (WideSight& wide : wide_) {
        wide.looked = false;
    }
}

void Schedule::follow(std::span<const Light> frame)
{
    keys_.clear();
    for (const Light& light : frame) {
        keys_.push_back(light.key);
    }
    rows_.follow(keys_);
    before_.resize(std::max<std::size_t>(before_.size(), rows_.end()));
    for (const std::uint32_t row : rows_.gone()) {
        before_[row] = {};
    }
    lights_.assign(frame.size(), {});
}

void Schedule::foresee(Sights& sights, Frustums& frustums, const Places& places, const Plan& plan)
{
    if (!takes_turns_) {
        return;
    }
    follow(sights.frame().lights);
    for (std::uint32_t options = 0; options < sights.setups().size(); ++options) {
        if (sights.setups()[options].looked && sights.setups()[options].recipe.takesTurns()) {
            foreseeOf(sights, frustums, places.store(), plan, options);
        }
    }
}

void Schedule::foreseeOf(Sights& sights, Frustums& frustums, const MapStore& store, const Plan& plan,
                         std::uint32_t options)
{
    const Recipe& recipe = sights.setups()[options].recipe;
    const LightShares& shares = sights.findShares(options);
    claims_.clear();
    for (std::uint32_t index = 0; index < plan.lights.size(); ++index) {
        if (plan.lights[index].options != options || plan.lights[index].outcome.kind != OutcomeKind::ok) {
            continue;
        }
        Turn& turn = lights_[index];
        const LightBefore& before = lightBefore(index);
        turn.bounded = true;
        turn.share = shares.shareOf(index);
        turn.is_same = isAsBefore(sights, index);
        turn.by_cascade = recipe.turnsByCascade() && !recipe.converges() && !recipe.steps(sights.frame().lights[index]);
        // All of them, with what their maps hold.
        turn.keeps_views =
            !turn.by_cascade && turn.is_same && std::ranges::all_of(viewsOf(index), [&](const View& view) {
                return view.projection.gpu_cascade == kNoIndex && store.holds(view);
            });
        turn.kept_back = turn.keeps_views && recipe.grows() && frustums.differs(index);
        // Most lights have as much to draw as in the frame before.
        turn.texels = turn.keeps_views && !turn.kept_back ? before.texels : frustums.texelsWanted(sights, index);
        claims_.push_back({index, turn.share, turn.texels, before.waited, turn.keeps_views, false});
    }
    order_.take(claims_, drawBudget(sights.frame(), recipe.options()), recipe.options().longest_wait);
    for (const DrawTurn& claim : claims_) {
        Turn& turn = lights_[claim.light];
        if (!turn.kept_back) {
            continue;
        }
        turn.kept_back = !claim.drawn;
        turn.keeps_views = !claim.drawn;
        if (turn.kept_back) {
            frustums.keepDivision(sights, claim.light);
        }
    }
}

/// Could views of a light of the plan before stand for those of this one? Not where it had none, so that none is
/// without a shadow that it should have; nor where what they show is another thing than what is asked for now.
bool Schedule::isAsBefore(const Sights& sights, std::uint32_t index) const
{
    const Frame& frame = sights.frame();
    const Light& light = frame.lights[index];
    const LightBefore& before = lightBefore(index);
    const Setup& setup = sights.setups()[light.options];
    const bool same = before.type == light.type && before.options == light.options && before.map_size == light.map_size;
    return !frame.cut && frame.objects->identity() == objects_ && before.view_count > 0 && same &&
           !setup.recipe.converges() && !setup.recipe.steps(light) && setup.sees();
}

void Schedule::keepRoom(const Frustums& frustums, const Places& places)
{
    const MapStore& store = places.store();
    for (std::uint32_t index = 0; index < lights_.size(); ++index) {
        const auto isKept = [&](const View& view) {
            bool owns = false;
            for (std::uint32_t i = frustums.firstTenant(index); i < frustums.endTenant(index); ++i) {
                owns = owns || store.owns(i, view.place.map);
            }
            return owns && store.holds(view);
        };
        Turn& turn = lights_[index];
        turn.keeps_views = turn.keeps_views && std::ranges::all_of(viewsOf(index), isKept);
        turn.kept_back = turn.kept_back && turn.keeps_views;
        turn.waits = turn.kept_back;
    }
}

void Schedule::take(const Sights& sights, Frustums& frustums, Places& places, std::vector<ViewMap>& maps, Plan& plan)
{
    const Results results{sights, frustums, places.store(), maps, plan};
    if (takes_turns_) {
        for (std::uint32_t options = 0; options < sights.setups().size(); ++options) {
            takeOf(results, options);
        }
        if (std::ranges::any_of(lights_, &Turn::waits) || std::ranges::any_of(maps, &ViewMap::waits)) {
            putViewsBack(results);
        }
        noteGrounds(results);
        note(results);
    }
    draw(results);
}

void Schedule::takeOf(const Results& results, std::uint32_t options)
{
    claims_.clear();
    for (std::uint32_t index = 0; index < lights_.size(); ++index) {
        Turn& turn = lights_[index];
        const LightPlan& planned = results.plan.lights[index];
        if (!turn.bounded || turn.waits || planned.options != options) {
            continue;
        }
        if (turn.by_cascade) {
            claimByCascade(results, index);
            continue;
        }
        turn.texels = 0;
        for (std::uint32_t i = planned.first_view; i < planned.first_view + planned.view_count; ++i) {
            turn.texels += texelsDue(results, i);
        }
        claims_.push_back({index, turn.share, turn.texels, lightBefore(index).waited, turn.keeps_views, false});
    }
    const Recipe& recipe = results.sights.setups()[options].recipe;
    order_.take(claims_, drawBudget(results.sights.frame(), recipe.options()), recipe.options().longest_wait);
    for (const DrawTurn& claim : claims_) {
        if (claim.view != kNoIndex) {
            results.maps[claim.view].waits = !claim.drawn;
            continue;
        }
        lights_[claim.light].waits = !claim.drawn;
        if (!claim.drawn && recipe.grows()) {
            results.frustums.keepMemory(claim.light);
        }
    }
}

/// Texels that have to be drawn for a view as it is planned.
std::uint64_t Schedule::texelsDue(const Results& results, std::uint32_t index)
{
    const View& view = results.plan.views[index];
    if (view.projection.gpu_cascade != kNoIndex) {
        return std::uint64_t{view.place.tile.width} * view.place.tile.height;
    }
    const std::span<const std::uint32_t> casters = results.plan.casters;
    return results.store.wouldDraw(view, *results.maps[index].place,
                                   casters.subspan(view.casters.first, view.casters.count),
                                   *results.sights.frame().objects);
}

/// Gives the lights and cascades that wait the views that they had.
void Schedule::putViewsBack(const Results& results)
{
    Plan& plan = results.plan;
    const Frame& frame = results.sights.frame();
    next_views_.clear();
    next_casters_.clear();
    next_maps_.clear();
    for (std::uint32_t index = 0; index < plan.lights.size(); ++index) {
        LightPlan& planned = plan.lights[index];
        const std::uint32_t first = planned.first_view;
        planned.first_view = static_cast<std::uint32_t>(next_views_.size());
        if (lights_[index].waits) {
            planned.outcome = lightBefore(index).outcome;
            planned.waited = lightBefore(index).waited + 1;
            for (const View& view : viewsOf(index)) {
                addBack(frame, asDrawn(view, index), casters_, {});
            }
        } else {
            for (std::uint32_t i = first; i < first + planned.view_count; ++i) {
                if (!results.maps[i].waits) {
                    addBack(frame, plan.views[i], plan.casters, results.maps[i]);
                    continue;
                }
                View kept = asDrawn(*viewBefore(results.store, index, plan.views[i].place.map), index);
                kept.serves.slice = plan.views[i].serves.slice;
                planned.waited = std::max(planned.waited, kept.contents.waited);
                addBack(frame, kept, casters_, {});
            }
        }
        planned.view_count = static_cast<std::uint32_t>(next_views_.size()) - planned.first_view;
    }
    std::swap(plan.views, next_views_);
    std::swap(plan.casters, next_casters_);
    std::swap(results.maps, next_maps_);
}

/// Leaves out casters that are gone since: a backend may have to draw the map all the same.
void Schedule::addBack(const Frame& frame, View view, std::span<const std::uint32_t> from, const ViewMap& map)
{
    const auto casters = from.subspan(view.casters.first, view.casters.count);
    view.casters.first = static_cast<std::uint32_t>(next_casters_.size());
    std::uint32_t still = 0;
    for (std::uint32_t i = 0; i < casters.size(); ++i) {
        if (frame.objects->alive(casters[i])) {
            next_casters_.push_back(casters[i]);
            still += i < view.casters.still ? 1 : 0;
        }
    }
    view.casters.still = still;
    view.casters.count = static_cast<std::uint32_t>(next_casters_.size()) - view.casters.first;
    next_views_.push_back(view);
    next_maps_.push_back(map);
}

/// Remembers what the next frame is held against.
void Schedule::note(const Results& results)
{
    objects_ = results.sights.frame().objects->identity();
    for (std::uint32_t index = 0; index < lights_.size(); ++index) {
        const LightPlan& planned = results.plan.lights[index];
        const Light& light = results.sights.frame().lights[index];
        LightBefore& before = lightBefore(index);
        before = {};
        if (lights_[index].bounded) {
            before = {light.type,         light.options,  light.map_size,        planned.first_view,
                      planned.view_count, planned.waited, lights_[index].texels, planned.outcome};
        }
    }
}

void Schedule::draw(const Results& results)
{
    const ObjectSet& objects = *results.sights.frame().objects;
    for (std::size_t i = 0; i < results.plan.views.size(); ++i) {
        View& view = results.plan.views[i];
        const ViewMap& map = results.maps[i];
        if (map.place == nullptr) {
            continue; // its light waits
        }
        if (view.projection.gpu_cascade != kNoIndex) {
            results.store.drawAnew(view);
        } else if (map.read) {
            results.store.draw(view, *map.place,
                               std::span(results.plan.casters).subspan(view.casters.first, view.casters.count),
                               objects);
        } else {
            view.contents.redraw = false;
        }
    }
}

void Schedule::report(Plan& plan)
{
    for (const View& view : plan.views) {
        MapPages& pages = plan.pages[plan.lights[view.light].options];
        pages.drawn_texels += texelsToDraw(view);
        pages.waiting_maps += view.contents.waited > 0 ? 1 : 0;
    }
    for (const LightPlan& light : plan.lights) {
        MapPages& pages = plan.pages[light.options];
        pages.waiting_lights += light.waited > 0 ? 1 : 0;
        pages.longest_wait = std::max(pages.longest_wait, light.waited);
    }
}

} // namespace gnomon
