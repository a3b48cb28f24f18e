// SPDX-License-Identifier: Apache-2.0
#include "scene/load.h"

#include "scene/worlds.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <system_error>

namespace gnomon::scene {

namespace {

constexpr std::array<World, 6> kWorlds{{
    {"rts", "a strategy game's map: 400 walking units, a camp, groves, floating debris, one sun (Marinescu 2011)",
     &makeRts},
    {"sundial", "a meadow with trees, fences and a house under a sun and a moon on their courses (Fortier 2010)",
     &makeSundial},
    {"ring", "a space station bent into a ring: 89 point lights inside lamps, tiles, walkers, plants (Forsyth 2006)",
     &makeRing},
    {"spotlit", "sculpture on a stage under three spot lights with cookies (Shastry 2005)", &makeSpotlit},
    {"canopies", "three roofs over each other, where averaged maps let light through; closed-form answers",
     &makeCanopies},
    {"planes", "one box above one plane, a sun and a spot light, with closed-form answers", &makePlanes},
}};

/// What other models come in, in lower case. A glTF file may have any other name.
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

/// Null where no world has the name.
const World* worldOf(std::string_view name)
{
    const auto* const world =
        std::find_if(kWorlds.begin(), kWorlds.end(), [&](const World& w) { return w.name == name; });
    return world != kWorlds.end() ? world : nullptr;
}

} // namespace

std::span<const World> worlds()
{
    return kWorlds;
}

void requireThere(std::string_view name_or_file)
{
    if (worldOf(name_or_file) != nullptr) {
        return;
    }
    std::string names;
    for (const World& world : kWorlds) {
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

Scene load(std::string_view name_or_file, std::uint64_t seed, const Limits& limits)
{
    requireThere(name_or_file);
    const World* const world = worldOf(name_or_file);
    return world != nullptr ? world->make(seed) : readGltf(std::filesystem::path{std::string(name_or_file)}, limits);
}

} // namespace gnomon::scene
