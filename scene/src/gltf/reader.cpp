// SPDX-License-Identifier: Apache-2.0
// Based on: Khronos Group, "glTF 2.0 Specification", 2021, and the Khronos glTF validator's list of errors. The JSON is
// parsed by a library; everything after that is checked here, because a position in the file belongs to every message.
#include "gltf/document.h"
#include "gltf/uri.h"
#include "scene/state.h"

namespace gnomon::scene {

namespace {

Scene readBytes(gltf::Context& context, std::span<const std::byte> bytes, const std::string& name)
{
    const gltf::Container container = gltf::openContainer(context, bytes);
    const JsonTree<nlohmann::json> json = gltf::parseJson(context, container.json);
    gltf::Document document{.root = gltf::JsonView(context, json.root(), ""), .container = container};
    document.scene.name = name;
    gltf::readAsset(document);
    gltf::readBuffers(document);
    gltf::readAccessors(document);
    gltf::readImages(document);
    gltf::readTextures(document);
    gltf::readMaterials(document);
    gltf::readMeshes(document);
    gltf::readCameras(document);
    gltf::readLights(document);
    gltf::readNodes(document);
    gltf::readSkins(document);
    gltf::readAnimations(document);
    document.scene.notices = context.takeNotices();
    finishScene(document.scene);
    return std::move(document.scene);
}

} // namespace

Scene readGltf(const std::filesystem::path& file, const Limits& limits)
{
    // A bare file name has no parent; its folder is the working directory.
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    gltf::Context context(file.string(), folder, limits);
    const std::vector<std::byte> bytes = gltf::readFile(context, file, gltf::kWholeFile);
    if (bytes.empty()) {
        context.fail(gltf::kWholeFile, "the file is empty", "0 bytes");
    }
    return readBytes(context, bytes, file.stem().string());
}

Scene readGltf(std::span<const std::byte> bytes, const std::filesystem::path& folder, const Limits& limits)
{
    gltf::Context context("a scene from memory", folder, limits);
    context.checkFileBytes(bytes.size(), gltf::kWholeFile);
    context.noteFile(bytes.size());
    context.chargeBytes(bytes.size(), gltf::kWholeFile);
    return readBytes(context, bytes, "memory");
}

} // namespace gnomon::scene
