// SPDX-License-Identifier: Apache-2.0
// Which objects cast and receive, for which lights: a file's extras, --set object and --set light-groups, compared with
// the truth; and the notices about objects that take all of a light.
#include "folder.h"
#include "process.h"

#include "image/image_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using nlohmann::json;

/// The box [-1, 1]^3: mesh 0 is whole, mesh 1 lacks the face below, and its faces have two sides.
std::string boxBytes()
{
    constexpr std::array<std::array<std::uint16_t, 4>, 6> kFaces{
        {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {4, 5, 7, 6}, {0, 2, 3, 1}, {0, 1, 5, 4}}};
    std::string bytes;
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            const float at = (i >> axis & 1) != 0 ? 1.0F : -1.0F;
            bytes.append(reinterpret_cast<const char*>(&at), sizeof(at));
        }
    }
    for (const auto& face : kFaces) {
        for (const std::size_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
            bytes.append(reinterpret_cast<const char*>(&face[corner]), sizeof(std::uint16_t));
        }
    }
    return bytes;
}

/// Floor, box and roof (a plate over the box, beside it), without a light.
json yard()
{
    json gltf = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
      "nodes": [{"name": "floor", "mesh": 0, "translation": [0, -0.1, 0], "scale": [8, 0.1, 8]},
                {"name": "box", "mesh": 0, "translation": [-2, 1, 0]},
                {"name": "roof", "mesh": 0, "translation": [2, 3, 0], "scale": [1.5, 0.1, 1.5]}],
      "materials": [{"doubleSided": true}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
                 {"primitives": [{"attributes": {"POSITION": 0}, "indices": 2, "material": 0}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                    {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
                    {"bufferView": 1, "componentType": 5123, "count": 30, "type": "SCALAR"}],
      "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
      "buffers": [{"byteLength": 168, "uri": "box.bin"}]})");
    return gltf;
}

void add(json& gltf, json node)
{
    gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size());
    gltf["nodes"].push_back(std::move(node));
}

/// A point light by the name "lamp".
void addLamp(json& gltf, const std::array<double, 3>& place)
{
    gltf["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", "lamp"}, {"intensity", 100}}};
    add(gltf, {{"translation", place}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

struct Yard {
    test::Folder folder;

    explicit Yard(const json& gltf)
    {
        test::spill(folder / "box.bin", boxBytes());
        test::spill(folder / "yard.gltf", gltf.dump());
    }
    [[nodiscard]] test::Ran run(std::vector<std::string> arguments, const std::vector<std::string>& more) const
    {
        const std::vector<std::string> common{"yard.gltf", "--size",   "96x72", "--eye",      "0,9,9", "--target",
                                              "0,0,0",     "--ground", "off",   "--map-size", "512"};
        arguments.insert(arguments.end(), common.begin(), common.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::gnomon(arguments, {.folder = folder.path()});
    }
    /// Mean of the mask of the first light, and whether all went well.
    [[nodiscard]] double meanOf(const std::vector<std::string>& more) const
    {
        std::vector<std::string> said{"-o", "mask.exr"};
        said.insert(said.end(), more.begin(), more.end());
        const test::Ran ran = run({"render", "--mask"}, said);
        EXPECT_EQ(ran.status, 0) << ran.err;
        const ImageF mask = readImage(folder / "mask.exr");
        return std::accumulate(mask.values.begin(), mask.values.end(), 0.0) / static_cast<double>(mask.values.size());
    }
    /// By filter, and of cascades with that word, the rmse beside the truth.
    [[nodiscard]] json errorsOf(const std::vector<std::string>& more) const
    {
        std::vector<std::string> said{"--json",        "found.json",
                                      "--repetitions", "1",
                                      "--techniques",  "hard,pcf,raymarch,vsm,msm,hard+cascades,raymarch+cascades"};
        said.insert(said.end(), more.begin(), more.end());
        const test::Ran ran = run({"compare", "--truth", "hard"}, said);
        EXPECT_EQ(ran.status, 0) << ran.err;
        const json found = json::parse(test::slurp(folder / "found.json"));
        json errors;
        for (const json& result : found["results"]) {
            const json& choices = result["choices"];
            const std::string cascades = choices["partition"] == "cascades" ? "+cascades" : "";
            errors[choices["filter"].get<std::string>() + cascades] = result["error"]["rmse"];
        }
        return errors;
    }
};

const std::vector<std::string> kSun{"--sun", "0.3,-1,0.2"};

std::vector<std::string> withSun(std::vector<std::string> more)
{
    more.insert(more.end(), kSun.begin(), kSun.end());
    return more;
}

/// Nothing is left of the shadow of a roof that casts nothing, or for other lights alone, be it said in the file or
/// beside it; and every technique agrees with the truth that knows it by itself.
TEST(Casting, OfOneObjectIsTakenOutOfMapsAndTruthAlike)
{
    json silent = yard();
    silent["nodes"][2]["extras"]["gnomon"]["casts"] = false;
    json grouped = yard();
    grouped["nodes"][2]["extras"]["gnomon"]["groups"] = {3};
    json gone = yard();
    gone["scenes"][0]["nodes"] = {0, 1};
    const double all = Yard(yard()).meanOf(withSun({"--truth", "hard"}));
    const Yard plain(yard());
    struct Case {
        json gltf;
        std::vector<std::string> said;
    };
    const std::vector<Case> cases{{silent, {}},
                                  {grouped, {"--set", "light-groups=sun:0+1+31"}},
                                  {yard(), {"--set", "object=roof:casts=false"}},
                                  {yard(), {"--set", "object=roof:groups=3", "--set", "light-groups=sun:0"}}};
    double first = 0.0;
    for (const Case& one : cases) {
        const Yard there(one.gltf);
        const double mean = there.meanOf(withSun([&] {
            std::vector<std::string> said = one.said;
            said.insert(said.end(), {"--truth", "hard"});
            return said;
        }()));
        EXPECT_GT(mean, all + 0.01);
        first = first == 0.0 ? mean : first;
        EXPECT_EQ(mean, first);
        const json errors = there.errorsOf(withSun(one.said));
        ASSERT_EQ(errors.size(), 7U);
        for (const auto& [technique, rmse] : errors.items()) {
            EXPECT_LT(rmse.get<double>(), 0.09) << technique;
        }
    }
    const json with_roof = plain.errorsOf(kSun);
    const json without = Yard(gone).errorsOf(kSun);
    const json none = plain.errorsOf(withSun({"--set", "object=roof:casts=false"}));
    for (const char* technique : {"pcf", "raymarch"}) {
        EXPECT_NEAR(none[technique].get<double>(), without[technique].get<double>(), 0.02) << technique;
        EXPECT_LT(none[technique].get<double>(), with_roof[technique].get<double>() + 0.01) << technique;
    }
}

TEST(Casting, OfAnotherLightStays)
{
    json gltf = yard();
    addLamp(gltf, {2, 6, 0});
    gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"]["gnomon"]["groups"] = {0};
    gltf["nodes"][2]["extras"]["gnomon"]["groups"] = {5};
    const Yard there(gltf);
    const auto mean = [&](const std::vector<std::string>& more) {
        return there.meanOf(more);
    };
    const double lit = mean({});
    const double shaded = mean({"--set", "light-groups=lamp:0+5"});
    EXPECT_GT(lit, shaded + 0.005);
    EXPECT_NEAR(mean({"--truth", "hard"}), lit, 0.01);
    EXPECT_NEAR(mean({"--truth", "hard", "--set", "light-groups=lamp:0+5"}), shaded, 0.01);
}

/// The floor is lit all over then; the box still receives. The light equals the truth's.
TEST(Casting, NothingIsReceivedWhereItIsSaid)
{
    const Yard there(yard());
    const auto means = [&](const std::vector<std::string>& how) {
        std::vector<std::string> more = withSun(how);
        const double plain = there.meanOf(more);
        more.insert(more.end(), {"--set", "object=floor:receives=false"});
        return std::pair(plain, there.meanOf(more));
    };
    const auto [shaded, lit] = means({"--truth", "hard"});
    EXPECT_GT(lit, shaded + 0.03);
    for (const char* filter : {"pcf", "raymarch", "vsm", "id"}) {
        EXPECT_NEAR(means({"--filter", filter}).second, lit, 0.005) << filter;
    }
}

/// A bias of metres pushes a caster through the floor, so that nothing is left of its shadow in maps; the truth has it.
TEST(Casting, BiasOfOneObjectMovesItsShadowAlone)
{
    const Yard there(yard());
    const std::vector<std::string> pcf = withSun({"--filter", "pcf"});
    const auto mean = [&](const std::string& said) {
        std::vector<std::string> more = pcf;
        more.insert(more.end(), {"--set", said});
        return there.meanOf(more);
    };
    const double as_it_is = there.meanOf(pcf);
    EXPECT_NEAR(mean("object=roof:bias_m=0.001"), as_it_is, 0.002);
    EXPECT_GT(mean("object=roof:bias_m=5"), as_it_is + 0.01);
    EXPECT_NEAR(mean("object=roof:bias_m=5"), mean("object=roof:casts=false"), 0.01);
}

TEST(Casting, WrongWordsAreRefused)
{
    const Yard there(yard());
    const auto errorOf = [&](const std::string& setting) {
        const test::Ran ran = there.run({"plan"}, withSun({"--set", setting}));
        EXPECT_EQ(ran.status, 2) << setting;
        return ran.err;
    };
    EXPECT_NE(errorOf("object=rof:casts=0").find("the scene has no object \"rof\" (did you mean \"roof\"?)"),
              std::string::npos);
    EXPECT_NE(errorOf("light-groups=moon:0").find("there is no light \"moon\""), std::string::npos);
    for (const char* wrong :
         {"object=roof", "object=roof:", "object=:casts=0", "object=roof:casts", "object=roof:casts=2",
          "object=roof:groups=32", "object=roof:groups=-1", "object=roof:groups=", "object=roof:bias_m=nan",
          "object=roof:bias_m=inf", "object=roof:bias_m=1e7", "object=roof:cast=0", "object=roof:casts=0,",
          "light-groups=sun", "light-groups=sun:32", "light-groups=sun:0+", "light-groups=sun:x"}) {
        EXPECT_NE(errorOf(wrong).find("--set "), std::string::npos) << wrong;
    }
}

TEST(Casting, IsInPlansAndPresets)
{
    const Yard there(yard());
    test::spill(there.folder / "p.json", R"({"object": "roof:groups=3;box:moves=true", "light-groups": "sun:3"})");
    const test::Ran ran = there.run({"plan"}, withSun({"--preset", "p.json"}));
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_NE(ran.out.find("\"groups\": 8"), std::string::npos);
    EXPECT_NE(ran.out.find("\"dynamic\": true"), std::string::npos);
}

// ---- What takes all of a light

std::string noticesOf(const json& gltf, const std::vector<std::string>& more = {})
{
    const Yard there(gltf);
    const test::Ran ran = there.run({"plan"}, more);
    EXPECT_EQ(ran.status, 0) << ran.err;
    return ran.err;
}

bool tells(const std::string& notices, const std::string& object)
{
    return notices.find("object \"" + object + "\" stands around") != std::string::npos &&
           notices.find("takes all of the light of") != std::string::npos;
}

TEST(TakenLight, DomeAroundTheSceneIsNamed)
{
    json gltf = yard();
    EXPECT_EQ(noticesOf(gltf, kSun).find("takes all"), std::string::npos);
    add(gltf, {{"name", "sky"}, {"mesh", 0}, {"scale", {100, 100, 100}}});
    EXPECT_TRUE(tells(noticesOf(gltf, kSun), "sky"));
    EXPECT_FALSE(tells(noticesOf(gltf, withSun({"--set", "object=sky:casts=false"})), "sky"));
    EXPECT_FALSE(
        tells(noticesOf(gltf, withSun({"--set", "object=sky:groups=1", "--set", "light-groups=sun:0"})), "sky"));
    gltf["nodes"].back()["mesh"] = 1;
    EXPECT_FALSE(tells(noticesOf(gltf, {"--sun", "0.1,1,0"}), "sky")) << "through the face that it lacks";
    EXPECT_TRUE(tells(noticesOf(gltf, kSun), "sky"));
}

TEST(TakenLight, BulbAroundItsLampIsNamed)
{
    json gltf = yard();
    addLamp(gltf, {0, 4, 0});
    EXPECT_EQ(noticesOf(gltf).find("takes all"), std::string::npos);
    add(gltf, {{"name", "bulb"}, {"mesh", 0}, {"translation", {0, 4, 0}}, {"scale", {0.1, 0.1, 0.1}}});
    EXPECT_TRUE(tells(noticesOf(gltf), "bulb"));
    EXPECT_FALSE(tells(noticesOf(gltf, {"--set", "object=bulb:casts=false"}), "bulb"));
    gltf["nodes"].back()["mesh"] = 1;
    EXPECT_FALSE(tells(noticesOf(gltf), "bulb")) << "a shade that is open below";
}

/// A room with its lamp inside is lit, whether or not the camera is in it.
TEST(TakenLight, RoomAroundItsLampIsNone)
{
    json gltf = yard();
    add(gltf, {{"name", "garden"}, {"mesh", 0}, {"translation", {0, -20, 0}}, {"scale", {500, 0.1, 500}}});
    add(gltf, {{"name", "room"}, {"mesh", 0}, {"translation", {0, 5, 0}}, {"scale", {12, 6, 12}}});
    addLamp(gltf, {0, 4, 0});
    EXPECT_FALSE(tells(noticesOf(gltf), "room"));
    gltf["scenes"][0]["nodes"] = {3, 4, 5}; // an empty one, in which the camera is
    EXPECT_FALSE(tells(noticesOf(gltf), "room"));
}

} // namespace
} // namespace gnomon
