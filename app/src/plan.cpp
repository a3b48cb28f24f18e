// SPDX-License-Identifier: Apache-2.0
// `gnomon plan`: the plan of a frame as JSON. Uses core alone, so it needs no GPU and says the same on every machine;
// but for lvsm's layers of depth where they follow what is drawn (lloyd): those are drawn and read back.
#include "app/shot.h"
#include "plan_layers.h"
#include "progress.h"
#include "result_json.h"
#include "subcommands.h"

#include <gnomon/object_set.h>
#include <gnomon/planner.h>

#include <fmt/format.h>

namespace gnomon::app {
namespace {

template <typename Vector>
Json numbers(const Vector& v)
{
    return Json::array({v.x, v.y, v.z});
}

/// What the light is, beside what the plan says of it.
void describeLight(const host::ShadedLight& light, Json& json)
{
    const Light& caster = light.caster;
    json["name"] = light.name;
    json["type"] = nameOf(caster.type);
    if (caster.type != LightType::point) {
        json["direction_ws"] = numbers(caster.direction_ws);
    }
    if (caster.type == LightType::directional) {
        json["angular_diameter_rad"] = caster.angular_diameter_rad;
        return;
    }
    json["position_ws"] = numbers(caster.position_ws);
    json["range_m"] = caster.range_m;
    json["radius_m"] = caster.radius_m;
    if (caster.type == LightType::spot) {
        json["outer_half_angle_rad"] = caster.outer_half_angle_rad;
    }
}

Json objectsJson(const Shot& shot, const ObjectSet& objects)
{
    Json list = Json::array();
    for (std::size_t i = 0; i < shot.state.objects.size(); ++i) {
        const scene::Object& object = shot.state.objects[i];
        const Aabb& bounds = objects.bounds(static_cast<std::uint32_t>(i));
        list.push_back({{"id", i},
                        {"name", object.node == scene::kNone ? "" : shot.state.nodes[object.node].name},
                        {"primitive", object.primitive},
                        {"casts", object.casts},
                        {"receives", object.receives},
                        {"dynamic", object.dynamic},
                        {"min_ws", numbers(bounds.min)},
                        {"max_ws", numbers(bounds.max)}});
    }
    return list;
}

/// The last frame's plan; the ones before it decide what is redrawn.
const Plan& planFrames(Shot& shot, const Settings& settings, ObjectSet& objects, Planner& planner, PlanLayers& layers)
{
    const FrameRange range = settings.frames.value_or(FrameRange{});
    host::fillObjectSet(shot.state, objects);
    Progress progress("planning", range.last - range.first + 1);
    for (std::uint32_t index = range.first;; ++index) {
        if (index != range.first) {
            moveShot(shot, settings, index);
            host::fillObjectSet(shot.state, objects);
        }
        const std::vector<Light> lights = castersOf(shot);
        Frame frame;
        frame.index = index;
        frame.time_s = shot.state.time_s;
        frame.camera = host::cameraOf(shot.eye, settings.size_px.x, settings.size_px.y, shot.state.bounds_ws);
        frame.size_px = settings.size_px;
        frame.lights = lights;
        frame.objects = &objects;
        const Plan& plan = planner.plan(frame);
        layers.follow(shot);
        progress.step();
        if (index == range.last) {
            return plan;
        }
    }
}

} // namespace

int runPlan(const Settings& settings)
{
    Shot shot = makeShot(settings);
    for (const std::string& text : shot.notices) {
        notice(text);
    }
    ObjectSet objects;
    Planner planner(settings.plan);
    PlanLayers layers(settings, shot);
    const Plan& plan = planFrames(shot, settings, objects, planner, layers);
    Json json{{"version", GNOMON_VERSION}, {"scene", settings.scene}, {"camera", shot.camera}};
    json["settings"] = settingsJson(settings, kPlan);
    json.update(Json::parse(toJson(plan)));
    layers.describe(plan, json["views"]);
    for (std::size_t i = 0; i < shot.lights.size() && i < json["lights"].size(); ++i) {
        describeLight(shot.lights[i], json["lights"][i]);
    }
    json["objects"] = objectsJson(shot, objects);
    writeResult(settings.json, json.dump(2) + "\n");
    return 0;
}

} // namespace gnomon::app
