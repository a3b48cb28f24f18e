// SPDX-License-Identifier: Apache-2.0
// The renderer's interface to techniques that few hosts want, which are a library of their own: vulkan/classics.
#pragma once

#include "map_step.h"
#include "map_storage.h"
#include "mask_step.h"

#include <memory>

namespace gnomon::vulkan {

/// Makes their passes. Each function throws Error where the host has given no callback that the pass calls.
class Classics {
public:
    Classics() = default;
    virtual ~Classics() = default;
    Classics(const Classics&) = delete;
    Classics& operator=(const Classics&) = delete;

    /// Modules that the passes are made of.
    [[nodiscard]] virtual ShaderList modules() const = 0;
    /// Precondition: options.hasSmoothies().
    [[nodiscard]] virtual std::unique_ptr<MapStep> makeSmoothies(Device& device, const ResolvedOptions& options,
                                                                 VkPipelineCache cache) const = 0;
    /// For isDrawnTwice(). Precondition: the storage is depth alone.
    [[nodiscard]] virtual std::unique_ptr<ViewPainter> makeMidpoints(Device& device, const MapStorage& storage,
                                                                     VkPipelineCache cache) const = 0;
    /// For Motion::step_alternate.
    [[nodiscard]] virtual std::unique_ptr<FrameJoiner> makeAlternate(Device& device, std::uint32_t frames_in_flight,
                                                                     VkPipelineCache cache) const = 0;
    /// For Filter::volumes.
    [[nodiscard]] virtual std::unique_ptr<MaskStep> makeVolumes(Device& device, std::uint32_t frames_in_flight,
                                                                VkPipelineCache cache) const = 0;
};

/// Throws Error for a classic technique, unless `classics` are there.
void checkClassics(const ResolvedOptions& options, const Classics* classics);
void checkClassics(const Plan& plan, const Classics* classics);

} // namespace gnomon::vulkan
