// SPDX-License-Identifier: Apache-2.0
#include "gltf/document.h"

#include <glm/gtc/type_ptr.hpp>

namespace gnomon::scene::gltf {

namespace {

constexpr double kAny = std::numeric_limits<float>::max();

/// The transform may name another set of texture coordinates than its textureInfo does.
void readTransform(const JsonView& info, TextureUse& use)
{
    const std::optional<JsonView> transform = extension(info, "KHR_texture_transform");
    if (!transform) {
        return;
    }
    if (const std::optional<JsonView> offset = transform->find("offset")) {
        offset->numbers({glm::value_ptr(use.offset), 2});
    }
    if (const std::optional<JsonView> scale = transform->find("scale")) {
        scale->numbers({glm::value_ptr(use.scale), 2});
    }
    use.rotation_rad = transform->number("rotation", 0.0F, -kAny, kAny);
    use.uv_set = static_cast<std::uint32_t>(std::min<std::uint64_t>(transform->uint("texCoord", use.uv_set), kNone));
}

TextureUse readUse(const Document& document, const JsonView& parent, const char* key)
{
    TextureUse use;
    const std::optional<JsonView> info = parent.find(key);
    if (!info) {
        return use;
    }
    checkExtensions(*info, Place::texture_info);
    use.texture = info->at("index").index(document.scene.textures.size());
    use.uv_set = static_cast<std::uint32_t>(std::min<std::uint64_t>(info->uint("texCoord", 0), kNone));
    readTransform(*info, use);
    if (document.scene.textures[use.texture].image == kNone) {
        document.context().notice("texture of " + info->pointer() +
                                  " has no image that can be decoded and was left out");
        return {};
    }
    if (use.uv_set > 1) {
        document.context().notice("texture of " + info->pointer() + " uses TEXCOORD_" + std::to_string(use.uv_set) +
                                  "; only sets 0 and 1 are supported, so it was left out");
        return {};
    }
    return use;
}

void readMetallicRoughness(const Document& document, const JsonView& view, Material& material)
{
    checkExtensions(view, Place::other);
    if (const std::optional<JsonView> factor = view.find("baseColorFactor")) {
        factor->numbers({glm::value_ptr(material.base_colour), 4}, 0.0, 1.0);
    }
    material.metallic = view.number("metallicFactor", 1.0F, 0.0, 1.0);
    material.roughness = view.number("roughnessFactor", 1.0F, 0.0, 1.0);
    material.base_colour_texture = readUse(document, view, "baseColorTexture");
    material.metallic_roughness_texture = readUse(document, view, "metallicRoughnessTexture");
}

/// Reads the older model: diffuse colour with its alpha, and how smooth it is. It goes before
/// `pbrMetallicRoughness`, which is a substitute then.
void readSpecularGlossiness(const Document& document, const JsonView& view, Material& material)
{
    material.base_colour = glm::vec4(1.0F);
    if (const std::optional<JsonView> factor = view.find("diffuseFactor")) {
        factor->numbers({glm::value_ptr(material.base_colour), 4}, 0.0, 1.0);
    }
    material.base_colour_texture = readUse(document, view, "diffuseTexture");
    material.metallic = 0.0F;
    material.roughness = 1.0F - view.number("glossinessFactor", 1.0F, 0.0, 1.0);
    material.metallic_roughness_texture = {};
    if (view.has("specularFactor") || view.has("specularGlossinessTexture")) {
        document.context().notice("the specular colour of " + view.pointer() + " has no effect");
    }
}

void readAlpha(const JsonView& view, Material& material)
{
    const std::string mode = view.string("alphaMode", "OPAQUE");
    if (mode == "MASK") {
        material.alpha_mode = AlphaMode::mask;
    } else if (mode == "BLEND") {
        material.alpha_mode = AlphaMode::blend;
    } else if (mode != "OPAQUE") {
        // The specification leaves room for other modes; their fallback is OPAQUE.
        view.context().notice("unknown alphaMode in " + view.pointer() + " was taken as OPAQUE");
    }
    material.alpha_cutoff = view.number("alphaCutoff", 0.5F, 0.0, kAny);
}

void readEmission(const JsonView& view, Material& material)
{
    if (const std::optional<JsonView> factor = view.find("emissiveFactor")) {
        factor->numbers({glm::value_ptr(material.emissive), 3}, 0.0, 1.0);
    }
    if (const std::optional<JsonView> strength = extension(view, "KHR_materials_emissive_strength")) {
        material.emissive *= strength->number("emissiveStrength", 1.0F, 0.0, kAny);
    }
}

/// Without the alpha of its texture a leaf is a card, in the picture and in shadows: nobody may find out by that.
void noticeSolid(const JsonView& view, const Material& material, const std::optional<JsonView>& base_colour)
{
    if (base_colour && material.base_colour_texture.texture == kNone && material.alpha_mode != AlphaMode::opaque) {
        view.context().notice("material " + view.pointer() +
                              (material.name.empty() ? "" : " '" + escapeKey(material.name) + "'") +
                              " lacks the texture that says where it is seen through; without it there are no holes, "
                              "in the surface as in its shadow");
    }
}

Material readMaterial(const Document& document, const JsonView& view)
{
    checkExtensions(view, Place::material);
    Material material;
    material.name = view.string("name", "");
    const std::optional<JsonView> pbr = view.find("pbrMetallicRoughness");
    const std::optional<JsonView> older = extension(view, "KHR_materials_pbrSpecularGlossiness");
    if (pbr) {
        readMetallicRoughness(document, *pbr, material);
    }
    if (older) {
        readSpecularGlossiness(document, *older, material);
    }
    readAlpha(view, material);
    noticeSolid(view, material,
                older ? older->find("diffuseTexture")
                : pbr ? pbr->find("baseColorTexture")
                      : std::nullopt);
    readEmission(view, material);
    material.double_sided = view.boolean("doubleSided", false);
    material.normal_texture = readUse(document, view, "normalTexture");
    material.occlusion_texture = readUse(document, view, "occlusionTexture");
    material.emissive_texture = readUse(document, view, "emissiveTexture");
    if (view.has("emissiveTexture") && material.emissive_texture.texture == kNone) {
        material.emissive = glm::vec3(0.0F); // rather dark than bright all over
    }
    if (const std::optional<JsonView> info = view.find("normalTexture")) {
        material.normal_scale = info->number("scale", 1.0F, -kAny, kAny);
    }
    if (const std::optional<JsonView> info = view.find("occlusionTexture")) {
        material.occlusion_strength = info->number("strength", 1.0F, 0.0, 1.0);
    }
    if (const std::optional<JsonView> unlit = extension(view, "KHR_materials_unlit")) {
        unlit->expectObject();
        material.model = ShadingModel::unlit;
    }
    return material;
}

} // namespace

void readMaterials(Document& document)
{
    const std::size_t count = topLevelCount(document, "materials");
    for (std::size_t i = 0; i < count; ++i) {
        document.scene.materials.push_back(readMaterial(document, document.root.at("materials").element(i)));
    }
}

} // namespace gnomon::scene::gltf
