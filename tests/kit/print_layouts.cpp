// SPDX-License-Identifier: Apache-2.0
// Prints each module that is in some pipeline of the library, and what vulkan/ binds for it, a line each: "MODULE",
// "MODULE SET BINDING TYPE", with the number of the VkDescriptorType, and "MODULE push BYTES". A line comes once.
// tests/kit/test_kit.py holds passes.json to it.
#include "library_pipelines.h"
#include "null_driver.h"
#include "pipeline_names.h"

#include <gnomon_classic_spirv.h>
#include <gnomon_spirv.h>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace gnomon::compiled {
namespace {

struct Layout {
    std::vector<VkDescriptorSetLayout> sets;
    std::vector<VkPushConstantRange> pushes;
};

/// The layouts that the library has made. Its functions call those below and note what they were given.
struct Listener {
    vulkan::DeviceView below;
    ModuleNames names;
    MadeModules modules;
    std::unordered_map<VkDescriptorSetLayout, std::vector<VkDescriptorSetLayoutBinding>> sets;
    std::unordered_map<VkPipelineLayout, Layout> layouts;
    std::set<std::string> lines;

    void note(const VkPipelineShaderStageCreateInfo& stage, VkPipelineLayout used)
    {
        const std::string& module = modules.at(stage.module);
        const Layout& layout = layouts.at(used);
        lines.insert(module);
        for (std::size_t set = 0; set < layout.sets.size(); ++set) {
            for (const VkDescriptorSetLayoutBinding& one : sets.at(layout.sets[set])) {
                if ((one.stageFlags & stage.stage) != 0) {
                    lines.insert(module + ' ' + std::to_string(set) + ' ' + std::to_string(one.binding) + ' ' +
                                 std::to_string(one.descriptorType));
                }
            }
        }
        for (const VkPushConstantRange& range : layout.pushes) {
            if ((range.stageFlags & stage.stage) != 0) {
                lines.insert(module + " push " + std::to_string(range.offset + range.size));
            }
        }
    }
};

Listener& listener()
{
    static Listener one;
    return one;
}

template <class Function>
Function below(const char* name)
{
    const vulkan::DeviceView& view = listener().below;
    return reinterpret_cast<Function>(view.get_instance_proc_addr(view.instance, name));
}

VKAPI_ATTR VkResult VKAPI_CALL makeModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                          const VkAllocationCallbacks* host, VkShaderModule* made)
{
    const VkResult result = below<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device, info, host, made);
    listener().modules[*made] = nameOf(listener().names, *info);
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL makeSet(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                       const VkAllocationCallbacks* host, VkDescriptorSetLayout* made)
{
    const VkResult result =
        below<PFN_vkCreateDescriptorSetLayout>("vkCreateDescriptorSetLayout")(device, info, host, made);
    listener().sets[*made] = {info->pBindings, info->pBindings + info->bindingCount};
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL makeLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                          const VkAllocationCallbacks* host, VkPipelineLayout* made)
{
    const VkResult result = below<PFN_vkCreatePipelineLayout>("vkCreatePipelineLayout")(device, info, host, made);
    listener().layouts[*made] = {{info->pSetLayouts, info->pSetLayouts + info->setLayoutCount},
                                 {info->pPushConstantRanges, info->pPushConstantRanges + info->pushConstantRangeCount}};
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL makeGraphics(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                            const VkGraphicsPipelineCreateInfo* infos,
                                            const VkAllocationCallbacks* host, VkPipeline* made)
{
    for (const VkGraphicsPipelineCreateInfo& info : std::span(infos, count)) {
        for (const VkPipelineShaderStageCreateInfo& stage : std::span(info.pStages, info.stageCount)) {
            listener().note(stage, info.layout);
        }
    }
    return below<PFN_vkCreateGraphicsPipelines>("vkCreateGraphicsPipelines")(device, cache, count, infos, host, made);
}

VKAPI_ATTR VkResult VKAPI_CALL makeCompute(VkDevice device, VkPipelineCache cache, std::uint32_t count,
                                           const VkComputePipelineCreateInfo* infos, const VkAllocationCallbacks* host,
                                           VkPipeline* made)
{
    for (const VkComputePipelineCreateInfo& info : std::span(infos, count)) {
        listener().note(info.stage, info.layout);
    }
    return below<PFN_vkCreateComputePipelines>("vkCreateComputePipelines")(device, cache, count, infos, host, made);
}

PFN_vkVoidFunction VKAPI_CALL ofInstance(VkInstance instance, const char* name);

PFN_vkVoidFunction VKAPI_CALL ofDevice(VkDevice, const char* name)
{
    return ofInstance(listener().below.instance, name);
}

PFN_vkVoidFunction VKAPI_CALL ofInstance(VkInstance instance, const char* name)
{
    const auto entry = [](auto function) {
        return reinterpret_cast<PFN_vkVoidFunction>(function);
    };
    const std::pair<const char*, PFN_vkVoidFunction> ours[] = {
        {"vkGetDeviceProcAddr", entry(&ofDevice)},           {"vkCreateShaderModule", entry(&makeModule)},
        {"vkCreateDescriptorSetLayout", entry(&makeSet)},    {"vkCreatePipelineLayout", entry(&makeLayout)},
        {"vkCreateGraphicsPipelines", entry(&makeGraphics)}, {"vkCreateComputePipelines", entry(&makeCompute)}};
    for (const auto& [known, function] : ours) {
        if (std::strcmp(known, name) == 0) {
            return function;
        }
    }
    return listener().below.get_instance_proc_addr(instance, name);
}

void print()
{
    const auto add = [](const auto& modules, const auto& called) {
        for (std::size_t i = 0; i < std::size(modules); ++i) {
            listener().names[modules[i]->data()] = called[i];
        }
    };
    add(spirv::all_of_gnomon_spirv, spirv::names_of_gnomon_spirv);
    add(spirv::all_of_gnomon_classic_spirv, spirv::names_of_gnomon_classic_spirv);
    test::NullDriver driver;
    listener().below = driver.view();
    vulkan::DeviceView view = driver.view();
    view.get_instance_proc_addr = &ofInstance;
    makeLibraryPipelines(view, driver);
    for (const std::string& line : listener().lines) {
        std::cout << line << '\n';
    }
}

} // namespace
} // namespace gnomon::compiled

int main()
{
    gnomon::compiled::print();
}
