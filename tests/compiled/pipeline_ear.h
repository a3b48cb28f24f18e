// SPDX-License-Identifier: Apache-2.0
// Stands between the library and a driver, and has each pipeline that the library makes there made by an AmdDevice,
// too: of the same modules, constants, layouts and formats. So what is compiled is what a host on such a GPU gets.
#pragma once

#include "amd_device.h"
#include "pipeline_names.h"

#include <gnomon/vulkan/device_view.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace gnomon::compiled {

/// By StageNames.
using CompiledStages = std::map<std::string, Figures>;

/// There is one at a time.
class PipelineEar {
public:
    /// `below` does everything, but what the library asks of the physical device `device` answers.
    PipelineEar(const vulkan::DeviceView& below, const ModuleNames& modules, AmdDevice& device);
    ~PipelineEar();
    PipelineEar(const PipelineEar&) = delete;
    PipelineEar& operator=(const PipelineEar&) = delete;

    [[nodiscard]] vulkan::DeviceView view() const;
    [[nodiscard]] const CompiledStages& heard() const { return heard_; }
    /// Names of the modules that some pipeline was made of.
    [[nodiscard]] const std::set<std::string>& modules() const { return used_; }
    /// A line for each pipeline that was not compiled.
    [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

private:
    struct Calls;

    template <class Handle>
    [[nodiscard]] Handle real(Handle below) const;
    template <class Handle>
    void keep(Handle below, Handle made);
    [[nodiscard]] VkPipelineShaderStageCreateInfo realStage(VkPipelineShaderStageCreateInfo stage) const;
    [[nodiscard]] VkPipeline make(VkGraphicsPipelineCreateInfo info) const;
    [[nodiscard]] VkPipeline make(VkComputePipelineCreateInfo info) const;
    void hear(VkPipeline made, const StageNames& names);
    void keepFigures(const std::string& name, const Figures& figures);

    static PipelineEar* listening;

    vulkan::DeviceView below_;
    AmdDevice& device_;
    const ModuleNames& names_;
    std::unordered_map<std::uint64_t, std::uint64_t> handles_; // of the device, by those below
    MadeModules modules_;
    CompiledStages heard_;
    std::set<std::string> used_;
    std::vector<std::string> faults_;
    std::vector<VkShaderModule> made_modules_;
    std::vector<VkSampler> made_samplers_;
    std::vector<VkDescriptorSetLayout> made_set_layouts_;
    std::vector<VkPipelineLayout> made_layouts_;
};

} // namespace gnomon::compiled
