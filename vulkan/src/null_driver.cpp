// SPDX-License-Identifier: Apache-2.0
#include "null_state.h"

namespace gnomon::vulkan {

NullDriver::NullDriver(const NullLimits& limits) : impl_(std::make_unique<Impl>())
{
    impl_->limits = limits;
    impl_->events.reserve(kMostNullEvents);
}

NullDriver::~NullDriver() = default;

DeviceView NullDriver::view()
{
    DeviceView view;
    view.instance = reinterpret_cast<VkInstance>(impl_.get());
    view.physical_device = reinterpret_cast<VkPhysicalDevice>(impl_.get());
    view.device = reinterpret_cast<VkDevice>(impl_.get());
    view.get_instance_proc_addr = nullInstanceProcAddr;
    view.layered = true;
    return view;
}

VkCommandBuffer NullDriver::commands()
{
    return reinterpret_cast<VkCommandBuffer>(impl_.get());
}

VkBuffer NullDriver::makeBuffer()
{
    return freshHandle<VkBuffer>(*impl_);
}

VkImageView NullDriver::makeView()
{
    return freshHandle<VkImageView>(*impl_);
}

const NullCounts& NullDriver::counts() const
{
    return impl_->counts;
}

std::span<const NullEvent> NullDriver::events() const
{
    return impl_->events;
}

void NullDriver::clearEvents()
{
    impl_->events.clear();
}

void NullDriver::setMemory(std::uint64_t bytes)
{
    impl_->limits.memory_bytes = bytes;
}

void NullDriver::hideFormatFeatures(VkFormatFeatureFlags features)
{
    impl_->hidden_features = features;
}

void NullDriver::hideFunction(const char* name)
{
    impl_->hidden = name;
}

} // namespace gnomon::vulkan
