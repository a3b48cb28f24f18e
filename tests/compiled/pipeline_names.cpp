// SPDX-License-Identifier: Apache-2.0
#include "pipeline_names.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

namespace gnomon::compiled {
namespace {

/// A constant of a module: what it is called, and the value at which nothing is said of it.
struct Constant {
    const char* name;
    std::uint32_t usual;
};

constexpr Constant kMaskConstants[] = {
    {"kernel", 3},       {"taps", 16},   {"automatic bias", 1}, {"flags", 0},    {"sampling", 0}, {"layers", 0},
    {"holding", 0},      {"views", 0},   {"filter", 0},         {"normals", 1},  {"software", 0}, {"smooth", 0},
    {"tints", 0},        {"rays", 0},    {"frames", 0},         {"coloured", 0}, {"tiles", 0},    {"takes away", 0},
    {"paraboloid", 0},   {"ids", 0},     {"slices", 0},         {"paired", 0},   {"pixels", 1},   {"layered", 0},
    {"orthographic", 0}, {"settles", 0}, {"pages", 0}}; // mask.frag, in its order
constexpr Constant kCasterConstants[] = {{"holding", 0},     {"quantum", 0},  {"coloured", 0}, {"masked", 0},
                                         {"perspective", 0}, {"metric", 0},   {"ids", 0},      {"paraboloid", 0},
                                         {"placed", 0},      {"own depth", 0}}; // CasterConstants

std::span<const Constant> constantsOf(std::string_view module)
{
    const bool is_mask = module.starts_with("mask_") && module.ends_with(".frag") && module != "mask_spread.frag";
    const bool is_caster = module.starts_with("caster");
    return is_mask     ? std::span<const Constant>(kMaskConstants)
           : is_caster ? std::span<const Constant>(kCasterConstants)
                       : std::span<const Constant>();
}

/// A constant is a small whole number or a float.
std::string valueText(std::uint32_t value)
{
    constexpr std::uint32_t kSmallFloat = 0x30000000; // 5e-10
    if (value < kSmallFloat || static_cast<std::int32_t>(value) < 0) {
        return std::to_string(static_cast<std::int32_t>(value));
    }
    std::ostringstream text;
    text << std::bit_cast<float>(value);
    return text.str();
}

std::string constantsText(const VkSpecializationInfo* info, std::string_view module)
{
    if (info == nullptr) {
        return "";
    }
    const std::span<const Constant> known = constantsOf(module);
    std::string text;
    for (const VkSpecializationMapEntry& entry : std::span(info->pMapEntries, info->mapEntryCount)) {
        std::uint32_t value = 0;
        std::memcpy(&value, static_cast<const char*>(info->pData) + entry.offset, sizeof value);
        const bool has_name = entry.constantID < known.size();
        if (value != (has_name ? known[entry.constantID].usual : 0)) {
            text += (text.empty() ? "" : ", ") +
                    (has_name ? std::string(known[entry.constantID].name) : std::to_string(entry.constantID)) + " " +
                    valueText(value);
        }
    }
    return text.empty() ? "" : "; " + text;
}

std::string formatName(VkFormat format)
{
    constexpr std::pair<VkFormat, const char*> kNames[] = {{VK_FORMAT_R8_UNORM, "R8"},
                                                           {VK_FORMAT_R8G8B8A8_UNORM, "RGBA8"},
                                                           {VK_FORMAT_R16_UNORM, "R16"},
                                                           {VK_FORMAT_R16G16_UNORM, "RG16"},
                                                           {VK_FORMAT_R16G16B16A16_UNORM, "RGBA16"},
                                                           {VK_FORMAT_R16_SFLOAT, "R16F"},
                                                           {VK_FORMAT_R16G16_SFLOAT, "RG16F"},
                                                           {VK_FORMAT_R16G16B16A16_SFLOAT, "RGBA16F"},
                                                           {VK_FORMAT_R32_SFLOAT, "R32F"},
                                                           {VK_FORMAT_R32G32_SFLOAT, "RG32F"},
                                                           {VK_FORMAT_R32G32B32A32_SFLOAT, "RGBA32F"},
                                                           {VK_FORMAT_R32_UINT, "R32U"},
                                                           {VK_FORMAT_R16G16_SNORM, "RG16S"},
                                                           {VK_FORMAT_R16G16B16A16_SNORM, "RGBA16S"},
                                                           {VK_FORMAT_R32G32B32A32_UINT, "RGBA32U"},
                                                           {VK_FORMAT_D16_UNORM, "D16"},
                                                           {VK_FORMAT_D32_SFLOAT, "D32"},
                                                           {VK_FORMAT_D32_SFLOAT_S8_UINT, "D32_S8"},
                                                           {VK_FORMAT_D24_UNORM_S8_UINT, "D24_S8"}};
    const auto* const found = std::ranges::find(kNames, format, &std::pair<VkFormat, const char*>::first);
    return found != std::end(kNames) ? found->second : "format " + std::to_string(format);
}

template <class Info>
const Info* chained(const void* next, VkStructureType type)
{
    for (auto* one = static_cast<const VkBaseInStructure*>(next); one != nullptr; one = one->pNext) {
        if (one->sType == type) {
            return reinterpret_cast<const Info*>(one);
        }
    }
    return nullptr;
}

/// The targets of a pipeline, and how it draws to them.
std::string targetsText(const VkGraphicsPipelineCreateInfo& info)
{
    const auto* const rendering =
        chained<VkPipelineRenderingCreateInfo>(info.pNext, VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    std::string text;
    const auto add = [&](const std::string& word) {
        text += (text.empty() ? " to " : " + ") + word;
    };
    for (std::uint32_t i = 0; rendering != nullptr && i < rendering->colorAttachmentCount; ++i) {
        const VkPipelineColorBlendAttachmentState& blend = info.pColorBlendState->pAttachments[i];
        std::string word = formatName(rendering->pColorAttachmentFormats[i]);
        if (blend.colorWriteMask != 15U) {
            word += " channels " + std::to_string(blend.colorWriteMask);
        }
        add(word + (blend.blendEnable == VK_TRUE ? " blended" : ""));
    }
    if (rendering != nullptr && rendering->depthAttachmentFormat != VK_FORMAT_UNDEFINED) {
        add(formatName(rendering->depthAttachmentFormat));
    }
    if (info.pMultisampleState->rasterizationSamples > 1) {
        text += " x" + std::to_string(info.pMultisampleState->rasterizationSamples);
    }
    return text;
}

std::string vertexFormatsText(const VkPipelineVertexInputStateCreateInfo& input)
{
    std::string text;
    for (const auto& one : std::span(input.pVertexAttributeDescriptions, input.vertexAttributeDescriptionCount)) {
        const bool is_usual = one.format == VK_FORMAT_R32G32B32_SFLOAT || one.format == VK_FORMAT_R32G32B32A32_SFLOAT ||
                              one.format == VK_FORMAT_R32G32_SFLOAT;
        text += is_usual ? "" : " " + formatName(one.format);
    }
    return text.empty() ? "" : " of" + text;
}

std::string rasterText(const VkPipelineRasterizationStateCreateInfo& raster)
{
    constexpr const char* kCulled[] = {"", " without front faces", " without back faces", " without faces"};
    return kCulled[raster.cullMode & 3U];
}

} // namespace

std::string nameOf(const ModuleNames& names, const VkShaderModuleCreateInfo& module)
{
    const auto found = names.find(module.pCode);
    return found != names.end() ? found->second : std::string();
}

StageNames namesOf(const VkGraphicsPipelineCreateInfo& info, const MadeModules& modules)
{
    const std::span<const VkPipelineShaderStageCreateInfo> stages(info.pStages, info.stageCount);
    StageNames names;
    for (const VkPipelineShaderStageCreateInfo& stage : stages) {
        names.modules.push_back(modules.at(stage.module));
    }
    // A driver compiles both stages together, so each is another one beside another one.
    const bool is_full_screen = stages.size() == 2 && info.pVertexInputState->vertexAttributeDescriptionCount == 0;
    std::string name = names.modules.back();
    if (stages.size() == 2 && !is_full_screen) {
        name = names.modules.front() + " + " + name;
    }
    name += vertexFormatsText(*info.pVertexInputState) + targetsText(info) + rasterText(*info.pRasterizationState);
    for (std::size_t i = is_full_screen ? 1 : 0; i < stages.size(); ++i) {
        names.labels[stages[i].stage] = (stages[i].stage == VK_SHADER_STAGE_VERTEX_BIT ? "vertex of " : "") + name +
                                        constantsText(stages[i].pSpecializationInfo, names.modules[i]);
    }
    return names;
}

StageNames namesOf(const VkComputePipelineCreateInfo& info, const MadeModules& modules)
{
    const std::string& module = modules.at(info.stage.module);
    StageNames names;
    names.modules.push_back(module);
    names.labels[info.stage.stage] = module + constantsText(info.stage.pSpecializationInfo, module);
    return names;
}

} // namespace gnomon::compiled
