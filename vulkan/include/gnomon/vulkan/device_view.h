// SPDX-License-Identifier: Apache-2.0
// The caller's Vulkan 1.3 device as the backend sees it. Nothing here is owned, created or destroyed.
#pragma once

#include <gnomon/export.h>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::vulkan {

/// One piece of device memory, as the host's memory policy gave it.
struct MemoryBlock {
    VkDeviceMemory memory = VK_NULL_HANDLE; // may be shared with other blocks
    VkDeviceSize offset = 0;                // bytes, aligned as was asked
    void* mapped = nullptr;                 // host address of the block's first byte when it is host-visible, else null
    void* token = nullptr;                  // for the hooks' own use
};

/// A request for memory.
struct MemoryRequest {
    VkMemoryRequirements needs{};         // size, alignment and types, as the driver says
    VkMemoryPropertyFlags properties = 0; // all of them; HOST_VISIBLE ones are to be mapped
    const char* purpose = "";             // a static string ("shadow maps", "mask", "constants" ...) for accounting
    /// The resource that will be bound: one of them, the other one is null. A buffer is linear, an image is not: in one
    /// block of memory they must keep VkPhysicalDeviceLimits::bufferImageGranularity apart.
    VkBuffer buffer = VK_NULL_HANDLE;
    VkImage image = VK_NULL_HANDLE; // or null
    /// The driver prefers an allocation for this resource alone (VkMemoryDedicatedAllocateInfo).
    bool prefers_dedicated = false;
    bool requires_dedicated = false; // the driver requires such an allocation

    /// It is for a buffer.
    [[nodiscard]] bool linear() const { return buffer != VK_NULL_HANDLE; }
};

/// The host's memory policy. Both functions or none.
struct MemoryHooks {
    void* user = nullptr; // handed to both as it is
    /// Fills `block`; anything but VK_SUCCESS becomes an Error.
    VkResult (*allocate)(void* user, const MemoryRequest& request, MemoryBlock* block) = nullptr;
    /// Takes back a block that `allocate` gave, once the GPU no longer uses it.
    void (*release)(void* user, const MemoryBlock& block) = nullptr;
};

/// Lets a host replace the library's shaders by other modules, to work on them while it runs. It is called for each
/// module whenever a pipeline is made of it. Existing pipelines stay as they are, so a host makes its ShadowRenderer
/// and its drawers anew after a change. The interface (bindings, constants, locations) has to stay.
struct ShaderHook {
    void* user = nullptr; // handed to `words`; the library does not look at it
    /// `name` is that of the SPIR-V file in a build of the library: the source with the variant in it
    /// ("mask_vsm.frag"). Returns SPIR-V for Vulkan 1.3 that stays in place until this thread's next call, or nothing:
    /// then the library's own is taken. May be called by several threads at once; does not throw.
    std::span<const std::uint32_t> (*words)(void* user, const char* name) = nullptr;
};

/// Features that the library uses and that not every device of Vulkan 1.3 has. supportedFeatures() lists those that a
/// device has, and a host turns off those that it does not want. optionalParts() says what happens where one is off.
struct FeatureUses {
    bool indirect_draws = false; // CasterDrawer: few commands for many casters
    bool depth_clamp = false;    // casters before a map's near plane (ViewProjection::clamp_near); filter volumes
    bool filterable = false;     // maps of vsm, lvsm, esm, evsm, msm
    bool sample_metric = false;  // depths of each sample in such maps of perspective views
    bool layered = false;        // CascadePass::layered
    bool clip_planes = false;    // CasterBatch::clip_planes
    bool depth_bounds = false;   // filter volumes counts no farther than lamps reach
    bool statistics = false;     // counts of PassRecord
};

/// The host's device. Precondition: it was made with requiredFeatures(features). Functions that take a DeviceView throw
/// Error when a handle or the function is null, or one memory hook is given without the other.
struct DeviceView {
    VkInstance instance = VK_NULL_HANDLE;              // not null
    VkPhysicalDevice physical_device = VK_NULL_HANDLE; // not null
    VkDevice device = VK_NULL_HANDLE;                  // not null
    /// All Vulkan functions are looked up through it, so a host may give a loader, a layer or a mock. Not null.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    MemoryHooks memory;             // empty: a dedicated allocation per resource
    ShaderHook shaders;             // empty: the library's own
    bool debug_labels = false;      // VK_EXT_debug_utils is enabled: name objects, label passes
    FeatureUses features;           // the features that are on; no others are used
    std::uint32_t queue_family = 0; // family of the queues that run the commands: Profiler asks how wide its timestamps
                                    // are
};

/// The features that the physical device has. Reads instance, physical_device and get_instance_proc_addr of `view`.
[[nodiscard]] GNOMON_API FeatureUses supportedFeatures(const DeviceView& view);

/// Something that a device of Vulkan 1.3 may lack.
struct OptionalPart {
    const char* name;                    // features and formats as the specification spells them
    const char* serves;                  // its purpose
    const char* without;                 // how it is done where this is lacking
    const char* instead;                 // advice where its lack is refused; else empty
    bool FeatureUses::*use;              // the member that turns it on; null: it is no feature, and is used where
                                         // present
    bool (*has)(const DeviceView& view); // reads the same members as supportedFeatures(), and queue_family
};
/// All optional parts that the library uses, except formats of maps: ShadowRenderer::prepare() refuses formats that the
/// device cannot draw to or filter. Static lifetime. OptionalPart::has() throws Error as supportedFeatures() does.
[[nodiscard]] GNOMON_API std::span<const OptionalPart> optionalParts();

/// The features that `uses` and the library itself need, chained for VkDeviceCreateInfo::pNext: for a host that wants
/// no others. Static lifetime.
[[nodiscard]] GNOMON_API const VkPhysicalDeviceFeatures2& requiredFeatures(const FeatureUses& uses);

/// Adds the missing features to an engine's own. No feature may be in two structures of a chain. So each is turned on
/// in the structure that is there, which is changed in place (VkDeviceCreateInfo::pEnabledFeatures,
/// VkPhysicalDeviceFeatures2, VkPhysicalDeviceVulkan12Features, -13Features, or the structure of that feature alone);
/// where there is none, a structure is put before the chain. It must live until vkCreateDevice() has returned.
class GNOMON_API FeatureMerge {
public:
    /// Changes `info`: its pNext or pEnabledFeatures. Throws Error for shaderOutputLayer in a chain that has structures
    /// of single features of Vulkan 1.2, with which VkPhysicalDeviceVulkan12Features must not be.
    FeatureMerge(VkDeviceCreateInfo& info, const FeatureUses& uses);
    ~FeatureMerge();
    FeatureMerge(const FeatureMerge&) = delete;
    FeatureMerge& operator=(const FeatureMerge&) = delete;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

/// Writes the names of the features that the library cannot do without and the physical device lacks, separated by ",
/// "; none for any device of Vulkan 1.3. Writes at most `capacity` bytes to `text`, the last one a zero.
GNOMON_API void missingFeatures(const DeviceView& view, char* text, std::uint32_t capacity);

} // namespace gnomon::vulkan
