// SPDX-License-Identifier: Apache-2.0
#include "worlds/worlds.h"


#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <system_error>

namespace gnomon::worlds {

namespace {

/// Extensions of other models' formats, in lower case. A glTF file may have any other name.
constexpr std::array<std::string_view, 15> kOtherFormats{".3ds",  ".abc", ".blend", ".dae",  ".fbx",
                                                         ".jpeg", ".jpg", ".obj",   ".ply",  ".png",
                                                         ".stl",  ".usd", ".usda",  ".usdc", ".usdz"};

bool isOfAnotherFormat(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::find(kOtherFormats.begin(), kOtherFormats.end(), extension) != kOtherFormats.end();
}

} // namespace

void requireThere(std::string_view name_or_file)
{
    if (find(name_or_file) != nullptr) {
        return;
    }
    std::string names;
    for (const World& world : all()) {
        names += (names.empty() ? "" : ", ") + std::string(world.name);
    }
    const std::filesystem::path file{std::string(name_or_file)};
    const std::string tried = "loading scene '" + std::string(name_or_file) + "'";
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status)) {
        throw Error(tried, "it is a directory", "give a .gltf or .glb file, or one of the built-in worlds: " + names);
    }
    if (!std::filesystem::exists(status)) {
        throw Error(tried, "it is no built-in world and no such file exists",
                    "give a .gltf or .glb file, or one of the built-in worlds: " + names);
    }
    if (isOfAnotherFormat(file)) {
        throw Error(tried, "a " + file.extension().string() + " file is no glTF",
                    "export the model as .glb or .gltf; in Blender that is File > Export > glTF 2.0");
    }
}

scene::Scene load(std::string_view name_or_file, std::uint64_t seed, const scene::Limits& limits)
{
    requireThere(name_or_file);
    const World* const world = find(name_or_file);
    return world != nullptr ? world->make(seed) : scene::readGltf(std::filesystem::path{std::string(name_or_file)}, limits);
}

} // namespace gnomon::worlds
