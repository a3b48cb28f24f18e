// SPDX-License-Identifier: Apache-2.0
#include "auto/auto_choice.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

/// Cascades take as many passes as there are, and pixels where two of them meet read both: they have to err less than
/// one map by so much before they are taken, and are kept until they hardly do.
constexpr double kTakeCascades = 0.8;
constexpr double kKeepCascades = 0.95;

/// Frames from one look at the partition that is not taken to the next, and the change of the other one's error after
/// which there is no waiting.
constexpr std::uint32_t kFramesBetween = 8;
constexpr double kNewView = 1.5;

constexpr std::string_view kGiven = "the partition is as asked for; its warp is as strong as is predicted to err least";
constexpr std::string_view kAllGiven = "partition and fit are as asked for; the maps are as large as is of use";
constexpr std::string_view kOneMap = "one map: cascades are not predicted to err less by a fifth";
constexpr std::string_view kStillOneMap = "one map, as before: cascades are predicted to err less, but not by a fifth";
constexpr std::string_view kCascades = "cascades: they are predicted to err less than one map by more than a fifth";
constexpr std::string_view kStillCascades = "cascades, as before: they are still predicted to err less than one map";
constexpr std::string_view kAround = "six faces of a cube: a point light shines all around";
constexpr std::string_view kPlaced = "one map: a light with a place has a short cone";
constexpr std::string_view kFast = "one map: quality fast spends no more";
constexpr std::string_view kDepth =
    "one map around what the camera's depth buffer shows, found on the GPU (quality best)";
constexpr std::string_view kNothing = "one map: there is nothing in sight to tell them apart by";

std::size_t choose(std::size_t before, bool has_before, double single, double cascades, std::string_view& reason)
{
    if (!(single > 0.0) || !(cascades > 0.0)) {
        reason = has_before && before == 1 ? kStillCascades : kNothing;
        return before;
    }
    const double ratio = cascades / single;
    if (has_before && before == 1 && ratio <= kKeepCascades) {
        reason = ratio <= kTakeCascades ? kCascades : kStillCascades;
        return 1;
    }
    reason = ratio <= kTakeCascades ? kCascades : ratio < kKeepCascades && has_before ? kStillOneMap : kOneMap;
    return ratio <= kTakeCascades ? 1 : 0;
}

} // namespace

BySize AutoChooser::Candidate::shares() const
{
    BySize shares{};
    for (std::size_t size = 0; size < shares.size() && error.count > 0; ++size) {
        shares[size] = std::exp(edges[size] / static_cast<double>(error.count));
    }
    return shares;
}

void AutoChooser::follow(std::span<const Light> lights)
{
    keys_.clear();
    types_.clear();
    for (const Light& light : lights) {
        keys_.push_back(light.key);
        types_.push_back(layoutOf(light));
    }
    rows_.follow(keys_);
    memories_.resize(std::max<std::size_t>(memories_.size(), rows_.end()));
    for (const std::uint32_t row : rows_.gone()) {
        memories_[row] = {};
    }
}

void AutoChooser::begin(const Recipe& recipe, LightType type, Memory& memory)
{
    const bool around = type == LightType::point;
    const bool takes_depth = recipe.takesDepth(type);
    const bool chooses =
        recipe.choosesPartition() && recipe.options().quality != Quality::fast && !takes_depth && !around;
    const Partition alone = around ? Partition::cube : takes_depth ? Partition::sdsm : Partition::single;
    const PartitionTraits* const first = recipe.choosesPartition() ? partitionTraits(alone) : recipe.partition;
    if (memory.count == (chooses ? 2U : 1U) && memory.candidates[0].partition == first) {
        return;
    }
    memory = {};
    memory.count = chooses ? 2 : 1;
    memory.candidates[0].partition = first;
    memory.candidates[1].partition = partitionTraits(Partition::cascades);
    memory.decision.partition = first;
    memory.decision.told.partition = first->partition;
    const std::string_view given = recipe.searchesWarp() ? kGiven : kAllGiven;
    memory.decision.told.reason = !recipe.choosesPartition() ? given
                                  : around                   ? kAround
                                  : takes_depth              ? kDepth
                                  : chooses                  ? kNothing
                                                             : kFast;
}

const AutoDecision& AutoChooser::decisionOf(const Recipe& recipe, std::size_t light)
{
    Memory& memory = memories_[rows_.rowOf(light)];
    begin(recipe, types_[light], memory);
    return memory.decision;
}

const AutoDecision& AutoChooser::decide(const FrustumInput& input, const Sight& sight, std::size_t light,
                                        FrustumPlanner& frustums)
{
    Memory& memory = memories_[rows_.rowOf(light)];
    begin(input.recipe, types_[light], memory);
    const bool had_choice = memory.decision.told.made;
    const bool placed = input.light.type != LightType::directional;
    const std::size_t before = placed || memory.decision.partition == memory.candidates[0].partition ? 0 : 1;
    const std::size_t compared = memory.count == 2 && !placed ? 2 : 1;
    // The other candidate is predicted now and then, and at once where the view changed.
    const double error_before = memory.candidates[before].error.mean(); // with maps of the same size as now
    const std::uint32_t halvings = memory.decision.told.halvings;
    predict(input, sight, halvings, frustums, memory.candidates[before]);
    const double error_now = memory.candidates[before].error.mean();
    const bool is_new = !had_choice || std::max(error_now, error_before) > kNewView * std::min(error_now, error_before);
    const bool is_sized = halvings != memory.compared_at;
    memory.compared_at = halvings;
    if (compared == 2 && (is_new || is_sized || ++memory.frames >= kFramesBetween)) {
        memory.frames = 0;
        predict(input, sight, halvings, frustums, memory.candidates[1 - before]);
    }
    std::size_t best = 0;
    AutoChoice& told = memory.decision.told;
    if (memory.count == 2) {
        told.reason = kPlaced;
    }
    told.made = true;
    told.other_error = 0.0;
    if (compared == 2) {
        const double cascades = memory.candidates[1].error.mean();
        best = choose(before, had_choice, memory.candidates[0].error.mean(), cascades, told.reason);
        told.other_error = memory.candidates[1 - best].error.mean();
    }
    Candidate& taken = memory.candidates[best];
    size(input, taken, is_new, told);
    if (told.halvings != halvings) { // what is told, and the warps, are those of the maps that are drawn
        predict(input, sight, told.halvings, frustums, taken);
    }
    memory.decision.partition = taken.partition;
    memory.decision.strengths = taken.strengths;
    told.partition = taken.partition->partition;
    told.error = taken.error.mean();
    told.texels_per_pixel =
        taken.error.count > 0 ? std::exp(taken.error.log_texels / static_cast<double>(taken.error.count)) : 0.0;
    return memory.decision;
}

/// Texels that were asked for are spent as far as they are of use, and by quality best as many as memory has. Else by
/// their time.
void AutoChooser::size(const FrustumInput& input, const Candidate& taken, bool is_new, AutoChoice& told)
{
    const Recipe& recipe = input.recipe;
    const DeviceRates& rates = input.frame.rates;
    const std::optional<std::uint32_t> before = is_new ? std::nullopt : std::optional(told.halvings);
    BySize times_ms{};
    for (std::uint32_t halvings = 0; halvings < times_ms.size(); ++halvings) {
        const MapWish wish = recipe.wishOf(input.light, 0, *taken.partition, halvings);
        const double texels = static_cast<double>(wish.side) * wish.side * wish.count;
        times_ms[halvings] = frameTime_ms(rates, recipe.resolved.traits(),
                                          {static_cast<double>(input.frame.size_px.x) * input.frame.size_px.y,
                                           static_cast<double>(input.receivers.size()) * wish.count, texels});
    }
    if (input.light.map_size != 0) {
        told.halvings = 0; // its side is given
    } else if (recipe.sizesMap() && taken.coarsest_px > 0.0) {
        told.halvings = halvingsFor(taken.coarsest_px, before);
        if (!recipe.options().max_texels && recipe.options().quality != Quality::best) {
            told.halvings = std::max(told.halvings, halvingsByTime(taken.shares(), times_ms, before));
        }
    }
    told.rates = rates.source;
    told.time_ms = times_ms[told.halvings];
}

void AutoChooser::predict(const FrustumInput& input, const Sight& sight, std::uint32_t halvings,
                          FrustumPlanner& frustums, Candidate& candidate)
{
    slices_.clear();
    candidate.partition->divide({input.light, input.camera, input.recipe.options().cascades}, slices_);
    candidate.error = {};
    candidate.edges = {};
    candidate.coarsest_px = 0.0;
    const std::uint32_t side = input.recipe.wishOf(input.light, 0, *candidate.partition, halvings).side;
    for (std::size_t i = 0; i < slices_.size(); ++i) {
        FrustumInput asked{input.frame,     input.recipe, input.camera, input.receivers,
                           input.levellers, input.light,  slices_[i],   side};
        asked.halvings = halvings;
        const Prediction found = frustums.predict(asked, sight, candidate.strengths[i]);
        candidate.error.add(found.error);
        for (std::size_t size = 0; size < found.edges.size(); ++size) {
            candidate.edges[size] += found.edges[size];
        }
        candidate.coarsest_px =
            std::max(candidate.coarsest_px, std::ldexp(found.coarsest_px, -static_cast<int>(halvings)));
    }
}

} // namespace gnomon
