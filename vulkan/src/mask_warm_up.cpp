// SPDX-License-Identifier: Apache-2.0
// Makes parts of the mask pass before frames need them: pipelines, and the passes that join frames.
#include "mask_pass.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/page_table.h>

#include <algorithm>
#include <array>
#include <span>

namespace gnomon::vulkan {
namespace {

bool isColoured(const ResolvedOptions& options)
{
    return options.asked().translucent == Translucent::colour;
}

/// maskChannelCount() of a plan with one light of these options.
std::uint32_t channelsAlone(const ResolvedOptions& options)
{
    return isColoured(options) ? 4 : 1;
}

bool leavesPixels(const Plan& plan)
{
    return std::ranges::any_of(*plan.options,
                               [](const ResolvedOptions& one) { return drawnFirst(one) != DrawnAs::whole; });
}

std::span<const DrawnAs> waysToDraw(const ResolvedOptions& options)
{
    static constexpr std::array kWhole{DrawnAs::whole};
    static constexpr std::array kSettled{DrawnAs::settled, DrawnAs::left};
    static constexpr std::array kHalved{DrawnAs::half, DrawnAs::left};
    switch (drawnFirst(options)) {
    case DrawnAs::half:
        return kHalved;
    case DrawnAs::settled:
        return kSettled;
    default:
        return kWhole;
    }
}

} // namespace

VkFormat maskFormat(std::uint32_t channels)
{
    return channels > 1 ? VK_FORMAT_R8G8B8A8_UNORM : VK_FORMAT_R8_UNORM;
}

bool drawsToConverge(const Plan& plan)
{
    return std::ranges::any_of(plan.lights, pack::joinsFrames) && std::ranges::none_of(plan.lights, pack::takesTurns);
}

bool weighsFrames(const ResolvedOptions& options)
{
    return options.technique().soften == Soften::converge && options.traits().weighs_frames;
}

ImageInfo MaskPassRecorder::drawnInfo(const Plan& plan) const
{
    ImageInfo info = mask_.info();
    info.format = drawsToConverge(plan) ? ConvergePass::targetFormat(info.format) : info.format;
    return info;
}

VkPipeline MaskPassRecorder::pipeline(const Plan& plan, const pack::MaskDraw& draw, MaskShape shape, DrawnAs as)
{
    const ResolvedOptions& options = (*plan.options)[draw.options];
    MaskPipelineKey key = maskPipelineKey(options, shape);
    key.format = drawnInfo(plan).format;
    if (drawsToConverge(plan)) {
        key.constants.confidence = weighsFrames(options) ? VK_TRUE : VK_FALSE;
    }
    key.constants.orthographic = draw.orthographic ? VK_TRUE : VK_FALSE;
    key.told_apart = draw.told_apart;
    key.constants.paired = draw.paired ? VK_TRUE : VK_FALSE;
    key.shares = draw.shares;
    key.constants.technique.few_views = draw.few_views;
    key.constants.tints = tinted_[draw.options] != 0 ? VK_TRUE : VK_FALSE;
    key.constants.coloured = draw.coloured ? VK_TRUE : VK_FALSE;
    key.constants.tile_channels = compact_.channels;
    key.constants.takes_away = isCompact() && draw.shares ? VK_TRUE : VK_FALSE;
    return pipelines_.get(drawnAs(key, as), layout_.get());
}

void MaskPassRecorder::makePipelines(const Plan& plan, MaskShape shape)
{
    const glm::uvec2 size_px(mask_.info().extent.width, mask_.info().extent.height);
    if (isCompact()) {
        pack::listCompactMaskDraws(plan, compact_, size_px, now_.draws);
    } else {
        pack::listMaskDraws(plan, size_px, now_.draws);
    }
    for (const pack::MaskDraw& draw : now_.draws) {
        for (const DrawnAs as : waysToDraw((*plan.options)[draw.options])) {
            (void)pipeline(plan, draw, shape, as);
        }
    }
}

void MaskPassRecorder::makeAlternate()
{
    if (!alternate_) {
        alternate_ = classics_->makeAlternate(device_, slot_count_, cache_);
    }
}

void MaskPassRecorder::makeConverge()
{
    if (!converge_) {
        converge_.emplace(device_, slot_count_, cache_);
    }
}

void MaskPassRecorder::makeSoften()
{
    if (!soften_) {
        soften_.emplace(device_, slot_count_, cache_);
    }
}

void MaskPassRecorder::makeSpread()
{
    if (!spread_) {
        spread_.emplace(device_, slot_count_, cache_);
    }
}

void MaskPassRecorder::makeVolumes()
{
    if (!volumes_) {
        volumes_ = classics_->makeVolumes(device_, slot_count_, cache_);
    }
}

/// By all inputs that there are, where nobody has told yet which come.
void MaskPassRecorder::prepareVolumes(const Plan& plan)
{
    counts_volumes_ = hasVolumes(plan);
    if (counts_volumes_) {
        makeVolumes();
        volumes_->prepare(plan, drawnInfo(plan), shape_.value_or(MaskShape{true, true, true}));
    }
}

void MaskPassRecorder::warmUpDraws(const ResolvedOptions& options, const WarmUp& what, bool to_converge)
{
    MaskPipelineKey key = maskPipelineKey(options, what.inputs);
    const auto formatOf = [&](std::uint32_t channels) {
        const VkFormat format = maskFormat(channels);
        return to_converge ? ConvergePass::targetFormat(format) : format;
    };
    const auto make = [&] {
        for (const bool orthographic : {true, false}) {
            key.constants.orthographic = orthographic ? VK_TRUE : VK_FALSE;
            for (const DrawnAs as : waysToDraw(options)) {
                if (orthographic || what.perspective) {
                    (void)pipelines_.get(drawnAs(key, as), layout_.get());
                }
            }
        }
    };
    key.constants.confidence = to_converge && weighsFrames(options) ? VK_TRUE : VK_FALSE;
    if (isCompact()) {
        key.format = maskFormat(shared::kLightsPerLayer);
        key.constants.tile_channels = compact_.channels;
        make();
        key.shares = true;
        key.constants.takes_away = VK_TRUE;
        if (what.several_options) {
            make();
        }
        return;
    }
    key.constants.coloured = isColoured(options) ? VK_TRUE : VK_FALSE;
    key.format = formatOf(channelsAlone(options));
    using pack::ToldApart;
    const std::uint32_t few = pack::fewViews(options);
    const Partition partition = options.technique().partition;
    const bool side_by_side = partition == Partition::cube || partition == Partition::paraboloid;
    // For a light that alone has maps, whether it is the only one or beside lights without any.
    const auto makeAlone = [&] {
        key.told_apart = ToldApart::tests;
        key.constants.technique.few_views = few;
        make();
        if (pack::hasPages(options)) {
            return; // a table tells its views apart
        }
        if (few > 1 && !side_by_side) {
            key.told_apart = ToldApart::slices;
            make();
        }
        key.constants.technique.few_views = few > 0 ? 1 : 0; // a spot has one map
        if (few > 0) {
            key.told_apart = ToldApart::tests;
            make();
        }
        key.told_apart = ToldApart::alone;
        make();
        if (few == 0) { // a sun in steps may have one for each of its positions
            key.constants.paired = VK_TRUE;
            make();
            key.constants.paired = VK_FALSE;
        }
    };
    makeAlone();
    if (what.several_lights && !isColoured(options)) {
        key.format = formatOf(4);
        makeAlone();
    }
    key.told_apart = ToldApart::tests;
    key.constants.technique.few_views = 0;
    key.format = formatOf(4);
    if (what.several_lights) {
        make();
    }
    key.shares = true;
    if (what.several_lights && what.several_options && !isColoured(options)) {
        make();
    }
}

void MaskPassRecorder::warmUp(const ResolvedOptions& options, const WarmUp& what)
{
    if (!options.hasMaps()) {
        makeVolumes();
        volumes_->warmUp({maskFormat(channelsAlone(options)), 1, what.inputs});
        for (std::uint32_t channel = 0; what.several_lights && channel < shared::kLightsPerLayer; ++channel) {
            volumes_->warmUp({maskFormat(4), 1U << channel, what.inputs});
        }
        return;
    }
    const bool converges = options.technique().soften == Soften::converge;
    if (converges || what.several_options) {
        warmUpDraws(options, what, true);
    }
    if (!converges || what.several_options) {
        warmUpDraws(options, what, false);
    }
    if (options.technique().motion == Motion::step_alternate) {
        makeAlternate();
        alternate_->warmUp({.format = maskFormat(channelsAlone(options))});
        if (what.several_lights) {
            alternate_->warmUp({.format = maskFormat(4)});
        }
        if (what.several_lights && what.several_options) {
            alternate_->warmUp({.format = ConvergePass::targetFormat(maskFormat(4))});
        }
    }
    if (options.halvesMask() && !isCompact()) {
        warmUpSpread(options, what);
    }
    if (options.technique().soften == Soften::blur && !isCompact()) {
        makeSoften();
        soften_->warmUp(maskFormat(channelsAlone(options)), options.screen_blur(), what.inputs.normals, false);
        if (what.several_lights) {
            soften_->warmUp(maskFormat(4), options.screen_blur(), what.inputs.normals, what.several_options);
        }
    }
    if (options.technique().soften == Soften::converge) {
        makeConverge();
        converge_->warmUp({.format = maskFormat(channelsAlone(options))});
        if (what.several_lights) {
            converge_->warmUp({.format = maskFormat(4)});
        }
    }
}

void MaskPassRecorder::warmUpSpread(const ResolvedOptions& options, const WarmUp& what)
{
    makeSpread();
    const auto make = [&](std::uint32_t channels) {
        const VkFormat format = maskFormat(channels);
        spread_->warmUp(format, what.inputs);
        if (what.several_options) { // beside a light that joins frames
            spread_->warmUp(ConvergePass::targetFormat(format), what.inputs);
        }
    };
    make(channelsAlone(options));
    if (what.several_lights) {
        make(4);
    }
}

/// Prepares what lights may come to need, so that nothing is made in the middle of frames.
void MaskPassRecorder::prepareHistories(const Plan& plan)
{
    const auto may = [&](auto&& does) {
        return std::ranges::any_of(*plan.options, [&](const ResolvedOptions& one) { return does(one.technique()); });
    };
    if (may([](const Technique& technique) { return technique.motion == Motion::step_alternate; }) ||
        std::ranges::any_of(plan.lights, pack::takesTurns)) {
        makeAlternate();
        alternate_->prepare(plan, mask_.info(), {});
    }
    if (may([](const Technique& technique) { return technique.soften == Soften::converge; }) ||
        std::ranges::any_of(plan.lights, pack::joinsFrames)) {
        makeConverge();
        converge_->prepare(plan, mask_.info(), {});
        if (alternate_) {
            alternate_->warmUp({.format = converge_->target().info().format});
        }
    }
}

void MaskPassRecorder::prepareMarks(const Plan& plan)
{
    if (leavesPixels(plan)) {
        marks_.prepare(device_, mask_.info().extent);
    }
}

bool MaskPassRecorder::holdsMarks(const Plan& plan) const
{
    return !leavesPixels(plan) || marks_.holds(mask_.info().extent);
}

/// Prepares it where some options halve the mask, in the format that this plan's lights are drawn in.
void MaskPassRecorder::prepareSpread(const Plan& plan)
{
    if (std::ranges::any_of(*plan.options, [](const ResolvedOptions& one) { return one.halvesMask(); })) {
        makeSpread();
        const ImageInfo drawn = drawnInfo(plan);
        spread_->prepare(drawn);
        if (shape_) {
            spread_->warmUp(drawn.format, *shape_);
        }
    }
}

/// Prepares softening for options that ask for it. A plan whose lights have different options gets the pipelines for
/// that, too.
void MaskPassRecorder::prepareSoften(const Plan& plan)
{
    for (const ResolvedOptions& options : *plan.options) {
        if (options.technique().soften == Soften::blur) {
            makeSoften();
            if (shape_) {
                const VkFormat format = mask_.info().format;
                const bool some = plan.options->size() > 1 && format != maskFormat(1);
                soften_->warmUp(format, options.screen_blur(), shape_->normals, some);
            }
        }
    }
    if (soften_) {
        soften_->prepare(mask_.info(), plan);
    }
}

} // namespace gnomon::vulkan
