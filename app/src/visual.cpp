// SPDX-License-Identifier: Apache-2.0
#include "app/visual.h"

#include "contestants.h"
#include "host/window/interface.h"
#include "interrupt.h"
#include "streams.h"

#include <gnomon/error.h>
#include <gnomon/pack/filter_rule.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

/// Where one pays for reads of coarser levels, and there are next to none.
void noteLevels(const Settings& technique)
{
    constexpr std::uint32_t kFew = 3;
    const std::uint32_t side = largestSide(technique.shadow);
    const MapSampling sampling = technique.shadow.moments.sampling;
    const std::uint32_t levels = pack::mipLevels(resolvedOrThrow(technique.shadow), side, side);
    const FilterTraits* traits = filterTraits(filterOf(technique.shadow));
    if (levels < kFew && traits->filterable &&
        (sampling == MapSampling::trilinear || sampling == MapSampling::anisotropic)) {
        notice(
            fmt::format("map-sampling {}: a map of {} texels has {} mip level{}, for only whole texels are averaged; a "
                        "power of two has most",
                        nameOf(sampling), side, levels, levels == 1 ? "" : "s"));
    }
}

} // namespace

std::unique_ptr<host::Gpu> openGpu(const Settings& settings, const host::Window* window,
                                   const vulkan::ShaderHook& shaders)
{
    host::GpuOptions options{.gpu = settings.gpu,
                             .validate = settings.validate,
                             .while_waiting = requireNotInterrupted,
                             .rates = settings.rates,
                             .shaders = shaders};
    if (window != nullptr) {
        options = host::forWindow(options, *window);
    }
    auto gpu = std::make_unique<host::Gpu>(options);
    const VkPhysicalDeviceLimits& limits = gpu->properties().limits;
    const std::uint32_t max_side =
        std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight});
    // With ssaa4 the host draws twice as wide and high.
    const std::uint32_t scale = settings.values.at("aa") == "ssaa4" ? 2 : 1;
    if (std::max(settings.size_px.x, settings.size_px.y) > max_side / scale) {
        throw Error(fmt::format("drawing {}x{} pixels{}", settings.size_px.x, settings.size_px.y,
                                scale == 1 ? "" : ", each four times"),
                    fmt::format("{} draws at most {} on a side", gpu->properties().deviceName, max_side / scale));
    }
    if (largestSide(settings.shadow) > max_side) {
        throw Error(fmt::format("drawing a map of {} texels", largestSide(settings.shadow)),
                    fmt::format("{} draws at most {} on a side", gpu->properties().deviceName, max_side));
    }
    if (gpu->software() && settings.gpu.empty()) {
        notice(fmt::format("no GPU found, drawing with {}", gpu->properties().deviceName));
    }
    for (const Settings& technique : hasManyTechniques(settings) ? contestants(settings) : std::vector{settings}) {
        noteLevels(technique);
    }
    return gpu;
}

void requireSilence(const host::Gpu& gpu)
{
    const std::vector<std::string> messages = gpu.messages();
    if (!messages.empty()) {
        throw Error("drawing under Vulkan validation", fmt::format("{} message{}, the first: {}", messages.size(),
                                                                   messages.size() == 1 ? "" : "s", messages.front()));
    }
}

Image16 maskAs16Bit(const ImageF& mask)
{
    Image16 image(mask.width, mask.height, mask.channels);
    std::transform(mask.values.begin(), mask.values.end(), image.values.begin(), [](float value) {
        const float clamped = value > 0.0F ? std::min(value, 1.0F) : 0.0F; // NaN fails the comparison
        return static_cast<std::uint16_t>(std::lround(clamped * 65535.0F));
    });
    return image;
}

} // namespace gnomon::app
