// SPDX-License-Identifier: Apache-2.0
#include "compare_judged.h"

#include "truth_run.h"

#include <utility>

namespace gnomon::app {

Judged judge(const Shot& shot, const Settings& settings)
{
    const std::size_t light = lightIndex(shot, settings);
    Judged judged;
    judged.subject = {&shot.scene, &shot.state, shot.eye, {shot.lights[light]}, 0};
    TruthTracer tracer(shot, settings);
    TruthRun run = tracer.trace(light);
    judged.truth = std::move(run.traced);
    const truth::Visibility& visibility = judged.truth.visibility;
    judged.facts = {.kind = visibility.kind,
                    .samples = visibility.kind == truth::Kind::area ? settings.samples : 1,
                    .seed = settings.seed,
                    .rays = visibility.rays,
                    .seconds = visibility.seconds,
                    .from_cache = run.from_cache,
                    .point_like = isPointLike(shot.lights[light].caster)};
    return judged;
}

std::unique_ptr<const JudgedShot> judgeShot(const Settings& settings)
{
    auto made = std::make_unique<JudgedShot>();
    made->shot = makeShot(settings);
    requireSizedLights(settings, {&made->shot.lights[lightIndex(made->shot, settings)], 1});
    made->judged = judge(made->shot, settings);
    return made;
}

} // namespace gnomon::app
