// SPDX-License-Identifier: Apache-2.0
// `gnomon plan`: the plan of a frame as JSON, or a light's maps as a picture. Uses core alone, so it needs no GPU and
// is the same on every machine. The exception is lvsm's layers of depth that follow drawn depths (lloyd): those are
// drawn and read back.
#include "app/shot.h"
#include "plan_layers.h"
#include "progress.h"
#include "result_json.h"
#include "shot_parts.h"
#include "streams.h"
#include "subcommands.h"

#include "lab/plan_picture.h"

#include <gnomon/object_set.h>
#include <gnomon/planner.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

template <typename Vector>
Json numbers(const Vector& v)
{
    return Json::array({v.x, v.y, v.z});
}

/// Adds the light's own properties, which the plan does not have.
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
                        {"groups", object.groups},
                        {"bias_m", object.bias_m},
                        {"dynamic", object.dynamic},
                        {"min_ws", numbers(bounds.min)},
                        {"max_ws", numbers(bounds.max)}});
    }
    return list;
}

/// Frames and their plans, one after the other; the ones before it decide what is redrawn in a frame.
class PlannedFrames {
public:
    PlannedFrames(Shot& shot, const Settings& settings) : shot_(shot), settings_(settings), planner_(settings.shadow)
    {
        const bool counts = !hasMaps(settings.shadow);
        host::fillObjectSet(
            shot.state, objects_, counts ? host::closedObjects(shot.scene, shot.state) : std::vector<std::uint8_t>(),
            settings.shadow.ids.of == IdOf::face ? host::pieceCounts(shot.scene, shot.state)
                                                 : std::vector<std::uint16_t>(),
            settings.shadow.multi.divide == MultiDivide::receivers ? host::joinedObjects(shot.scene, shot.state)
                                                                   : std::vector<std::uint8_t>());
    }
    void planAll(PlanLayers& layers)
    {
        const FrameRange range = settings_.frames.value_or(FrameRange{});
        Progress progress("planning", range.last - range.first + 1);
        for (std::uint32_t index = range.first;; ++index) {
            if (index != range.first) {
                moveShot(shot_, settings_, index);
                host::fillObjectSet(shot_.state, objects_);
            }
            planOne(index);
            layers.follow(shot_);
            progress.step();
            if (index == range.last) {
                return;
            }
        }
    }
    /// The frame, the plan and the objects of the last frame.
    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] const Plan& plan() const { return *plan_; }
    [[nodiscard]] const ObjectSet& objects() const { return objects_; }
    /// The waits of all frames after the first.
    [[nodiscard]] const lab::Waits& waits() const { return waits_; }

private:
    void planOne(std::uint32_t index)
    {
        lights_ = castersOf(shot_);
        frame_.index = index;
        frame_.time_s = shot_.state.time_s;
        frame_.camera = host::cameraOf(shot_.eye, settings_.size_px.x, settings_.size_px.y, shot_.state.bounds_ws);
        frame_.size_px = settings_.size_px;
        frame_.lights = lights_;
        frame_.objects = &objects_;
        frame_.rates = settings_.rates.value_or(ratesOf(RateSource::gpu)); // no device is asked
        plan_ = &planner_.plan(frame_);
        if (index != settings_.frames.value_or(FrameRange{}).first) { // in which all maps are drawn
            waits_.take(*plan_);
        }
    }

    Shot& shot_;
    const Settings& settings_;
    ObjectSet objects_;
    Planner planner_;
    lab::Waits waits_;
    std::vector<Light> lights_;
    Frame frame_;
    const Plan* plan_ = nullptr;
};

/// The maps of the light that --light names.
void drawPlan(const Settings& settings, const Shot& shot, const PlannedFrames& planned)
{
    const std::size_t light = lightIndex(shot, settings);
    const host::ShadedLight& shaded = shot.lights[light];
    const Plan& plan = planned.plan();
    const LightPlan& light_plan = plan.lights[light];
    lab::PlanCaption caption;
    caption.title = fmt::format("Light {} of {}: {}", shaded.name, settings.scene, describeTechnique(settings));
    caption.subtitle = fmt::format("{} light, camera {}, {}x{} pixels", nameOf(shaded.caster.type), shot.camera,
                                   settings.size_px.x, settings.size_px.y);
    if (settings.frames) {
        caption.subtitle += fmt::format(", frame {}", plan.frame);
    }
    if (light_plan.steps.paired) {
        caption.subtitle += fmt::format("; the sun's earlier position, {:.0f} % of the way to the later one gone",
                                        100.0 * light_plan.steps.share);
    }
    const std::string svg = lab::planSvg(planned.frame(), plan, static_cast<std::uint32_t>(light), caption);
    writeResult(settings.draw, svg);
    if (!settings.json.empty()) {
        return; // standard output holds JSON alone
    }
    writeStdout(fmt::format("{}: the maps of light {} of {}, {}\n", settings.draw, shaded.name, settings.scene,
                            describeTechnique(settings)));
}

/// Everything: what moved over --frames, and what is told of it on the way.
struct PlanRun {
    explicit PlanRun(const Settings& settings)
        : shot(makeShot(settings)), layers(settings, shot), planned(shot, settings)
    {
        std::for_each(shot.notices.begin(), shot.notices.end(), notice);
        if (settings.shadow.draw_budget_ms > 0.0) {
            notice("draw-budget.ms bounds nothing here: what drawing takes is measured where maps are drawn");
        }
        planned.planAll(layers);
        if (const std::optional<std::string> waits = waitNote(planned.waits())) {
            notice(*waits);
        }
    }

    Shot shot;
    PlanLayers layers;
    PlannedFrames planned;
};

Json planJson(const Settings& settings, PlanRun& run)
{
    const Plan& plan = run.planned.plan();
    Json json{{"version", GNOMON_VERSION}, {"scene", settings.scene}, {"camera", run.shot.camera}};
    json["settings"] = settingsJson(settings, kPlan);
    json.update(Json::parse(toJson(plan)));
    run.layers.describe(plan, json["views"]);
    for (std::size_t i = 0; i < run.shot.lights.size() && i < json["lights"].size(); ++i) {
        describeLight(run.shot.lights[i], json["lights"][i]);
    }
    json["objects"] = objectsJson(run.shot, run.planned.objects());
    return json;
}

} // namespace

int runPlan(const Settings& settings)
{
    PlanRun run(settings);
    if (!settings.draw.empty()) {
        drawPlan(settings, run.shot, run.planned);
        if (settings.json.empty()) {
            return 0;
        }
    }
    writeResult(settings.json, jsonText(planJson(settings, run)));
    return 0;
}

} // namespace gnomon::app
