// SPDX-License-Identifier: Apache-2.0
// Scenes that others made: every one loads, and holds as many triangles as its description says.
#include "support.h"

namespace gnomon::scene::test {
namespace {

namespace fs = std::filesystem;

struct Expected {
    const char* path; // a file, or a folder whose files add up
    std::size_t files;
    std::size_t triangles;
};
constexpr Expected kScenes[] = {
    {"truck_town", 1, 36167},
    {"kenney_city", 1, 21808},
    {"zdm2", 1, 58772},
    {"dutch_ship", 1, 69162},
    {"house_leaves", 1, 10497},
    {"living_room", 1, 5088},
    {"terrain_lowpoly", 1, 3868},
    {"sponza2022_ivy", 1, 15870},
    {"skinned/Fox.glb", 1, 576},
    {"skinned/CesiumMan.glb", 1, 4672},
    {"kaykit_adventurers", 2, 6952 + 6035},
    {"kaykit_hexagon_rts", 221, 217910},
    {"kaykit_dungeon", 203, 88722},
    {"kaykit_city_bits", 41, 26813},
};

std::size_t countTriangles(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Object& object : evaluate(scene, 0.0).objects) {
        triangles += scene.meshes[object.mesh].primitives[object.primitive].indices.size() / 3;
    }
    return triangles;
}

std::vector<fs::path> filesOf(const fs::path& path)
{
    if (fs::is_regular_file(path)) {
        return {path};
    }
    std::vector<fs::path> out;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") {
            out.push_back(entry.path());
        }
    }
    return out;
}

class GltfScenes : public testing::TestWithParam<Expected> {};

TEST_P(GltfScenes, LoadsWithAllItsTriangles)
{
    const fs::path folder = sharedFolder("scenes");
    if (folder.empty()) {
        GTEST_SKIP() << "NO SCENES: set GNOMON_SHARED to the folder that has scenes/";
    }
    const std::vector<fs::path> files = filesOf(folder / GetParam().path);
    EXPECT_EQ(files.size(), GetParam().files);
    std::size_t triangles = 0;
    for (const fs::path& file : files) {
        SCOPED_TRACE(file.string());
        triangles += countTriangles(readGltf(file));
    }
    EXPECT_EQ(triangles, GetParam().triangles);
}

std::string testName(const testing::TestParamInfo<Expected>& tested)
{
    std::string name = tested.param.path;
    for (char& c : name) {
        c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    }
    return name;
}

INSTANTIATE_TEST_SUITE_P(Listed, GltfScenes, testing::ValuesIn(kScenes), testName);

} // namespace
} // namespace gnomon::scene::test
