// SPDX-License-Identifier: Apache-2.0
#include "completion_scene.h"

#include "files/files.h"

#include "scene/gltf.h"
#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <algorithm>

namespace gnomon::app {
namespace {

/// Larger files are not read for completion, so that nobody waits long.
constexpr std::uint64_t kMostBytes = 32U << 20U;

std::string sceneOf(std::span<const std::string> words)
{
    for (const std::string& word : words.first(words.empty() ? 0 : words.size() - 1)) {
        const bool is_world = worlds::find(word) != nullptr;
        if (is_world || hasExtension(word, ".gltf") || hasExtension(word, ".glb")) {
            return word;
        }
    }
    return "rts";
}

template <class Named>
void addNames(const std::vector<Named>& all, std::vector<std::string>& names)
{
    for (const Named& one : all) {
        if (!one.name.empty() && std::ranges::find(names, one.name) == names.end()) {
            names.push_back(one.name);
        }
    }
}

} // namespace

std::vector<std::string> namesInScene(std::string_view key, std::span<const std::string> words)
{
    scene::Limits limits;
    limits.max_file_bytes = kMostBytes;
    limits.max_total_bytes = kMostBytes;
    std::vector<std::string> names;
    try {
        const scene::Scene scene = worlds::load(sceneOf(words), 1, limits);
        if (key == "camera") {
            addNames(scene.views, names);
            addNames(scene.cameras, names);
        } else if (key == "light") {
            addNames(scene.lights, names);
        } else {
            addNames(scene.animations, names);
        }
    } catch (const Error&) { // the line itself will say so once it is run
        names.clear();
    }
    return names;
}

} // namespace gnomon::app
