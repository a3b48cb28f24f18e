// SPDX-License-Identifier: Apache-2.0
// The `extras` of nodes and lights.
#include "support.h"

#include <algorithm>
#include <string>

namespace gnomon::scene::test {
namespace {

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(GltfExtras, LightsSayInTheirExtrasThatTheyCastNoShadow)
{
    const auto read = [](const std::string& extras) {
        return readText(R"({"asset":{"version":"2.0"},"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point")" +
                        extras + "}]}}}")
            .lights.at(0)
            .casts_shadow;
    };
    EXPECT_TRUE(read(""));
    EXPECT_TRUE(read(R"(,"extras":{})"));
    EXPECT_TRUE(read(R"(,"extras":{"casts_shadow":true})"));
    EXPECT_FALSE(read(R"(,"extras":{"casts_shadow":false})"));
    EXPECT_FALSE(read(R"(,"extras":{"mood":3,"casts_shadow":false})"));
    EXPECT_TRUE(read(R"(,"extras":[false])"));
    EXPECT_TRUE(read(R"(,"extras":"casts_shadow")"));
}

TEST(GltfExtras, ExtrasSayWhoCastsAndWhoReceives)
{
    const Scene scene = readText(R"({"asset":{"version":"2.0"},"nodes":[
        {"name":"top","children":[1,2],"extras":{"gnomon":{"casts":false,"receives":false,"bias_m":0.5}}},
        {"name":"below"},
        {"name":"other","children":[3],"extras":{"gnomon":{"casts":true,"groups":[0,31],"moves":true}}},
        {"name":"last","extras":{"gnomon":{"groups":[]}}},
        {"name":"beside","extras":{"gnomon":{"casts":false,"groups":[3]}}}]})");
    const auto node = [&](const std::string& name) {
        return *std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
    };
    for (const char* name : {"top", "below"}) {
        EXPECT_FALSE(node(name).casts);
        EXPECT_EQ(node(name).groups, 0U) << "no filter draws it";
        EXPECT_FALSE(node(name).receives);
        EXPECT_EQ(node(name).bias_m, 0.5F);
        EXPECT_FALSE(node(name).dynamic);
    }
    EXPECT_TRUE(node("other").casts);
    EXPECT_EQ(node("other").groups, 0x80000001U);
    EXPECT_TRUE(node("other").dynamic);
    EXPECT_FALSE(node("other").receives) << "as it is said above";
    EXPECT_EQ(node("last").groups, 0U);
    EXPECT_TRUE(node("last").dynamic);
    EXPECT_EQ(node("beside").groups, 0U) << "casts nothing, whatever its groups";
    EXPECT_EQ(node("beside").bias_m, 0.0F);
    EXPECT_TRUE(scene.notices.empty());
}

TEST(GltfExtras, ExtrasOfLightsNameTheGroupsThatTheyShadow)
{
    const auto read = [](const std::string& ours) {
        return readText(R"({"asset":{"version":"2.0"},"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point",)"
                        R"("extras":{"gnomon":)" +
                        ours + "}}]}}}");
    };
    EXPECT_EQ(read("{}").lights.at(0).groups, 0xFFFFFFFFU);
    EXPECT_EQ(read(R"({"groups":[0,3]})").lights.at(0).groups, 9U);
    EXPECT_EQ(read(R"({"groups":[]})").lights.at(0).groups, 0U);
    const Scene wrong = read(R"({"groups":[-1],"casts":false})");
    EXPECT_EQ(wrong.lights.at(0).groups, 0xFFFFFFFFU);
    EXPECT_EQ(wrong.notices.size(), 2U);
}

/// One sentence each, and the node is as if nothing had been said.
TEST(GltfExtras, HostileExtrasAreIgnoredWithANotice)
{
    for (const char* ours : {"3",
                             "[]",
                             "null",
                             R"("casts")",
                             R"({"casts":1})",
                             R"({"casts":"false"})",
                             R"({"casts":null})",
                             R"({"receives":[]})",
                             R"({"moves":{}})",
                             R"({"bias_m":"1"})",
                             R"({"bias_m":1e39})",
                             R"({"bias_m":-1e300})",
                             R"({"bias_m":true})",
                             R"({"groups":3})",
                             R"({"groups":[32]})",
                             R"({"groups":[-1]})",
                             R"({"groups":[1.5]})",
                             R"({"groups":[0,"1"]})",
                             R"({"groups":[18446744073709551615]})",
                             R"({"groups":{"0":1}})",
                             R"({"groups":[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]})",
                             R"({"cast":false})"}) {
        const Scene scene = readText(
            std::string(R"({"asset":{"version":"2.0"},"nodes":[{"name":"wall","extras":{"gnomon":)") + ours + "}}]}");
        const Node& node = scene.nodes.at(0);
        EXPECT_TRUE(node.casts && node.receives && !node.dynamic && node.groups == 1 && node.bias_m == 0.0F) << ours;
        ASSERT_EQ(scene.notices.size(), 1U) << ours;
        EXPECT_TRUE(contains(scene.notices[0], "/nodes/0/extras/gnomon")) << scene.notices[0];
    }
    for (const char* others : {R"("extras":{"mood":3})", R"("extras":"gnomon")", R"("extras":["gnomon"])"}) {
        EXPECT_TRUE(readText(std::string(R"({"asset":{"version":"2.0"},"nodes":[{)") + others + "}]}").notices.empty());
    }
}

TEST(GltfExtras, NodesSayInTheirExtrasWhatCutsThem)
{
    const auto text = [](const std::string& extras) {
        return R"({"asset":{"version":"2.0"},"nodes":[{"name":"wall")" + extras + "}]}";
    };
    const auto read = [&](const std::string& extras) {
        return readText(text(extras)).nodes.at(0).clip_planes;
    };
    for (const char* none :
         {"", R"(,"extras":{})", R"(,"extras":{"clip_planes":[]})", R"(,"extras":[[1,0,0,0]])",
          R"(,"extras":"clip_planes")", R"(,"extras":{"clip":[[1,0,0,0]],"more":{"clip_planes":1}})"}) {
        EXPECT_EQ(read(none), kNoClipPlanes) << none;
    }
    EXPECT_EQ(read(R"(,"extras":{"clip_planes":[[0,-2,0,3]]})"), (ClipPlanes{glm::vec4(0, -1, 0, 1.5F), kNoClipPlane}));
    EXPECT_EQ(read(R"(,"extras":{"mood":3,"clip_planes":[[1,0,0,0],[0,0,1e-20,1e-20]]})"),
              (ClipPlanes{glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 1)}));

    const std::string at = "/nodes/0/extras/clip_planes";
    const auto error = [&](const std::string& planes) {
        return errorOfText(text(R"(,"extras":{"clip_planes":)" + planes + "}"));
    };
    EXPECT_TRUE(contains(error("[[0,0,0,1]]"), at + "/0"));
    EXPECT_TRUE(contains(error("[[1,0,0,0],[0,0,0,0]]"), at + "/1"));
    EXPECT_TRUE(contains(error("[[1,0,0]]"), at + "/0"));
    EXPECT_TRUE(contains(error("[[1,0,0,0,0]]"), at + "/0"));
    EXPECT_TRUE(contains(error(R"([[1,0,0,"0"]])"), at + "/0/3"));
    EXPECT_TRUE(contains(error("[[1e39,0,0,0]]"), at + "/0/0"));
    EXPECT_TRUE(contains(error("[[1e-30,0,0,1e30]]"), at + "/0"));
    EXPECT_TRUE(contains(error("[1,0,0,0]"), at));
    EXPECT_TRUE(contains(error("{}"), at));
    EXPECT_TRUE(contains(error("null"), at));
    EXPECT_TRUE(contains(error("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]"), at));
}

} // namespace
} // namespace gnomon::scene::test
