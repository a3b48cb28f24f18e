// SPDX-License-Identifier: Apache-2.0
// Nodes, skins, animations, materials, cameras, lights, instances and extensions.
#include "support.h"

#include <algorithm>

namespace gnomon::scene::test {
namespace {

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(GltfStructure, ParentsComeFirstAndOtherScenesAreLeftOut)
{
    const Scene scene = readText(R"({"asset":{"version":"2.0"},"scene":1,
        "scenes":[{"nodes":[3]},{"name":"shown","nodes":[2]}],
        "nodes":[{"name":"leaf"},{"name":"middle","children":[0]},{"name":"root","children":[1]},{"name":"other"}]})");
    ASSERT_EQ(scene.nodes.size(), 3U);
    EXPECT_EQ(scene.name, "shown");
    EXPECT_EQ(scene.nodes[0].name, "root");
    EXPECT_EQ(scene.nodes[1].name, "middle");
    EXPECT_EQ(scene.nodes[2].name, "leaf");
    EXPECT_EQ(scene.nodes[2].parent, 1U);
    EXPECT_EQ(scene.nodes[0].parent, kNone);
}

TEST(GltfStructure, NodeTransforms)
{
    const Scene scene = readText(R"({"asset":{"version":"2.0"},"nodes":[
        {"translation":[1,2,3],"rotation":[0,0,0.7071068,0.7071068],"scale":[2,2,2]},
        {"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}]})");
    const glm::vec4 p = scene.nodes[0].transform.matrix() * glm::vec4(1, 0, 0, 1);
    EXPECT_NEAR(p.x, 1.0F, 1e-5F); // x turned to y, twice as long, moved
    EXPECT_NEAR(p.y, 4.0F, 1e-5F);
    EXPECT_NEAR(p.z, 3.0F, 1e-5F);
    EXPECT_TRUE(scene.nodes[1].use_matrix);
    EXPECT_EQ(scene.nodes[1].matrix[3], glm::vec4(5, 6, 7, 1));
}

TEST(GltfStructure, NodeErrors)
{
    const auto error = [](const std::string& nodes) {
        return errorOfText(R"({"asset":{"version":"2.0"},"nodes":)" + nodes + "}");
    };
    EXPECT_TRUE(contains(error(R"([{"rotation":[0,0,0,0]}])"), "/nodes/0/rotation"));
    EXPECT_TRUE(contains(error(R"([{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]}])"), "/nodes/0/matrix"));
    EXPECT_TRUE(contains(error(R"([{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"scale":[1,1,1]}])"), "/nodes/0/scale"));
    EXPECT_TRUE(contains(error(R"([{"children":[0]}])"), "part of a loop at /nodes/0"));
    EXPECT_TRUE(contains(error(R"([{"translation":[1e39,0,0]}])"), "/nodes/0/translation/0"));
    EXPECT_TRUE(contains(error(R"([{"translation":[1,2]}])"), "/nodes/0/translation"));
    EXPECT_TRUE(contains(error(R"([{"mesh":-1}])"), "/nodes/0/mesh"));
    EXPECT_TRUE(contains(error(R"([{"mesh":1.5}])"), "/nodes/0/mesh"));
}

/// A file with one animated node. `keys` is the number of output elements.
FileBuilder animated(const char* path, const char* interpolation, const std::vector<float>& times, const char* type,
                     std::size_t keys, const std::vector<float>& values)
{
    FileBuilder file;
    const int input = file.add("SCALAR", 5126, times.size(), times);
    const int output = file.add(type, 5126, keys, values);
    file.root["nodes"] = json::array({{{"name", "moving"}}});
    file.root["animations"] = json::array(
        {{{"name", "clip"},
          {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}})},
          {"samplers", json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})}}});
    return file;
}

TEST(GltfStructure, AllInterpolations)
{
    const Scene step = animated("translation", "STEP", {0, 1}, "VEC3", 2, {0, 0, 0, 1, 2, 3}).read();
    ASSERT_EQ(step.animations.at(0).channels.size(), 1U);
    EXPECT_EQ(step.animations[0].channels[0].interpolation, Interpolation::step);
    EXPECT_EQ(step.animations[0].duration_s, 1.0F);
    EXPECT_TRUE(step.nodes[0].dynamic);
    EXPECT_EQ(evaluate(step, 0.9).nodes[0].transform.translation, glm::vec3(0));
    const Scene linear = animated("scale", "LINEAR", {0, 2}, "VEC3", 2, {1, 1, 1, 3, 3, 3}).read();
    EXPECT_EQ(linear.animations[0].channels[0].interpolation, Interpolation::linear);
    EXPECT_NEAR(evaluate(linear, 1.0).nodes[0].transform.scale.x, 2.0F, 1e-5F);
    const Scene cubic = animated("translation", "CUBICSPLINE", {0, 1}, "VEC3", 6,
                                 {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0})
                            .read();
    EXPECT_EQ(cubic.animations[0].channels[0].interpolation, Interpolation::cubic_spline);
    EXPECT_EQ(cubic.animations[0].channels[0].values.size(), 18U);
    EXPECT_NEAR(evaluate(cubic, 0.5).nodes[0].transform.translation.x, 2.0F, 1e-5F);
}

TEST(GltfStructure, QuantisedRotationKeysAreNormalised)
{
    FileBuilder file;
    const int input = file.add<float>("SCALAR", 5126, 1, {0});
    const int output = file.add<std::int16_t>("VEC4", 5122, 1, {0, 0, 23170, 23170}, true);
    file.root["nodes"] = json::array({json::object()});
    file.root["animations"] =
        json::array({{{"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}})},
                      {"samplers", json::array({{{"input", input}, {"output", output}}})}}});
    const Scene scene = file.read();
    const std::vector<float>& q = scene.animations.at(0).channels.at(0).values;
    EXPECT_NEAR(q[2] * q[2] + q[3] * q[3], 1.0F, 1e-6F);
}

TEST(GltfStructure, AnimationErrors)
{
    EXPECT_TRUE(contains(animated("translation", "LINEAR", {0, 1}, "VEC3", 1, {0, 0, 0}).error(),
                         "/animations/0/samplers/0/output"));
    EXPECT_TRUE(contains(animated("translation", "LINEAR", {1, 1}, "VEC3", 2, {0, 0, 0, 0, 0, 0}).error(),
                         "key times must increase at /animations/0/samplers/0/input"));
    EXPECT_TRUE(contains(animated("rotation", "LINEAR", {0}, "VEC4", 1, {0, 0, 0, 0.5F}).error(),
                         "/animations/0/channels/0/sampler"));
    EXPECT_TRUE(
        contains(animated("rotation", "LINEAR", {0}, "VEC3", 1, {0, 0, 1}).error(), "/animations/0/samplers/0/output"));
    FileBuilder twice = animated("translation", "LINEAR", {0}, "VEC3", 1, {0, 0, 0});
    twice.root["animations"][0]["channels"].push_back(twice.root["animations"][0]["channels"][0]);
    EXPECT_TRUE(contains(twice.error(), "/animations/0/channels/1/target"));
}

TEST(GltfStructure, Materials)
{
    const Scene scene = readText(R"({"asset":{"version":"2.0"},
        "extensionsUsed":["KHR_materials_unlit","KHR_materials_emissive_strength","KHR_texture_transform"],
        "images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQYV2P4z/AfAAQAAf+I0P3MAAAAAElFTkSuQmCC"}],
        "samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728,"minFilter":9985}],
        "textures":[{"source":0,"sampler":0}],
        "materials":[{"name":"all","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,
          "emissiveFactor":[0.5,0,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}},
          "normalTexture":{"index":0,"scale":0.5,"texCoord":1},"occlusionTexture":{"index":0,"strength":0.75},
          "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0,"roughnessFactor":0.5,
            "baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
              {"offset":[1,2],"scale":[3,4],"rotation":0.5,"texCoord":1}}}}},
          {"extensions":{"KHR_materials_unlit":{}}},{}]})");
    ASSERT_EQ(scene.materials.size(), 3U);
    const Material& m = scene.materials[0];
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.25F);
    EXPECT_TRUE(m.double_sided);
    EXPECT_EQ(m.emissive, glm::vec3(2, 0, 4));
    EXPECT_EQ(m.normal_scale, 0.5F);
    EXPECT_EQ(m.normal_texture.uv_set, 1U);
    EXPECT_EQ(m.occlusion_strength, 0.75F);
    EXPECT_EQ(m.base_colour, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(m.metallic, 0.0F);
    EXPECT_EQ(m.base_colour_texture.texture, 0U);
    EXPECT_EQ(m.base_colour_texture.offset, glm::vec2(1, 2));
    EXPECT_EQ(m.base_colour_texture.scale, glm::vec2(3, 4));
    EXPECT_EQ(m.base_colour_texture.rotation_rad, 0.5F);
    EXPECT_EQ(m.base_colour_texture.uv_set, 1U);
    EXPECT_EQ(m.emissive_texture.texture, kNone);
    EXPECT_EQ(scene.materials[1].model, ShadingModel::unlit);
    EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(scene.textures[0].wrap_v, Wrap::mirrored_repeat);
    EXPECT_FALSE(scene.textures[0].magnify_linear);
    EXPECT_TRUE(scene.textures[0].minify_linear);
    EXPECT_TRUE(scene.textures[0].mipmaps);
}

TEST(GltfStructure, CamerasAndLights)
{
    const Scene scene = readText(R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
        "cameras":[{"type":"mystery"},{"type":"perspective","perspective":{"yfov":1,"znear":0.5,"zfar":9}},
                   {"type":"orthographic","orthographic":{"xmag":2,"ymag":3,"znear":0,"zfar":1}}],
        "extensions":{"KHR_lights_punctual":{"lights":[
          {"type":"spot","spot":{"innerConeAngle":0.1,"outerConeAngle":0.5},"range":7,"color":[1,0.5,0],"intensity":3},
          {"type":"directional"},{"type":"point"}]}},
        "nodes":[{"camera":1},{"camera":0},{"extensions":{"KHR_lights_punctual":{"light":2}}}]})");
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_EQ(scene.nodes[0].camera, 0U);
    EXPECT_EQ(scene.nodes[1].camera, kNone);
    EXPECT_EQ(scene.cameras[0].far_m, 9.0F);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].half_height_m, 3.0F);
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(scene.lights[0].type, LightType::spot);
    EXPECT_EQ(scene.lights[0].outer_cone_rad, 0.5F);
    EXPECT_EQ(scene.lights[0].range_m, 7.0F);
    EXPECT_EQ(scene.lights[1].type, LightType::directional);
    EXPECT_EQ(scene.nodes[2].light, 2U);
}

TEST(GltfStructure, LightErrors)
{
    const auto error = [](const std::string& light) {
        return errorOfText(R"({"asset":{"version":"2.0"},"extensions":{"KHR_lights_punctual":{"lights":[)" + light +
                           "]}}}");
    };
    const std::string at = "/extensions/KHR_lights_punctual/lights/0";
    EXPECT_TRUE(contains(error(R"({"type":"point","intensity":-1})"), at + "/intensity"));
    EXPECT_TRUE(contains(error(R"({"type":"point","color":[2,0,0]})"), at + "/color/0"));
    EXPECT_TRUE(contains(error(R"({"type":"spot"})"), at));
    EXPECT_TRUE(contains(error(R"({"type":"point","extras":{"casts_shadow":0}})"), at + "/extras/casts_shadow"));
    EXPECT_TRUE(contains(error(R"({"type":"spot","spot":{"innerConeAngle":0.5,"outerConeAngle":0.5}})"), at + "/spot"));
}

TEST(GltfStructure, Instances)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    const int translation = file.add<float>("VEC3", 5126, 2, {0, 0, 0, 10, 0, 0});
    const int scale = file.add<float>("VEC3", 5126, 2, {1, 1, 1, 2, 2, 2});
    const int rotation = file.add<std::int16_t>("VEC4", 5122, 2, {0, 0, 0, 32767, 0, 0, 32767, 0}, true);
    file.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translation}, {"SCALE", scale}, {"ROTATION", rotation}};
    const Scene scene = file.read();
    ASSERT_EQ(scene.nodes[0].instances.size(), 2U);
    const glm::vec4 p = scene.nodes[0].instances[1] * glm::vec4(1, 0, 0, 1);
    EXPECT_NEAR(p.x, 8.0F, 1e-4F); // half a turn about z, twice as large, 10 along x
    EXPECT_EQ(evaluate(scene, 0.0).objects.size(), 2U);
    file.root["accessors"][scale]["count"] = 1;
    EXPECT_TRUE(contains(file.error(), "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes"));
}

TEST(GltfStructure, ExtensionsRequiredAndUsed)
{
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_mesh_of_others"],
        "extensionsRequired":["EXT_mesh_of_others"]})"),
                         R"(at /extensionsRequired/0: found "EXT_mesh_of_others")"));
    const Scene scene = readText(R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_sheen"]})");
    ASSERT_EQ(scene.notices.size(), 1U);
    EXPECT_TRUE(contains(scene.notices[0], "KHR_materials_sheen"));
}

/// They change no geometry. The first of these an exporter of many clothes needs, and so requires.
TEST(GltfStructure, ExtensionsThatLeaveGeometryMayBeRequired)
{
    for (const char* name : {"KHR_materials_variants", "KHR_materials_transmission", "KHR_materials_clearcoat",
                             "ADOBE_materials_thin_transparency", "KHR_xmp_json_ld", "KHR_node_hoverability"}) {
        const json root = {{"asset", {{"version", "2.0"}}}, {"extensionsUsed", {name}}, {"extensionsRequired", {name}}};
        const Scene scene = readText(root.dump());
        ASSERT_EQ(scene.notices.size(), 1U) << name;
        EXPECT_TRUE(contains(scene.notices[0], name));
    }
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.0"},"extensionsUsed":["materials_x"],
        "extensionsRequired":["materials_x"]})"),
                         "not supported"));
}

TEST(GltfStructure, SpecularGlossinessHasColourAndCoverage)
{
    const Scene scene = readText(R"({"asset":{"version":"2.0"},
        "extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],
        "extensionsRequired":["KHR_materials_pbrSpecularGlossiness"],
        "materials":[{"alphaMode":"BLEND","extensions":{"KHR_materials_pbrSpecularGlossiness":
            {"diffuseFactor":[0.1,0.2,0.3,0.4],"glossinessFactor":0.25}}}]})");
    EXPECT_TRUE(scene.notices.empty());
    EXPECT_EQ(scene.materials.at(0).base_colour, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
    EXPECT_EQ(scene.materials[0].roughness, 0.75F);
    EXPECT_EQ(scene.materials[0].metallic, 0.0F);
}

/// With what is below it, whatever that says of itself. A node that moves others stays, and the camera's.
TEST(GltfStructure, HiddenNodesShowAndLightNothing)
{
    FileBuilder file;
    file.root["extensionsUsed"] = {"KHR_node_visibility", "KHR_lights_punctual"};
    file.root["extensionsRequired"] = {"KHR_node_visibility"};
    file.root["extensions"] = {{"KHR_lights_punctual", {{"lights", json::array({{{"type", "point"}}})}}}};
    file.root["cameras"] = json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}});
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    const auto visible = [](bool yes) {
        return json{{"KHR_node_visibility", {{"visible", yes}}}};
    };
    file.root["nodes"] = json::array({{{"mesh", 0}, {"extensions", visible(true)}},
                                      {{"mesh", 0}, {"children", {2, 3, 4}}, {"extensions", visible(false)}},
                                      {{"mesh", 0}, {"extensions", visible(true)}},
                                      {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
                                      {{"camera", 0}}});
    const Scene scene = file.read();
    const State state = evaluate(scene, 0.0);
    EXPECT_TRUE(scene.notices.empty()) << testing::PrintToString(scene.notices);
    ASSERT_EQ(state.objects.size(), 1U);
    EXPECT_EQ(state.objects[0].node, 0U);
    EXPECT_TRUE(state.lights.empty());
    EXPECT_EQ(state.cameras.size(), 1U);
}

/// A node's place follows from all nodes above it; these themselves are not shown.
TEST(GltfStructure, ASceneMayNameAChild)
{
    FileBuilder file;
    file.addMesh({{"attributes", {{"POSITION", file.addTriangle()}}}});
    file.root["nodes"] =
        json::array({{{"mesh", 0}, {"name", "parent"}, {"translation", {1, 0, 0}}, {"children", {1, 2}}},
                     {{"mesh", 0}, {"name", "child"}, {"translation", {0, 2, 0}}, {"children", {3}}},
                     {{"mesh", 0}, {"name", "sister"}},
                     {{"mesh", 0}, {"name", "grandchild"}, {"translation", {0, 0, 3}}}});
    for (const json& named : {json{1}, json{1, 3}, json{3, 1}}) {
        file.root["scenes"] = json::array({{{"nodes", named}}});
        const Scene scene = file.read();
        const State state = evaluate(scene, 0.0);
        ASSERT_EQ(state.objects.size(), 2U) << named;
        EXPECT_EQ(glm::vec3(state.objects[0].world_from_object[3]), glm::vec3(1, 2, 0));
        EXPECT_EQ(glm::vec3(state.objects[1].world_from_object[3]), glm::vec3(1, 2, 3));
        EXPECT_EQ(scene.notices.size(), 1U);
    }
    file.root["scenes"] = json::array({{{"nodes", {0, 1, 2, 3}}}}); // as kits list them
    EXPECT_EQ(evaluate(file.read(), 0.0).objects.size(), 4U);
}

TEST(GltfStructure, AssetVersion)
{
    EXPECT_TRUE(contains(errorOfText("{}"), "'asset' must be defined"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"1.0"}})"), "/asset/version"));
    EXPECT_TRUE(contains(errorOfText(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"), "/asset/minVersion"));
    EXPECT_NO_THROW(static_cast<void>(readText(R"({"asset":{"version":"2.1","minVersion":"2.0"}})")));
}

TEST(GltfStructure, SkinsFollowTheNewOrderOfNodes)
{
    FileBuilder file;
    const int position = file.addTriangle();
    const int joints = file.add<std::uint8_t>("VEC4", 5121, 3, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const int weights = file.add<float>("VEC4", 5126, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    file.addMesh({{"attributes", {{"POSITION", position}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
    file.root["nodes"][0]["skin"] = 0;
    file.root["nodes"].push_back({{"name", "bone"}, {"translation", {0, 0, 5}}});
    file.root["nodes"].push_back({{"name", "root"}, {"children", {0, 1}}});
    file.root["skins"] = json::array({{{"joints", {1}}}});
    const Scene scene = file.read();
    ASSERT_EQ(scene.skins.at(0).joints.size(), 1U);
    EXPECT_EQ(scene.nodes[scene.skins[0].joints[0]].name, "bone");
    const State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.deformed.size(), 1U);
    EXPECT_EQ(state.deformed[0].positions[1], glm::vec3(1, 0, 5));
}

} // namespace
} // namespace gnomon::scene::test
