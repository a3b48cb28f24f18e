// SPDX-License-Identifier: Apache-2.0
#include "random_scenes.h"

#include <algorithm>

namespace gnomon::test {
namespace {

void mark(RandomScene& scene, Awkward kind)
{
    scene.awkward |= 1U << static_cast<int>(kind);
}

void addObjects(Random& random, RandomScene& scene, const glm::dvec3& origin)
{
    const double size = scene.size_m;
    if (random.below(20) == 0) {
        mark(scene, Awkward::no_size);
        for (std::uint32_t i = random.below(3) + 1; i > 0; --i)
            scene.set.add(boxAt(origin, glm::dvec3(0.0)));
        return;
    }
    const std::uint32_t count = 1 + random.below(40);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 centre = origin + random.inBox(glm::dvec3(-size, 0, -size), glm::dvec3(size));
        glm::dvec3 half = random.inBox(glm::dvec3(0), glm::dvec3(0.2 * size));
        if (random.below(8) == 0)
            half = glm::dvec3(0.0); // a point
        if (random.below(8) == 0)
            half[static_cast<int>(random.below(3))] = 0.0; // a sheet
        scene.set.add(boxAt(centre, half), {random.below(4) != 0, random.below(4) != 0, random.below(2) == 0});
    }
    if (random.below(2) == 0)
        scene.set.add(boxAt(origin, {2 * size, 0.0, 2 * size}), {random.below(2) == 0, true, false});
}

/// A lamp that shines on the scene from up to a million times its size away.
Light awayLamp(Random& random, RandomScene& scene, const glm::dvec3& origin)
{
    const double times = std::pow(10.0, random.uniform(0.0, 6.0));
    if (times > 1000.0)
        mark(scene, Awkward::far_lamp);
    const glm::dvec3 way = random.below(3) == 0 ? glm::dvec3(0, -1, 0) : random.direction();
    // As wide as any, or no wider than the scene from there.
    const double half_angle_rad =
        random.below(2) == 0 ? glm::radians(random.uniform(1.0, 60.0)) : std::atan(random.uniform(0.3, 1.5) / times);
    return spot(origin - way * (times * scene.size_m), way, half_angle_rad);
}

void addLights(Random& random, RandomScene& scene, const glm::dvec3& origin)
{
    glm::dvec3 way = random.direction();
    if (random.below(8) == 0) {
        mark(scene, Awkward::sun_overhead);
        way = glm::dvec3(0, random.below(2) == 0 ? -1 : 1, 0);
    }
    scene.lights.push_back(sun(way));
    const glm::dvec3 place = origin + random.inBox(glm::dvec3(-1.5), glm::dvec3(1.5)) * scene.size_m;
    // One after the other: compilers differ in the order of a call's arguments.
    const double range_m = random.below(2) == 0 ? 0.0 : random.uniform(0.2, 4.0) * scene.size_m;
    const double half_angle_rad = glm::radians(random.uniform(1.0, 60.0));
    scene.lights.push_back(spot(place, random.direction(), half_angle_rad, range_m));
    scene.lights.push_back(awayLamp(random, scene, origin));
}

/// The same lights as points; a sun has a place then, on the way from where it shone.
/// Point lights, and spot lights that are wider than one frustum holds.
void shineAround(std::uint64_t seed, RandomScene& scene, const glm::dvec3& origin)
{
    Random random(seed + 2000000);
    for (Light& light : scene.lights) {
        if (light.type == LightType::directional)
            light.position_ws = origin - light.direction_ws * (0.7 * scene.size_m);
        light.type = random.below(3) == 0 ? LightType::spot : LightType::point;
        light.outer_half_angle_rad = random.uniform(1.05, 1.5707);
    }
}

struct Look {
    glm::dvec3 eye;
    glm::dvec3 target;
};

/// Where the camera is and where it looks, before its lens.
Look randomLook(Random& random, RandomScene& scene, const glm::dvec3& origin)
{
    const double size = scene.size_m;
    Look look;
    look.eye = origin + random.inBox(glm::dvec3(-2 * size), glm::dvec3(2 * size));
    look.target = origin + random.inBox(glm::dvec3(-size), glm::dvec3(size));
    const std::uint32_t object = random.below(scene.set.size());
    const Aabb& box = scene.set.bounds(object);
    if (random.below(2) == 0) // right at something
        look.target = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
    if (random.below(6) == 0 && scene.set.flags(object).casts && box.min != box.max) {
        mark(scene, Awkward::camera_in_caster);
        look.eye = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
    }
    const Light& light = scene.lights[random.below(3)];
    switch (random.below(12)) {
    case 0:
    case 1:
        mark(scene, Awkward::camera_along_light);
        look.target = look.eye + light.direction_ws;
        break;
    case 2:
    case 3:
        mark(scene, Awkward::camera_into_light);
        look.target = look.eye - light.direction_ws;
        break;
    case 4:
        if (light.type == LightType::directional || glm::distance(light.position_ws, origin) > 10.0 * size)
            break;
        mark(scene, Awkward::camera_at_lamp);
        look = {light.position_ws, light.position_ws + light.direction_ws};
        break;
    default:
        break;
    }
    if (look.eye == look.target)
        look.target.z -= 1.0;
    return look;
}

double randomFov(Random& random, RandomScene& scene)
{
    switch (random.below(12)) {
    case 0:
        mark(scene, Awkward::least_view);
        return glm::radians(1.0);
    case 1:
        mark(scene, Awkward::widest_view);
        return glm::radians(170.0);
    default:
        return glm::radians(random.uniform(1.0, 170.0));
    }
}

Camera randomCamera(Random& random, RandomScene& scene, const glm::dvec3& origin)
{
    const double size = scene.size_m;
    const auto [eye, target] = randomLook(random, scene, origin);
    const std::uint32_t lens = random.below(4);
    if (lens == 1) {
        mark(scene, Awkward::orthographic);
        return orthographicCamera(eye, target, random.uniform(0.1, 3.0) * size, 5 * size);
    }
    const double fov = randomFov(random, scene);
    if (lens == 0) {
        mark(scene, Awkward::no_far_plane);
        return endlessCamera(eye, target, fov, random.uniform(0.3, 3.0), 0.01 * size);
    }
    if (lens == 2) // a far plane so far that it means nothing
        return perspectiveCamera(eye, target, fov, 1.6, 0.001 * size, 1e7 * size);
    const double far_m = random.uniform(0.5, 9.0) * size;
    return perspectiveCamera(eye, target, fov, random.uniform(0.3, 3.0), 0.01 * size, far_m);
}

CascadeOptions randomCascades(Random& random, double size_m)
{
    CascadeOptions cascades;
    cascades.count = 1 + random.below(kMaxCascades);
    cascades.lambda = random.uniform();
    cascades.blend = random.below(3) == 0 ? 0.0 : random.uniform(0.0, 0.5);
    double end_m = 0.0;
    const bool explicit_ends = random.below(4) == 0;
    for (std::uint32_t i = 0; explicit_ends && i + 1 < cascades.count; ++i) {
        end_m += random.uniform(0.01, 1.0) * size_m;
        cascades.ends_m[i] = end_m;
    }
    return cascades;
}

} // namespace

std::string_view nameOf(Awkward kind)
{
    constexpr std::string_view kNames[kAwkwardCount] = {
        "camera along light", "camera into light", "camera at lamp", "camera in caster", "no size",      "far lamp",
        "least view",         "widest view",       "no far plane",   "orthographic",     "sun overhead", "far origin"};
    return kNames[static_cast<std::size_t>(kind)];
}

Frame RandomScene::frame() const
{
    Frame frame;
    frame.camera = camera;
    frame.lights = lights;
    frame.objects = &set;
    return frame;
}

RandomScene randomScene(std::uint64_t seed, const Technique& technique)
{
    Random random(seed);
    RandomScene scene;
    scene.options.technique = technique;
    scene.size_m = std::pow(10.0, random.uniform(-1.0, 3.0));
    glm::dvec3 origin(0.0);
    if (random.below(3) == 0) {
        mark(scene, Awkward::far_origin);
        origin = random.inBox(glm::dvec3(-1000), glm::dvec3(1000)) * scene.size_m * 0.2;
    }
    addObjects(random, scene, origin);
    addLights(random, scene, origin);
    if (technique.partition == Partition::cube || technique.partition == Partition::paraboloid ||
        (technique.partition == Partition::multi && random.below(2) == 0))
        shineAround(seed, scene, origin);
    scene.camera = randomCamera(random, scene, origin);
    scene.options.map_size = 16U << random.below(8);
    scene.options.border_texels = random.below(2) == 0 ? 4.0 : random.uniform(0.0, 64.0);
    if (random.below(3) == 0)
        scene.options.max_distance_m = random.uniform(0.2, 3.0) * scene.size_m;
    scene.options.cascades = randomCascades(random, scene.size_m);
    return scene;
}

} // namespace gnomon::test
