// SPDX-License-Identifier: Apache-2.0
#include "pipeline_ear.h"

#include <cassert>
#include <cstring>
#include <span>
#include <utility>

namespace gnomon::compiled {

PipelineEar* PipelineEar::listening = nullptr;

namespace {

template <class Handle>
std::uint64_t bits(Handle handle)
{
    return reinterpret_cast<std::uint64_t>(handle);
}

} // namespace

/// The functions that the library is given. Each calls the one below, and then the device's.
struct PipelineEar::Calls {
    static PipelineEar& ear() { return *listening; }

    template <class Function>
    static Function below(const char* name)
    {
        const vulkan::DeviceView& view = ear().below_;
        return reinterpret_cast<Function>(view.get_instance_proc_addr(view.instance, name));
    }

    static VKAPI_ATTR void VKAPI_CALL properties(VkPhysicalDevice, VkPhysicalDeviceProperties* out)
    {
        vkGetPhysicalDeviceProperties(ear().device_.physicalDevice(), out);
    }
    static VKAPI_ATTR void VKAPI_CALL formats(VkPhysicalDevice, VkFormat format, VkFormatProperties* out)
    {
        vkGetPhysicalDeviceFormatProperties(ear().device_.physicalDevice(), format, out);
    }
    static VKAPI_ATTR void VKAPI_CALL features(VkPhysicalDevice, VkPhysicalDeviceFeatures2* out)
    {
        vkGetPhysicalDeviceFeatures2(ear().device_.physicalDevice(), out);
    }

    static VKAPI_ATTR VkResult VKAPI_CALL module(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                 const VkAllocationCallbacks* host, VkShaderModule* made)
    {
        const VkResult result = below<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device, info, host, made);
        VkShaderModule real = VK_NULL_HANDLE;
        vkCreateShaderModule(ear().device_.device(), info, nullptr, &real);
        ear().keep(*made, real);
        ear().made_modules_.push_back(real);
        ear().modules_[*made] = nameOf(ear().names_, *info);
        return result;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL sampler(VkDevice device, const VkSamplerCreateInfo* info,
                                                  const VkAllocationCallbacks* host, VkSampler* made)
    {
        const VkResult result = below<PFN_vkCreateSampler>("vkCreateSampler")(device, info, host, made);
        VkSampler real = VK_NULL_HANDLE;
        vkCreateSampler(ear().device_.device(), info, nullptr, &real);
        ear().keep(*made, real);
        ear().made_samplers_.push_back(real);
        return result;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL setLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                                    const VkAllocationCallbacks* host, VkDescriptorSetLayout* made)
    {
        const VkResult result =
            below<PFN_vkCreateDescriptorSetLayout>("vkCreateDescriptorSetLayout")(device, info, host, made);
        std::vector<VkDescriptorSetLayoutBinding> bindings(info->pBindings, info->pBindings + info->bindingCount);
        std::vector<std::vector<VkSampler>> samplers;
        for (VkDescriptorSetLayoutBinding& binding : bindings) {
            if (binding.pImmutableSamplers != nullptr) {
                std::vector<VkSampler>& own = samplers.emplace_back();
                for (const VkSampler one : std::span(binding.pImmutableSamplers, binding.descriptorCount)) {
                    own.push_back(ear().real(one));
                }
                binding.pImmutableSamplers = own.data();
            }
        }
        VkDescriptorSetLayoutCreateInfo own = *info;
        own.pBindings = bindings.data();
        VkDescriptorSetLayout real = VK_NULL_HANDLE;
        vkCreateDescriptorSetLayout(ear().device_.device(), &own, nullptr, &real);
        ear().keep(*made, real);
        ear().made_set_layouts_.push_back(real);
        return result;
    }

    static VKAPI_ATTR VkResult VKAPI_CALL layout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                 const VkAllocationCallbacks* host, VkPipelineLayout* made)
    {
        const VkResult result = below<PFN_vkCreatePipelineLayout>("vkCreatePipelineLayout")(device, info, host, made);
        std::vector<VkDescriptorSetLayout> sets;
        for (const VkDescriptorSetLayout set : std::span(info->pSetLayouts, info->setLayoutCount)) {
            sets.push_back(ear().real(set));
        }
        VkPipelineLayoutCreateInfo own = *info;
        own.pSetLayouts = sets.data();
        VkPipelineLayout real = VK_NULL_HANDLE;
        vkCreatePipelineLayout(ear().device_.device(), &own, nullptr, &real);
        ear().keep(*made, real);
        ear().made_layouts_.push_back(real);
        return result;
    }

    template <class Info>
    static void compile(std::span<const Info> infos)
    {
        for (const Info& info : infos) {
            ear().hear(ear().make(info), namesOf(info, ear().modules_));
        }
    }

    static VKAPI_ATTR VkResult VKAPI_CALL graphics(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                                   const VkGraphicsPipelineCreateInfo* infos,
                                                   const VkAllocationCallbacks* host, VkPipeline* made)
    {
        compile(std::span(infos, count));
        return below<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines")(device, cache, count, infos, host,
                                                                                 made);
    }

    static VKAPI_ATTR VkResult VKAPI_CALL compute(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                                  const VkComputePipelineCreateInfo* infos,
                                                  const VkAllocationCallbacks* host, VkPipeline* made)
    {
        compile(std::span(infos, count));
        return below<PFN_vkCreateComputePipelines>("vkCreateComputePipelines")(device, cache, count, infos, host, made);
    }

    static PFN_vkVoidFunction VKAPI_CALL ofDevice(VkDevice, const char* name)
    {
        return ofInstance(ear().below_.instance, name);
    }

    static PFN_vkVoidFunction VKAPI_CALL ofInstance(VkInstance instance, const char* name)
    {
        const auto entry = [](auto function) {
            return reinterpret_cast<PFN_vkVoidFunction>(function);
        };
        const std::pair<const char*, PFN_vkVoidFunction> ours[] = {
            {"vkGetDeviceProcAddr", entry(&ofDevice)},
            {"vkGetPhysicalDeviceProperties", entry(&properties)},
            {"vkGetPhysicalDeviceFormatProperties", entry(&formats)},
            {"vkGetPhysicalDeviceFeatures2", entry(&features)},
            {"vkCreateShaderModule", entry(&module)},
            {"vkCreateSampler", entry(&sampler)},
            {"vkCreateDescriptorSetLayout", entry(&setLayout)},
            {"vkCreatePipelineLayout", entry(&layout)},
            {"vkCreateGraphicsPipelines", entry(&graphics)},
            {"vkCreateComputePipelines", entry(&compute)}};
        for (const auto& [known, function] : ours) {
            if (std::strcmp(known, name) == 0) {
                return function;
            }
        }
        return ear().below_.get_instance_proc_addr(instance, name);
    }
};

PipelineEar::PipelineEar(const vulkan::DeviceView& below, const ModuleNames& modules, AmdDevice& device)
    : below_(below), device_(device), names_(modules)
{
    assert(listening == nullptr);
    listening = this;
}

PipelineEar::~PipelineEar()
{
    VkDevice device = device_.device();
    for (VkPipelineLayout one : made_layouts_) {
        vkDestroyPipelineLayout(device, one, nullptr);
    }
    for (VkDescriptorSetLayout one : made_set_layouts_) {
        vkDestroyDescriptorSetLayout(device, one, nullptr);
    }
    for (VkSampler one : made_samplers_) {
        vkDestroySampler(device, one, nullptr);
    }
    for (VkShaderModule one : made_modules_) {
        vkDestroyShaderModule(device, one, nullptr);
    }
    listening = nullptr;
}

vulkan::DeviceView PipelineEar::view() const
{
    vulkan::DeviceView view = below_;
    view.get_instance_proc_addr = &Calls::ofInstance;
    return view;
}

template <class Handle>
Handle PipelineEar::real(Handle below) const
{
    const auto found = handles_.find(bits(below));
    return found == handles_.end() ? Handle{VK_NULL_HANDLE} : reinterpret_cast<Handle>(found->second);
}

/// A driver may give a handle again when its object is gone.
template <class Handle>
void PipelineEar::keep(Handle below, Handle made)
{
    handles_[bits(below)] = bits(made);
}

VkPipelineShaderStageCreateInfo PipelineEar::realStage(VkPipelineShaderStageCreateInfo stage) const
{
    stage.module = real(stage.module);
    return stage;
}

VkPipeline PipelineEar::make(VkGraphicsPipelineCreateInfo info) const
{
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (const VkPipelineShaderStageCreateInfo& stage : std::span(info.pStages, info.stageCount)) {
        stages.push_back(realStage(stage));
    }
    info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    info.pStages = stages.data();
    info.layout = real(info.layout);
    VkPipeline made = VK_NULL_HANDLE;
    vkCreateGraphicsPipelines(device_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &made);
    return made;
}

VkPipeline PipelineEar::make(VkComputePipelineCreateInfo info) const
{
    info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    info.stage = realStage(info.stage);
    info.layout = real(info.layout);
    VkPipeline made = VK_NULL_HANDLE;
    vkCreateComputePipelines(device_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &made);
    return made;
}

void PipelineEar::hear(VkPipeline made, const StageNames& names)
{
    used_.insert(names.modules.begin(), names.modules.end());
    if (made == VK_NULL_HANDLE) {
        faults_.push_back(names.modules.front() + " is not compiled");
        return;
    }
    for (const CompiledStage& stage : device_.stagesOf(made)) {
        const auto named = names.labels.find(stage.stages);
        if (named == names.labels.end()) {
            continue;
        }
        keepFigures(named->second, stage.figures);
    }
    vkDestroyPipeline(device_.device(), made, nullptr);
}

/// Pipelines that have one name and other figures are numbered as they come, which is the same in each run.
void PipelineEar::keepFigures(const std::string& name, const Figures& figures)
{
    std::string numbered = name;
    for (int number = 2;; ++number) {
        const auto [known, is_new] = heard_.emplace(numbered, figures);
        if (is_new || known->second == figures) {
            return;
        }
        numbered = name + " (" + std::to_string(number) + ")";
    }
}

} // namespace gnomon::compiled
