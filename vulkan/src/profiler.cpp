// SPDX-License-Identifier: Apache-2.0
#include "optional_parts.h"
#include "usage.h"

#include <gnomon/error.h>
#include <gnomon/vulkan/profiler.h>

#include <algorithm>
#include <string>

namespace gnomon::vulkan {
namespace {

// In the order of their bits, which is the order of the results.
constexpr VkQueryPipelineStatisticFlags kStatistics = VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                                                      VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT |
                                                      VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT |
                                                      VK_QUERY_PIPELINE_STATISTIC_COMPUTE_SHADER_INVOCATIONS_BIT;
constexpr std::size_t kStatisticCount = 4;

/// False: not yet. Throws Error when they never will be.
bool areThere(VkResult result)
{
    if (result == VK_NOT_READY) {
        return false;
    }
    check(result, "read queries back");
    return true;
}

QueryPool makePool(Device& device, VkQueryType type, std::uint32_t count, VkQueryPipelineStatisticFlags statistics)
{
    VkQueryPoolCreateInfo info{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = type;
    info.queryCount = count;
    info.pipelineStatistics = statistics;
    VkQueryPool pool = VK_NULL_HANDLE;
    check(device.vk.CreateQueryPool(device.handle(), &info, nullptr, &pool), "create a query pool");
    return {device, pool};
}

std::uint32_t checkedPasses(std::uint32_t max_passes)
{
    constexpr std::uint32_t kMostPasses = 1U << 16;
    if (max_passes == 0 || max_passes > kMostPasses) {
        throw Error("measure " + std::to_string(max_passes) + " passes of a frame",
                    "there can be 1 to " + std::to_string(kMostPasses));
    }
    return max_passes;
}

} // namespace

struct Profiler::Impl {
    struct Slot {
        QueryPool times;      // null without timestamps
        QueryPool statistics; // null without counts
        std::vector<PassRecord> passes;
        bool read = false;
    };

    Impl(const DeviceView& view, std::uint32_t frames, std::uint32_t passes)
        : device(view), max_passes(passes), tick_bits(timestampBits(view))
    {
        ticks.resize(std::size_t{2} * passes);
        counts.resize(kStatisticCount * passes);
        slots.resize(frames);
        for (Slot& slot : slots) {
            if (tick_bits > 0) {
                slot.times = makePool(device, VK_QUERY_TYPE_TIMESTAMP, 2 * passes, 0);
            }
            if (device.uses().statistics) {
                slot.statistics = makePool(device, VK_QUERY_TYPE_PIPELINE_STATISTICS, passes, kStatistics);
            }
            slot.passes.reserve(passes);
        }
    }

    void fetchTimes(Slot& slot);
    void fetchCounts(Slot& slot);
    void writeTime(VkCommandBuffer commands, const Slot& slot, std::uint32_t query) const;

    Device device;
    std::uint32_t max_passes;
    std::uint32_t tick_bits; // bits of a timestamp
    std::vector<Slot> slots;
    std::vector<std::uint64_t> ticks;
    std::vector<std::uint64_t> counts;
    Slot* current = nullptr;
    bool in_pass = false;
    bool measured = false; // this pass has queries; those beyond max_passes do not
};

void Profiler::Impl::fetchTimes(Slot& slot)
{
    const auto n = static_cast<std::uint32_t>(slot.passes.size());
    if (!slot.times || !areThere(device.vk.GetQueryPoolResults(device.handle(), slot.times.get(), 0, 2 * n,
                                                               ticks.size() * sizeof ticks[0], ticks.data(),
                                                               sizeof ticks[0], VK_QUERY_RESULT_64_BIT))) {
        return;
    }
    // Bits above the valid ones are undefined, and the difference is right where the clock wraps between two ticks.
    const std::uint64_t valid = ~std::uint64_t{0} >> (64U - std::min(tick_bits, 64U));
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto elapsed = static_cast<double>((ticks[2 * i + 1] - ticks[2 * i]) & valid);
        slot.passes[i].milliseconds = elapsed * static_cast<double>(device.limits().timestampPeriod) * 1e-6;
    }
}

void Profiler::Impl::fetchCounts(Slot& slot)
{
    const auto n = static_cast<std::uint32_t>(slot.passes.size());
    if (!slot.statistics || !areThere(device.vk.GetQueryPoolResults(
                                device.handle(), slot.statistics.get(), 0, n, counts.size() * sizeof counts[0],
                                counts.data(), kStatisticCount * sizeof counts[0], VK_QUERY_RESULT_64_BIT))) {
        return;
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        PassRecord& pass = slot.passes[i];
        const std::uint64_t* values = &counts[kStatisticCount * i];
        pass.has_statistics = true;
        pass.vertex_invocations = values[0];
        pass.primitives = values[1];
        pass.fragment_invocations = values[2];
        pass.compute_invocations = values[3];
    }
}

void Profiler::Impl::writeTime(VkCommandBuffer commands, const Slot& slot, std::uint32_t query) const
{
    if (slot.times) {
        device.vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.times.get(), query);
    }
}

Profiler::Profiler(const DeviceView& device, std::uint32_t frames_in_flight, std::uint32_t max_passes)
    : impl_(std::make_unique<Impl>(device, checkedFrames(frames_in_flight), checkedPasses(max_passes)))
{
}

Profiler::~Profiler() = default;

void Profiler::beginFrame([[maybe_unused]] VkCommandBuffer commands, std::uint32_t slot)
{
    checkSlot("begin a frame's times", slot, static_cast<std::uint32_t>(impl_->slots.size()));
    if (impl_->in_pass) {
        refuseUse("begin a frame's times", "a pass has not ended", "call endPass() first");
    }
    impl_->current = &impl_->slots[slot];
    impl_->current->passes.clear();
    impl_->current->read = false;
    // From the host: the slot's last frame has finished, and a reset recorded outside would order against nothing else.
    const auto reset = [&](const QueryPool& pool, std::uint32_t count) {
        if (pool) {
            impl_->device.vk.ResetQueryPool(impl_->device.handle(), pool.get(), 0, count);
        }
    };
    reset(impl_->current->times, 2 * impl_->max_passes);
    reset(impl_->current->statistics, impl_->max_passes);
}

void Profiler::beginPass(VkCommandBuffer commands, const char* name)
{
    if (impl_->current == nullptr || impl_->in_pass) {
        refuseUse("begin a pass's times", "no frame has begun, or the pass before has not ended",
                  "call beginFrame() first, and endPass() for each pass: they do not nest");
    }
    checkCommands("begin a pass's times", commands);
    Impl::Slot& slot = *impl_->current;
    impl_->in_pass = true;
    impl_->device.beginLabel(commands, name);
    impl_->measured = slot.passes.size() < impl_->max_passes;
    if (impl_->measured) {
        const auto i = static_cast<std::uint32_t>(slot.passes.size());
        slot.passes.push_back({});
        slot.passes.back().name = name;
        impl_->writeTime(commands, slot, 2 * i);
        if (slot.statistics) {
            impl_->device.vk.CmdBeginQuery(commands, slot.statistics.get(), i, 0);
        }
    }
}

void Profiler::addDraws(std::uint32_t count)
{
    if (impl_->in_pass && impl_->measured) {
        impl_->current->passes.back().draws += count;
    }
}

void Profiler::endPass(VkCommandBuffer commands)
{
    if (!impl_->in_pass) {
        return;
    }
    if (impl_->measured) {
        Impl::Slot& slot = *impl_->current;
        const auto i = static_cast<std::uint32_t>(slot.passes.size() - 1);
        if (slot.statistics) {
            impl_->device.vk.CmdEndQuery(commands, slot.statistics.get(), i);
        }
        impl_->writeTime(commands, slot, 2 * i + 1);
    }
    impl_->device.endLabel(commands);
    impl_->in_pass = false;
}

std::span<const PassRecord> Profiler::results(std::uint32_t slot_index)
{
    if (slot_index >= impl_->slots.size()) {
        return {};
    }
    Impl::Slot& slot = impl_->slots[slot_index];
    if (!slot.read && !slot.passes.empty()) {
        impl_->fetchTimes(slot);
        impl_->fetchCounts(slot);
        slot.read = true;
    }
    return slot.passes;
}

} // namespace gnomon::vulkan
