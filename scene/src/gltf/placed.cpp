// SPDX-License-Identifier: Apache-2.0
// Cameras and punctual lights, which nodes place besides meshes.
#include "gltf/casting_extras.h"
#include "gltf/document.h"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>

namespace gnomon::scene::gltf {

namespace {

constexpr double kAny = std::numeric_limits<float>::max();
constexpr double kTiny = std::numeric_limits<float>::min();
constexpr double kPi = 3.14159265358979323846;

void readPerspective(const JsonView& view, Camera& camera)
{
    // Just below 180 degrees: at 180 the picture plane is nowhere.
    camera.fov_y_rad = view.at("yfov").number(1e-6, kPi - 1e-6);
    camera.near_m = view.at("znear").number(kTiny, kAny);
    static_cast<void>(view.number("aspectRatio", 1.0F, kTiny, kAny)); // the picture's own shape decides
    if (const std::optional<JsonView> far = view.find("zfar")) {
        camera.far_m = far->number(kTiny, kAny);
        if (!(camera.far_m > camera.near_m)) {
            view.failFound("zfar must be greater than znear",
                           std::to_string(camera.far_m) + " and " + std::to_string(camera.near_m));
        }
    }
}

void readOrthographic(const JsonView& view, Camera& camera)
{
    camera.orthographic = true;
    for (const char* key : {"xmag", "ymag"}) {
        const JsonView size = view.at(key);
        const float value = size.number();
        if (value == 0.0F) {
            size.fail("xmag and ymag must not be zero");
        }
        if (value < 0.0F) {
            view.context().notice("negative size in " + size.pointer() + " was taken as positive");
        }
        camera.half_height_m = std::abs(value); // ymag comes last
    }
    camera.far_m = view.at("zfar").number(kTiny, kAny);
    camera.near_m = view.at("znear").number(0.0, kAny);
    if (!(camera.far_m > camera.near_m)) {
        view.failFound("zfar must be greater than znear",
                       std::to_string(camera.far_m) + " and " + std::to_string(camera.near_m));
    }
}

void readSpot(const JsonView& view, Light& light)
{
    light.outer_cone_rad = view.number("outerConeAngle", static_cast<float>(kPi / 4), kTiny, kPi / 2 + 1e-6);
    light.inner_cone_rad = view.number("innerConeAngle", 0.0F, 0.0, kPi / 2);
    if (!(light.inner_cone_rad < light.outer_cone_rad)) {
        view.failFound("innerConeAngle must be less than outerConeAngle",
                       std::to_string(light.inner_cone_rad) + " and " + std::to_string(light.outer_cone_rad));
    }
}

/// glTF leaves `extras` to applications. Ours: {"casts_shadow": false} is a light that shines through everything, and
/// {"gnomon": {"groups": [0, 3]}} one that shines through objects in neither group.
void readExtras(const JsonView& view, Light& light)
{
    const std::optional<JsonView> extras = view.find("extras");
    if (extras && extras->value().is_object()) { // glTF allows any value, and others' are not ours to judge
        light.casts_shadow = extras->boolean("casts_shadow", true);
    }
    light.groups = readLightGroups(view).value_or(light.groups);
}

/// False when the type is none we know.
bool readLight(const JsonView& view, Light& light)
{
    light.name = view.string("name", "");
    const std::string type = view.at("type").string();
    if (const std::optional<JsonView> colour = view.find("color")) {
        colour->numbers({glm::value_ptr(light.colour), 3}, 0.0, 1.0);
    }
    light.intensity = view.number("intensity", 1.0F, 0.0, kAny);
    light.range_m = view.number("range", 0.0F, kTiny, kAny);
    readExtras(view, light);
    if (type == "spot") {
        light.type = LightType::spot;
        readSpot(view.at("spot"), light);
        return true;
    }
    light.type = type == "point" ? LightType::point : LightType::directional;
    return type == "point" || type == "directional";
}

} // namespace

void readCameras(Document& document)
{
    const std::size_t count = topLevelCount(document, "cameras");
    for (std::size_t i = 0; i < count; ++i) {
        const JsonView view = document.root.at("cameras").element(i);
        checkExtensions(view, Place::other);
        Camera camera;
        camera.name = view.string("name", "");
        const std::string type = view.at("type").string();
        if (type == "perspective") {
            readPerspective(view.at("perspective"), camera);
        } else if (type == "orthographic") {
            readOrthographic(view.at("orthographic"), camera);
        } else {
            document.context().notice("camera " + view.pointer() + " is of an unknown type and was left out");
            document.cameras.push_back(kNone);
            continue;
        }
        document.cameras.push_back(static_cast<std::uint32_t>(document.scene.cameras.size()));
        document.scene.cameras.push_back(camera);
    }
}

void readLights(Document& document)
{
    const std::optional<JsonView> punctual = extension(document.root, "KHR_lights_punctual");
    if (!punctual) {
        return;
    }
    const JsonView lights = punctual->at("lights");
    const std::size_t count = lights.size();
    for (std::size_t i = 0; i < count; ++i) {
        Light light;
        if (!readLight(lights.element(i), light)) {
            document.context().notice("light " + lights.element(i).pointer() +
                                      " is of an unknown type and was left out");
            document.lights.push_back(kNone);
            continue;
        }
        document.lights.push_back(static_cast<std::uint32_t>(document.scene.lights.size()));
        document.scene.lights.push_back(light);
    }
}

} // namespace gnomon::scene::gltf
