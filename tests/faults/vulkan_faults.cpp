// SPDX-License-Identifier: Apache-2.0
// Compiled alone: it defines functions that other sources take from the loader.
#include "vulkan_faults.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <thread>

namespace {

std::atomic<std::uint64_t> calls{0};
std::atomic<std::int64_t> live{0};
std::atomic<std::uint64_t> failing{0}; // 0: none
std::atomic<VkResult> failure{VK_SUCCESS};
std::atomic<bool> deaf{false};
std::atomic<std::uint64_t> deaf_waits{0};
std::atomic<VkDevice> device_now{VK_NULL_HANDLE};

/// The loader's function of this name.
template <class Function>
Function* real(const char* name)
{
    void* const found = dlsym(RTLD_NEXT, name);
    if (found == nullptr) {
        std::abort();
    }
    return reinterpret_cast<Function*>(found);
}

/// The result that a call must return without doing anything, or VK_SUCCESS.
VkResult outcome()
{
    const std::uint64_t call = ++calls;
    const std::uint64_t at = failing;
    const VkResult result = failure;
    if (at == 0 || call < at || (call > at && result != VK_ERROR_DEVICE_LOST)) {
        return VK_SUCCESS;
    }
    if (result == VK_ERROR_DEVICE_LOST && device_now != VK_NULL_HANDLE) {
        real<decltype(vkDeviceWaitIdle)>("vkDeviceWaitIdle")(device_now);
    }
    return result;
}

VkResult counted(VkResult result, std::int64_t objects)
{
    live += result == VK_SUCCESS ? objects : 0;
    return result;
}

} // namespace

// A call that may fail, with its parameters and their names.
#define GNOMON_FALLIBLE(name, objects, parameters, names)                                                              \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters                                                                     \
    {                                                                                                                  \
        static auto* const next = real<decltype(name)>(#name);                                                         \
        const VkResult fails = outcome();                                                                              \
        return fails != VK_SUCCESS ? fails : counted(next names, objects);                                             \
    }
#define GNOMON_DESTROYS(name, parameters, names, handle)                                                               \
    VKAPI_ATTR void VKAPI_CALL name parameters                                                                         \
    {                                                                                                                  \
        static auto* const next = real<decltype(name)>(#name);                                                         \
        live -= (handle) != VK_NULL_HANDLE ? 1 : 0;                                                                    \
        next names;                                                                                                    \
    }
// Objects that devices make by a structure, and destroy by a handle.
#define GNOMON_OBJECT(type)                                                                                            \
    GNOMON_FALLIBLE(                                                                                                   \
        vkCreate##type, 1,                                                                                             \
        (VkDevice device, const Vk##type##CreateInfo* info, const VkAllocationCallbacks* callbacks, Vk##type* made),   \
        (device, info, callbacks, made))                                                                               \
    GNOMON_DESTROYS(vkDestroy##type, (VkDevice device, Vk##type one, const VkAllocationCallbacks* callbacks),          \
                    (device, one, callbacks), one)

extern "C" {

// clang-format off
GNOMON_OBJECT(Fence)
GNOMON_OBJECT(CommandPool)
GNOMON_OBJECT(Buffer)
GNOMON_OBJECT(Image)
GNOMON_OBJECT(ImageView)
GNOMON_OBJECT(Sampler)
GNOMON_OBJECT(ShaderModule)
GNOMON_OBJECT(PipelineLayout)
GNOMON_OBJECT(PipelineCache)
GNOMON_OBJECT(DescriptorSetLayout)
GNOMON_OBJECT(DescriptorPool)
GNOMON_OBJECT(QueryPool)

GNOMON_FALLIBLE(vkCreateGraphicsPipelines, count,
                (VkDevice d, VkPipelineCache c, std::uint32_t count, const VkGraphicsPipelineCreateInfo* i,
                 const VkAllocationCallbacks* a, VkPipeline* p), (d, c, count, i, a, p))
GNOMON_FALLIBLE(vkCreateComputePipelines, count,
                (VkDevice d, VkPipelineCache c, std::uint32_t count, const VkComputePipelineCreateInfo* i,
                 const VkAllocationCallbacks* a, VkPipeline* p), (d, c, count, i, a, p))
GNOMON_DESTROYS(vkDestroyPipeline, (VkDevice d, VkPipeline p, const VkAllocationCallbacks* a), (d, p, a), p)
GNOMON_FALLIBLE(vkAllocateMemory, 1,
                (VkDevice d, const VkMemoryAllocateInfo* i, const VkAllocationCallbacks* a, VkDeviceMemory* m),
                (d, i, a, m))
GNOMON_DESTROYS(vkFreeMemory, (VkDevice d, VkDeviceMemory m, const VkAllocationCallbacks* a), (d, m, a), m)
GNOMON_FALLIBLE(vkMapMemory, 0,
                (VkDevice d, VkDeviceMemory m, VkDeviceSize o, VkDeviceSize s, VkMemoryMapFlags f, void** data),
                (d, m, o, s, f, data))
GNOMON_FALLIBLE(vkBindBufferMemory, 0, (VkDevice d, VkBuffer b, VkDeviceMemory m, VkDeviceSize o), (d, b, m, o))
GNOMON_FALLIBLE(vkBindImageMemory, 0, (VkDevice d, VkImage i, VkDeviceMemory m, VkDeviceSize o), (d, i, m, o))
GNOMON_FALLIBLE(vkAllocateCommandBuffers, 0,
                (VkDevice d, const VkCommandBufferAllocateInfo* i, VkCommandBuffer* c), (d, i, c))
GNOMON_FALLIBLE(vkAllocateDescriptorSets, 0,
                (VkDevice d, const VkDescriptorSetAllocateInfo* i, VkDescriptorSet* s), (d, i, s))
GNOMON_FALLIBLE(vkResetCommandPool, 0, (VkDevice d, VkCommandPool p, VkCommandPoolResetFlags f), (d, p, f))
GNOMON_FALLIBLE(vkBeginCommandBuffer, 0, (VkCommandBuffer c, const VkCommandBufferBeginInfo* i), (c, i))
GNOMON_FALLIBLE(vkEndCommandBuffer, 0, (VkCommandBuffer c), (c))
GNOMON_FALLIBLE(vkResetFences, 0, (VkDevice d, std::uint32_t n, const VkFence* f), (d, n, f))
GNOMON_FALLIBLE(vkQueueSubmit2, 0, (VkQueue q, std::uint32_t n, const VkSubmitInfo2* i, VkFence f), (q, n, i, f))
GNOMON_FALLIBLE(vkGetPipelineCacheData, 0, (VkDevice d, VkPipelineCache c, std::size_t* n, void* data), (d, c, n, data))
GNOMON_FALLIBLE(vkGetQueryPoolResults, 0,
                (VkDevice d, VkQueryPool p, std::uint32_t first, std::uint32_t n, std::size_t bytes, void* data,
                 VkDeviceSize stride, VkQueryResultFlags f), (d, p, first, n, bytes, data, stride, f))
GNOMON_FALLIBLE(vkEnumeratePhysicalDevices, 0, (VkInstance i, std::uint32_t* n, VkPhysicalDevice* d), (i, n, d))
GNOMON_FALLIBLE(vkEnumerateInstanceLayerProperties, 0, (std::uint32_t* n, VkLayerProperties* p), (n, p))
GNOMON_FALLIBLE(vkEnumerateInstanceExtensionProperties, 0,
                (const char* layer, std::uint32_t* n, VkExtensionProperties* p), (layer, n, p))
GNOMON_FALLIBLE(vkCreateInstance, 1,
                (const VkInstanceCreateInfo* i, const VkAllocationCallbacks* a, VkInstance* out), (i, a, out))
GNOMON_DESTROYS(vkDestroyInstance, (VkInstance i, const VkAllocationCallbacks* a), (i, a), i)
// clang-format on

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                              const VkAllocationCallbacks* callbacks, VkDevice* device)
{
    const VkResult fails = outcome();
    if (fails != VK_SUCCESS) {
        return fails;
    }
    const VkResult result = real<decltype(vkCreateDevice)>("vkCreateDevice")(physical, info, callbacks, device);
    if (result == VK_SUCCESS) {
        device_now = *device;
    }
    return counted(result, 1);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDevice(VkDevice device, const VkAllocationCallbacks* callbacks)
{
    VkDevice expected = device;
    device_now.compare_exchange_strong(expected, VK_NULL_HANDLE);
    --live;
    real<decltype(vkDestroyDevice)>("vkDestroyDevice")(device, callbacks);
}

VKAPI_ATTR VkResult VKAPI_CALL vkWaitForFences(VkDevice device, std::uint32_t count, const VkFence* fences,
                                               VkBool32 all, std::uint64_t timeout)
{
    const VkResult fails = outcome();
    if (fails != VK_SUCCESS) {
        return fails;
    }
    static auto* const next = real<decltype(vkWaitForFences)>("vkWaitForFences");
    if (!deaf) { // all at once, so that a slow machine makes no more calls than a quick one
        return next(device, count, fences, all, UINT64_MAX);
    }
    ++deaf_waits;
    (void)next(device, count, fences, all, UINT64_MAX); // it does finish, and nobody hears of it
    std::this_thread::sleep_for(std::chrono::nanoseconds(timeout));
    return VK_TIMEOUT;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name);

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance, const char* name)
{
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
        return reinterpret_cast<PFN_vkVoidFunction>(vkGetDeviceProcAddr);
    }
    return real<decltype(vkGetInstanceProcAddr)>("vkGetInstanceProcAddr")(instance, name);
}

/// Gives our function to callers that look one up, where there is one.
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name)
{
#define GNOMON_OURS(function)                                                                                          \
    if (std::strcmp(name, #function) == 0) {                                                                           \
        return reinterpret_cast<PFN_vkVoidFunction>(function);                                                         \
    }
#define GNOMON_OUR_OBJECT(type) GNOMON_OURS(vkCreate##type) GNOMON_OURS(vkDestroy##type)
    // clang-format off
    GNOMON_OUR_OBJECT(Buffer) GNOMON_OUR_OBJECT(Image) GNOMON_OUR_OBJECT(ImageView) GNOMON_OUR_OBJECT(Sampler)
    GNOMON_OUR_OBJECT(ShaderModule) GNOMON_OUR_OBJECT(PipelineLayout) GNOMON_OUR_OBJECT(DescriptorSetLayout)
    GNOMON_OUR_OBJECT(DescriptorPool) GNOMON_OUR_OBJECT(QueryPool)
    GNOMON_OURS(vkCreateGraphicsPipelines) GNOMON_OURS(vkCreateComputePipelines) GNOMON_OURS(vkDestroyPipeline)
    GNOMON_OURS(vkAllocateMemory) GNOMON_OURS(vkFreeMemory) GNOMON_OURS(vkMapMemory) GNOMON_OURS(vkBindBufferMemory)
    GNOMON_OURS(vkBindImageMemory) GNOMON_OURS(vkAllocateDescriptorSets) GNOMON_OURS(vkGetQueryPoolResults)
        // clang-format on
        return real<decltype(vkGetDeviceProcAddr)>("vkGetDeviceProcAddr")(device, name);
}

} // extern "C"

namespace gnomon::test {

std::uint64_t fallibleVulkanCalls()
{
    return calls;
}

std::int64_t liveVulkanObjects()
{
    return live;
}

FailingCall::FailingCall(std::uint64_t nth, VkResult result)
{
    failure = result;
    failing = calls + nth;
}

FailingCall::~FailingCall()
{
    failing = 0;
}

DeafFences::DeafFences()
{
    deaf_waits = 0;
    deaf = true;
}

DeafFences::~DeafFences()
{
    deaf = false;
}

std::uint64_t DeafFences::waits()
{
    return deaf_waits;
}

} // namespace gnomon::test
