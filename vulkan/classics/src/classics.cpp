// SPDX-License-Identifier: Apache-2.0
#include <gnomon/vulkan/classics.h>

#include "alternate_pass.h"
#include "classic_modules.h"
#include "classics.h"
#include "fin_maps.h"
#include "midpoint_maps.h"
#include "smoothie_maps.h"
#include "volume_pass.h"

#include <gnomon/error.h>

#include <utility>

namespace gnomon::vulkan {
namespace {

class AllClassics final : public Classics {
public:
    explicit AllClassics(ClassicCallbacks callbacks) : callbacks_(std::move(callbacks)) {}

    [[nodiscard]] ShaderList modules() const override { return classicModules(); }

    [[nodiscard]] std::unique_ptr<MapStep> makeSmoothies(Device& device, const ResolvedOptions& options,
                                                         VkPipelineCache cache) const override
    {
        if (!options.hasFins()) {
            return std::make_unique<SmoothieMaps>(device, options, cache);
        }
        if (!callbacks_.fins) {
            throw Error("draw fins of smoothies", "the host has nothing that draws them (ClassicCallbacks::fins)",
                        "give the edges of casters to a FinDrawer, or choose soften smoothies, which finds them in the "
                        "map");
        }
        return std::make_unique<FinMaps>(device, options, callbacks_.fins);
    }

    [[nodiscard]] std::unique_ptr<ViewPainter> makeMidpoints(Device& device, const MapStorage& storage,
                                                             VkPipelineCache cache) const override
    {
        return std::make_unique<MidpointMaps>(device, storage, cache);
    }

    [[nodiscard]] std::unique_ptr<FrameJoiner> makeAlternate(Device& device, std::uint32_t frames_in_flight,
                                                             VkPipelineCache cache) const override
    {
        return std::make_unique<AlternatePass>(device, frames_in_flight, cache);
    }

    [[nodiscard]] std::unique_ptr<MaskStep> makeVolumes(Device& device, std::uint32_t frames_in_flight,
                                                        VkPipelineCache cache) const override
    {
        if (!callbacks_.volumes) {
            throw Error("draw shadow volumes", "the host has nothing that draws them (ClassicCallbacks::volumes)",
                        "give the edges of casters to a VolumeDrawer, or choose a filter with maps");
        }
        return std::make_unique<VolumePassRecorder>(device, frames_in_flight, cache, callbacks_.volumes);
    }

private:
    ClassicCallbacks callbacks_;
};

} // namespace

std::shared_ptr<const Classics> makeClassics(ClassicCallbacks callbacks)
{
    return std::make_shared<AllClassics>(std::move(callbacks));
}

} // namespace gnomon::vulkan
