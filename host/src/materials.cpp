// SPDX-License-Identifier: Apache-2.0
#include "materials.h"

#include <gnomon/shared/alpha_cutoff.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace gnomon::host {
namespace {

std::array<const scene::TextureUse*, 5> usesOf(const scene::Material& m)
{
    return {&m.base_colour_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
            &m.emissive_texture};
}

MaterialData dataOf(const scene::Material& m)
{
    MaterialData data{};
    data.base_colour = m.base_colour;
    data.emissive = glm::vec4(m.emissive, m.normal_scale);
    data.numbers = {m.metallic, m.roughness, m.occlusion_strength, shared::alphaLimit(m.alpha_cutoff)};
    float model = m.model == scene::ShadingModel::phong ? 1.0F : 0.0F;
    model = m.model == scene::ShadingModel::unlit ? 2.0F : model;
    data.model = {model, m.phong_exponent, m.lit_by_night, m.stained ? 1.0F : 0.0F};
    const auto uses = usesOf(m);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        // KHR_texture_transform: scaled, then turned counter-clockwise in texture space (v down), then moved.
        const scene::TextureUse& use = *uses[i];
        const float c = std::cos(use.rotation_rad);
        const float s = std::sin(use.rotation_rad);
        const float other = use.uv_set == m.base_colour_texture.uv_set ? 0.0F : 1.0F;
        data.places[i] = {glm::vec4{c * use.scale.x, s * use.scale.y, use.offset.x, other},
                          glm::vec4{-s * use.scale.x, c * use.scale.y, use.offset.y, 0.0F}};
    }
    return data;
}

MaterialFacts factsOf(const scene::Material& m)
{
    MaterialFacts facts;
    const auto has = [](const scene::TextureUse& use) {
        return use.texture != scene::kNone;
    };
    const bool masked = m.alpha_mode == scene::AlphaMode::mask;
    if (has(m.metallic_roughness_texture) || has(m.normal_texture) || has(m.occlusion_texture)) {
        facts.kind = masked ? SurfaceKind::full_masked : SurfaceKind::full;
    } else if (masked) {
        facts.kind = SurfaceKind::masked;
    } else {
        facts.kind = has(m.base_colour_texture) ? SurfaceKind::textured : SurfaceKind::plain;
    }
    facts.two_sided = m.double_sided;
    facts.blended = m.alpha_mode == scene::AlphaMode::blend;
    facts.fades = m.model == scene::ShadingModel::horizon;
    facts.physical = m.model == scene::ShadingModel::metallic_roughness || facts.fades;
    facts.emits = std::max({m.emissive.x, m.emissive.y, m.emissive.z}) > 0.0F;
    return facts;
}

} // namespace

Materials::Materials(const Gpu& gpu, Memory& memory, Uploader& uploader, Textures& textures, const scene::Scene& scene)
    : gpu_(gpu), device_(gpu.view().device)
{
    makeLayouts(memory.names());
    const auto count = static_cast<std::uint32_t>(scene.materials.size()) + 1;
    const VkDeviceSize alignment = std::max<VkDeviceSize>(gpu.properties().limits.minUniformBufferOffsetAlignment, 1);
    const VkDeviceSize stride = (sizeof(MaterialData) + alignment - 1) / alignment * alignment;
    data_ = memory.buffer("scene materials", stride * count,
                          VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, Place::device);
    const std::array<VkDescriptorPoolSize, 2> sizes{
        {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * 6}}};
    VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    pool_info.maxSets = count * 2;
    pool_info.poolSizeCount = sizes.size();
    pool_info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device_, &pool_info, nullptr, &pool), "making a descriptor pool");
    pool_ = {gpu, pool};
    memory.names().name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, "materials");

    std::vector<char> bytes(stride * count);
    const scene::Material fallback;
    for (std::uint32_t i = 0; i < count; ++i) {
        const scene::Material& material = i + 1 < count ? scene.materials[i] : fallback;
        MaterialFacts facts = factsOf(material);
        const MaterialData data = dataOf(material);
        std::memcpy(bytes.data() + stride * i, &data, sizeof data);
        writeSet(material, textures, stride * i, facts);
        facts_.push_back(facts);
    }
    uploader.toBuffer(data_, 0, bytes.data(), bytes.size());
}

OwnedSetLayout Materials::makeLayout(std::span<const VkDescriptorSetLayoutBinding> bindings) const
{
    VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device_, &info, nullptr, &layout), "making a descriptor set layout");
    return {gpu_, layout};
}

void Materials::makeLayouts(const DebugNames& names)
{
    std::array<VkDescriptorSetLayoutBinding, 6> bindings{};
    bindings[0] = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT,
                   nullptr};
    for (std::uint32_t i = 1; i < bindings.size(); ++i) {
        bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    }
    layout_ = makeLayout(bindings);
    names.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout_.get(), "material");
    const VkDescriptorSetLayoutBinding one{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                           VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    caster_layout_ = makeLayout({&one, 1});
    names.name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, caster_layout_.get(), "masked caster");
}

void Materials::writeSet(const scene::Material& material, Textures& textures, VkDeviceSize offset, MaterialFacts& facts)
{
    const bool sampled = material.alpha_mode != scene::AlphaMode::opaque;
    const std::array<VkDescriptorSetLayout, 2> layouts{layout_.get(), caster_layout_.get()};
    std::array<VkDescriptorSet, 2> sets{};
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = sampled ? 2 : 1;
    info.pSetLayouts = layouts.data();
    check(vkAllocateDescriptorSets(device_, &info, sets.data()), "making a descriptor set");
    facts.set = sets[0];
    facts.caster_set = sets[1];

    using Role = Textures::Role;
    constexpr std::array<Role, 5> kRoles{Role::colour, Role::data, Role::normal, Role::data, Role::colour};
    const VkDescriptorBufferInfo buffer{data_.handle, offset, sizeof(MaterialData)};
    std::array<VkDescriptorImageInfo, 5> images{};
    std::array<VkWriteDescriptorSet, 7> writes{};
    writes[0] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, nullptr, sets[0], 0,      0, 1,
                 VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,      nullptr, &buffer, nullptr};
    const auto uses = usesOf(material);
    for (std::uint32_t i = 0; i < 5; ++i) {
        images[i] = textures.use(*uses[i], kRoles[i]);
        writes[i + 1] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,    nullptr,    sets[0], i + 1,  0, 1,
                         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, &images[i], nullptr, nullptr};
    }
    writes[6] = writes[1];
    writes[6].dstSet = sets[1];
    writes[6].dstBinding = 0;
    vkUpdateDescriptorSets(device_, sampled ? 7 : 6, writes.data(), 0, nullptr);
}

} // namespace gnomon::host
