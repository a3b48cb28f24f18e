// SPDX-License-Identifier: Apache-2.0
#include "gltf/document.h"

#include <algorithm>

namespace gnomon::scene::gltf {

namespace {

constexpr std::string_view kSupported[] = {"KHR_lights_punctual",
                                           "KHR_texture_transform",
                                           "KHR_materials_unlit",
                                           "KHR_materials_emissive_strength",
                                           "KHR_materials_pbrSpecularGlossiness",
                                           "KHR_mesh_quantization",
                                           "KHR_draco_mesh_compression",
                                           "EXT_meshopt_compression",
                                           "KHR_meshopt_compression",
                                           "EXT_texture_webp",
                                           "KHR_node_visibility",
                                           "EXT_mesh_gpu_instancing"};

/// Without effect here, and a file may require them: they change neither where surfaces are nor where these are seen
/// through, or a notice says that they do, as of textures in formats without a decoder. So may all whose second word
/// is "materials".
constexpr std::string_view kLeavesGeometry[] = {"KHR_xmp",
                                                "KHR_xmp_json_ld",
                                                "KHR_texture_basisu",
                                                "EXT_texture_avif",
                                                "MSFT_texture_dds",
                                                "KHR_node_selectability",
                                                "KHR_node_hoverability",
                                                "KHR_interactivity",
                                                "KHR_audio_emitter",
                                                "KHR_implicit_shapes",
                                                "KHR_physics_rigid_bodies",
                                                "EXT_lights_ies",
                                                "EXT_lights_image_based",
                                                "EXT_mesh_features",
                                                "EXT_instance_features",
                                                "EXT_structural_metadata",
                                                "EXT_mesh_manifold",
                                                "EXT_mesh_primitive_edge_visibility",
                                                "ADOBE_physical_properties",
                                                "AGI_articulations",
                                                "AGI_stk_metadata",
                                                "CESIUM_primitive_outline",
                                                "FB_geometry_metadata",
                                                "GODOT_single_root",
                                                "MSFT_lod",
                                                "MSFT_packing_normalRoughnessMetallic",
                                                "MSFT_packing_occlusionRoughnessMetallic",
                                                "OMI_physics_body",
                                                "OMI_physics_shape",
                                                "VRM",
                                                "VRMC_vrm",
                                                "VRMC_springBone"};

struct Rule {
    std::string_view name; // or its start
    Place first;
    Place second; // the same where there is one place only
};
constexpr Rule kPlaces[] = {
    {"KHR_lights_punctual", Place::root, Place::node},
    {"KHR_texture_transform", Place::texture_info, Place::texture_info},
    {"KHR_materials_variants", Place::root, Place::primitive}, // before the prefix below: it stands on primitives
    {"KHR_materials_", Place::material, Place::material},
    {"EXT_mesh_gpu_instancing", Place::node, Place::node},
    {"KHR_node_visibility", Place::node, Place::node},
    {"KHR_animation_pointer", Place::channel_target, Place::channel_target},
    {"KHR_draco_mesh_compression", Place::primitive, Place::primitive},
    {"EXT_meshopt_compression", Place::buffer, Place::buffer_view},
    {"KHR_meshopt_compression", Place::buffer, Place::buffer_view},
    {"EXT_texture_", Place::texture, Place::texture},
    {"KHR_texture_basisu", Place::texture, Place::texture},
    {"MSFT_texture_dds", Place::texture, Place::texture},
};

bool isSupported(std::string_view name)
{
    return std::find(std::begin(kSupported), std::end(kSupported), name) != std::end(kSupported);
}

bool leavesGeometry(std::string_view name)
{
    const std::string_view behind_vendor = name.substr(std::min(name.find('_'), name.size()));
    return behind_vendor.starts_with("_materials_") ||
           std::find(std::begin(kLeavesGeometry), std::end(kLeavesGeometry), name) != std::end(kLeavesGeometry);
}

std::string supportedNames()
{
    std::string names;
    for (const std::string_view& name : kSupported) {
        const bool last = &name == std::end(kSupported) - 1;
        names += std::string(names.empty() ? "" : last ? " and " : ", ") + std::string(name);
    }
    return names;
}

struct Version {
    std::uint64_t major = 0;
    std::uint64_t minor = 0;
};

Version readVersion(const JsonView& view)
{
    const std::string text = view.string();
    const std::size_t dot = text.find('.');
    const auto digits = [](const std::string& part) {
        return !part.empty() && part.size() < 10 &&
               std::all_of(part.begin(), part.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    if (dot == std::string::npos || !digits(text.substr(0, dot)) || !digits(text.substr(dot + 1))) {
        view.fail("the version must have the form 2.0");
    }
    return {std::stoull(text.substr(0, dot)), std::stoull(text.substr(dot + 1))};
}

void checkVersion(const JsonView& asset)
{
    const JsonView version = asset.at("version");
    const Version found = readVersion(version);
    if (found.major != 2) {
        version.fail("only glTF 2 is supported", "convert the file to glTF 2.0");
    }
    if (const std::optional<JsonView> minimum = asset.find("minVersion")) {
        const Version needed = readVersion(*minimum);
        if (needed.major != 2 || needed.minor > 0) {
            minimum->fail("the file needs a reader of a newer version than 2.0");
        }
    }
    if (found.minor > 0) {
        asset.context().notice("the file is of a newer version than 2.0; what is new in it has no effect");
    }
}

/// The strings of an array, which must differ.
std::set<std::string> readNames(const JsonView& root, const char* key)
{
    std::set<std::string> names;
    const std::optional<JsonView> list = root.find(key);
    const std::size_t count = list ? list->size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!names.insert(list->element(i).string()).second) {
            list->element(i).fail("an extension is named twice");
        }
    }
    return names;
}

} // namespace

std::size_t topLevelCount(const Document& document, const char* key)
{
    const std::optional<JsonView> list = document.root.find(key);
    return list ? list->size() : 0;
}

std::optional<JsonView> extension(const JsonView& object, const char* name)
{
    const std::optional<JsonView> extensions = object.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

void checkExtensions(const JsonView& object, Place place)
{
    const std::optional<JsonView> extensions = object.find("extensions");
    if (!extensions) {
        return;
    }
    extensions->expectObject();
    for (const auto& [name, value] : extensions->value().items()) {
        const std::string& key = name;
        const auto* rule = std::find_if(std::begin(kPlaces), std::end(kPlaces),
                                        [&](const Rule& r) { return std::string_view(key).starts_with(r.name); });
        if (rule != std::end(kPlaces) && place != rule->first && place != rule->second) {
            extensions->at(name).failFound("this extension has no meaning here", "'" + escapeKey(name) + "'");
        }
    }
}

void noticeStride(const Document& document, const Accessor& accessor, const std::string& what)
{
    const std::uint32_t stride = accessor.view == kNone ? 0 : document.views[accessor.view].stride;
    if (stride != 0) {
        document.context().notice("buffer view " + std::to_string(accessor.view) + " with " + what +
                                  " has a byteStride; they are taken as " +
                                  (accessor.stride == stride ? "it says" : "packed"));
    }
}

void readAsset(Document& document)
{
    const JsonView& root = document.root;
    root.expectObject();
    checkVersion(root.at("asset"));
    checkExtensions(root.at("asset"), Place::other);
    checkExtensions(root, Place::root);
    const std::set<std::string> used = readNames(root, "extensionsUsed");
    static_cast<void>(readNames(root, "extensionsRequired")); // each once
    const std::optional<JsonView> required = root.find("extensionsRequired");
    const std::size_t required_count = required ? required->size() : 0;
    for (std::size_t i = 0; i < required_count; ++i) {
        const JsonView view = required->element(i);
        if (!isSupported(view.string()) && !leavesGeometry(view.string())) {
            view.fail("the file requires an extension that is not supported",
                      "export the scene without it; supported are " + supportedNames());
        }
        if (!used.contains(view.string())) {
            view.fail("a required extension must be among extensionsUsed");
        }
    }
    for (const std::string& name : used) {
        if (!isSupported(name)) {
            document.context().notice("extension " + escapeKey(name) + " has no effect");
        }
    }
    document.quantization = used.contains("KHR_mesh_quantization");
}

} // namespace gnomon::scene::gltf
