// SPDX-License-Identifier: Apache-2.0
// Frames and masks that the npm package is held to. usage: web_cases FOLDER [exact]
//
// "exact": those cases alone that are compared exactly, for drivers that compile the others for minutes.
// Writes cases.json: the scene of boxes, its camera, lights and options by case; planned.json: frames and their plans;
// depth.bin (float), normals.bin (two floats), and for each case NAME.bin, the mask by the Vulkan backend, and
// NAME.json, its plan.
#include "option_steps.h"
#include "planned_scene.h"

#include <gnomon/plan_views.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

namespace gnomon::test {
namespace {

using nlohmann::json;
constexpr VkExtent2D kScreen{160, 90};

struct WebCase {
    const char* name;
    const char* options;
    const char* lights;
    bool exact = false; // at most one step of 255 apart
};

// Options first that all have: maps that are small and clear.
constexpr WebCase kCases[] = {
    {"hard_sun", "map-size=256 partition=single filter=hard", "sun", true},
    {"pcf_cascades", "map-size=256 partition=cascades filter=pcf", "sun", true},
    {"pcf_spot", "map-size=256 partition=single filter=pcf", "spot", true},
    {"hard_lamp", "map-size=256 partition=cube filter=hard", "lamp", true},
    {"three_lights", "map-size=256 partition=auto filter=pcf", "sun spot lamp", true},
    {"pages", "texels=262144 partition=virtual filter=pcf", "sun", true},
    {"steps", "map-size=256 filter=pcf motion=step-band", "sun", true},
    {"r32f", "map-size=256 partition=single filter=pcf map-format=r32f", "sun spot", true},
    {"kept", "map-size=256 partition=single filter=pcf keep-still=always", "spot", true},
    {"pcss_spot", "map-size=256 partition=single filter=pcss", "spot"},
    {"raymarch_sun", "map-size=256 partition=single filter=raymarch", "sun"},
    {"vsm_sun", "map-size=256 partition=single filter=vsm", "sun"},
    {"lvsm_sun", "map-size=256 partition=single filter=lvsm map-format=rgba32f", "sun"},
    {"lloyd_sun", "map-size=256 partition=single filter=lvsm lvsm.placement=lloyd map-format=rgba32f", "sun"},
    {"esm_cascades", "map-size=256 partition=cascades filter=esm", "sun"},
    {"evsm_spot", "map-size=256 partition=single filter=evsm", "spot"},
    {"msm_lamp", "map-size=256 partition=cube filter=msm map-format=rgba32f", "lamp"},
    {"unblurred", "map-size=256 partition=single filter=vsm blur=none msaa=1", "sun"},
    {"mip_levels", "map-size=256 partition=single filter=evsm map-sampling=trilinear", "sun"},
    {"blur", "map-size=256 partition=single filter=hard soften=blur", "sun"},
};
// Plans alone.
constexpr const char* kPlanned[] = {"partition=cascades filter=pcf", "partition=auto filter=auto",
                                    "partition=multi filter=msm fit=lispsm", "partition=virtual filter=raymarch",
                                    "partition=cube filter=evsm"};
constexpr int kFramesOfEach = 40;

Light lightCalled(const std::string& name)
{
    if (name == "sun") {
        return makeSun({0.5, -1.0, 0.2});
    }
    Light light = makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5);
    if (name == "lamp") {
        light = {};
        light.type = LightType::point;
        light.position_ws = {0.5, 3.5, 2.5};
        light.range_m = 25.0;
    }
    light.radius_m = 0.2;
    return light;
}

std::vector<Light> lightsOf(const std::string& names)
{
    std::vector<Light> lights;
    for (std::size_t at = 0; at < names.size();) {
        const std::size_t end = std::min(names.find(' ', at), names.size());
        lights.push_back(lightCalled(names.substr(at, end - at)));
        lights.back().key = static_cast<std::uint32_t>(lights.size());
        at = end + 1;
    }
    return lights;
}

json toJson(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

json toJson(const Camera& camera)
{
    const double* m = &camera.clip_from_world[0][0];
    return {{"eyeWs", toJson(camera.eye_ws)},
            {"clipFromWorld", std::vector<double>(m, m + 16)},
            {"reversedZ", camera.reversed_z ? 1 : 0}};
}

json toJson(const Light& light)
{
    return {{"key", light.key},
            {"type", static_cast<int>(light.type)},
            {"positionWs", toJson(light.position_ws)},
            {"directionWs", toJson(light.direction_ws)},
            {"outerHalfAngleRad", light.outer_half_angle_rad},
            {"rangeM", light.range_m},
            {"angularDiameterRad", light.angular_diameter_rad},
            {"radiusM", light.radius_m}};
}

/// The options that are not the defaults, as Planner.set() takes them.
json settingsOf(const char* line)
{
    const ShadowOptions options = optionsFrom(line);
    json settings = json::object();
    for (const OptionRow& row : optionTable()) {
        const std::string value = textOf(row, row.get(options));
        if (value != textOf(row, row.get(ShadowOptions{}))) {
            settings[std::string(row.key)] = value;
        }
    }
    return settings;
}

json toJson(std::span<const Light> lights)
{
    json all = json::array();
    for (const Light& light : lights) {
        all.push_back(toJson(light));
    }
    return all;
}

json toJson(const Aabb& box)
{
    return {{"min", {box.min.x, box.min.y, box.min.z}}, {"max", {box.max.x, box.max.y, box.max.z}}};
}

void write(const std::string& path, const void* data, std::size_t bytes)
{
    std::ofstream(path, std::ios::binary).write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
}

void writeJson(const std::string& path, const json& value)
{
    const std::string text = value.dump();
    write(path, text.data(), text.size());
}

void writePicture(const std::string& folder, const Camera& camera)
{
    const Picture picture = tracePicture(makeScene(), camera, kScreen);
    std::vector<float> normals;
    for (const glm::i16vec2& one : picture.octahedral) { // as R16G16_SNORM reads them
        normals.push_back(std::max(static_cast<float>(one.x) / 32767.0F, -1.0F));
        normals.push_back(std::max(static_cast<float>(one.y) / 32767.0F, -1.0F));
    }
    write(folder + "/depth.bin", picture.depth.data(), picture.depth.size() * sizeof(float));
    write(folder + "/normals.bin", normals.data(), normals.size() * sizeof(float));
}

json sceneOf(const PlannedScene& scene, const Frame& frame)
{
    json all{{"widthPx", kScreen.width},
             {"heightPx", kScreen.height},
             {"camera", toJson(frame.camera)},
             {"subPixelBits", gpu().limits().subPixelPrecisionBits}};
    const TestMesh mesh = testMesh();
    for (const glm::vec3& p : mesh.positions) {
        all["positions"].push_back({p.x, p.y, p.z});
    }
    all["indices"] = mesh.indices;
    for (const vulkan::Rows3x4& rows : makeScene().transforms()) {
        json transform = json::array();
        for (const glm::vec4& row : {rows.x, rows.y, rows.z}) {
            transform.insert(transform.end(), {row.x, row.y, row.z, row.w});
        }
        all["transforms"].push_back(transform);
    }
    for (std::uint32_t i = 0; i < scene.mesh().objects.size(); ++i) {
        all["bounds"].push_back(toJson(frame.objects->bounds(frame.objects->idAt(i))));
    }
    return all;
}

/// Frames of a camera that goes around while a box moves: their inputs, and their plans.
json plannedFrames(const char* options)
{
    ObjectSet objects;
    (void)objects.add({{-30.0F, 0.0F, -30.0F}, {30.0F, 0.0F, 30.0F}});
    const ObjectId moving = objects.add({{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}});
    (void)objects.add({{2.0F, 0.0F, -3.0F}, {5.0F, 1.0F, -1.5F}});
    Planner planner(optionsFrom(options));
    std::vector<Light> lights = lightsOf(std::string(options).find("cube") != std::string::npos ? "lamp" : "sun");
    json frames = json::array();
    for (int i = 0; i < kFramesOfEach; ++i) {
        const double angle = 0.05 * i;
        Frame frame;
        frame.index = static_cast<std::uint64_t>(i);
        frame.camera =
            makeCamera({12.0 * std::cos(angle), 5.0 + 0.1 * i, 12.0 * std::sin(angle)}, {0.0, 0.5, 0.0}, 16.0 / 9.0);
        frame.size_px = {kScreen.width, kScreen.height};
        frame.lights = lights;
        frame.objects = &objects;
        const Aabb box{{-1.0F + 0.05F * static_cast<float>(i), 0.0F, -1.0F},
                       {1.0F + 0.05F * static_cast<float>(i), 2.0F, 1.0F}};
        if (i % 3 == 1) {
            (void)objects.update(moving, box);
        }
        json one{{"camera", toJson(frame.camera)}, {"lights", toJson(lights)}, {"plan", toJson(planner.plan(frame))}};
        if (i % 3 == 1) {
            one["moved"] = toJson(box);
        }
        frames.push_back(one);
    }
    return {{"options", options}, {"settings", settingsOf(options)}, {"frames", frames}};
}

void drawCases(const std::string& folder, bool exact_alone)
{
    PlannedScene scene(gpu(), kScreen);
    Drawing drawing(gpu(), scene.mesh());
    const Frame seen = scene.frameOf({});
    writePicture(folder, seen.camera);
    json all{{"scene", sceneOf(scene, seen)}};
    for (const WebCase& one : kCases) {
        if (exact_alone && !one.exact) {
            continue;
        }
        const std::vector<Light> lights = lightsOf(one.lights);
        Planner planner(optionsFrom(one.options));
        const Plan plan = planner.plan(scene.frameOf(lights));
        for (const LightPlan& light : plan.lights) {
            if (!light.outcome.hasMap()) {
                throw std::runtime_error(std::string(one.name) + ": " + std::string(light.outcome.reason));
            }
        }
        const std::vector<std::byte> mask = scene.draw(drawing, plan);
        write(folder + "/" + one.name + ".bin", mask.data(), mask.size());
        const std::string text = gnomon::toJson(plan);
        write(folder + "/" + one.name + ".json", text.data(), text.size());
        all["cases"].push_back({{"name", one.name},
                                {"settings", settingsOf(one.options)},
                                {"lights", toJson(lights)},
                                {"exact", one.exact},
                                {"layers", plan.mask_layers},
                                {"channels", maskChannelCount(plan)}});
    }
    writeJson(folder + "/cases.json", all);
    json planned = json::array();
    for (const char* options : kPlanned) {
        planned.push_back(plannedFrames(options));
    }
    writeJson(folder + "/planned.json", planned);
}

} // namespace
} // namespace gnomon::test

int main(int count, char** arguments)
{
    if (count != 2 && !(count == 3 && std::string(arguments[2]) == "exact")) {
        std::fprintf(stderr, "usage: web_cases FOLDER [exact]\n");
        return 2;
    }
    try {
        gnomon::test::drawCases(arguments[1], count == 3);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "web_cases: %s\n", error.what());
        return 1;
    }
    return 0;
}
