// SPDX-License-Identifier: Apache-2.0
#include "null_driver.h"

#include "null_state.h"

#include <algorithm>
#include <cassert>

namespace gnomon::test {

void NullDriver::Impl::use(NullObject* object)
{
    if (object == nullptr) {
        return;
    }
    counts.used_after_free += object->destroyed ? 1 : 0;
    object->slots |= 1U << slot;
    use(object->memory);
    for (NullObject* const part : object->parts) {
        use(part);
    }
}

void NullDriver::Impl::destroy(NullObject* object)
{
    assert(!object->destroyed);
    counts.freed_in_use += object->slots != 0 ? 1 : 0;
    object->destroyed = true;
}

void NullDriver::Impl::log(const NullEvent& event)
{
    if (events.size() < kMostNullEvents) {
        events.push_back(event);
    }
}

VkResult NullDriver::Impl::outcome()
{
    ++fallible_calls;
    const bool lost = failure == VK_ERROR_DEVICE_LOST && failing_call != 0 && fallible_calls > failing_call;
    return fallible_calls == failing_call || lost ? failure : VK_SUCCESS;
}

NullDriver::NullDriver(const NullLimits& limits) : impl_(std::make_unique<Impl>())
{
    impl_->limits = limits;
    impl_->events.reserve(kMostNullEvents);
}

NullDriver::~NullDriver() = default;

vulkan::DeviceView NullDriver::view()
{
    vulkan::DeviceView view;
    view.instance = reinterpret_cast<VkInstance>(impl_.get());
    view.physical_device = reinterpret_cast<VkPhysicalDevice>(impl_.get());
    view.device = reinterpret_cast<VkDevice>(impl_.get());
    view.get_instance_proc_addr = nullInstanceProcAddr;
    view.features = vulkan::supportedFeatures(view);
    if (impl_->claims_all) {
        view.features = {true, true, true, true, true, true, true, true};
    }
    view.features.depth_bounds = false; // its commands are none of those that tests count
    return view;
}

VkCommandBuffer NullDriver::commands()
{
    return reinterpret_cast<VkCommandBuffer>(impl_.get());
}

VkBuffer NullDriver::makeBuffer()
{
    return makeObject<VkBuffer>(*impl_);
}

VkImageView NullDriver::makeView()
{
    const auto view = makeObject<VkImageView>(*impl_);
    objectOf(view)->parts.push_back(objectOf(makeObject<VkImage>(*impl_)));
    return view;
}

void NullDriver::remakeView(VkImageView view)
{
    NullObject& object = *objectOf(view);
    // Sets keep the old view; its image is gone.
    impl_->destroy(object.parts.front());
    for (auto& other : impl_->objects) {
        std::replace(other.front().parts.begin(), other.front().parts.end(), &object, object.parts.front());
    }
    object.parts = {objectOf(makeObject<VkImage>(*impl_))};
    object.slots = 0;
}

void NullDriver::beginSlot(std::uint32_t slot)
{
    for (auto& object : impl_->objects) {
        object.front().slots &= ~(1U << slot);
    }
    impl_->slot = slot;
}

void NullDriver::finishAll()
{
    for (auto& object : impl_->objects) {
        object.front().slots = 0;
    }
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

std::uint64_t NullDriver::fallibleCalls() const
{
    return impl_->fallible_calls;
}

void NullDriver::failCall(std::uint64_t nth, VkResult result)
{
    impl_->failing_call = nth == 0 ? 0 : impl_->fallible_calls + nth;
    impl_->failure = result;
}

void NullDriver::setApiVersion(std::uint32_t version)
{
    impl_->api_version = version;
}

void NullDriver::claimAll()
{
    impl_->claims_all = true;
}

void NullDriver::hideFunction(const char* name)
{
    impl_->hidden = name;
}

} // namespace gnomon::test
