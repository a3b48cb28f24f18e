// SPDX-License-Identifier: Apache-2.0
#include "compare_judged.h"

#include "truth_run.h"

#include <utility>

namespace gnomon::app {

TruthFacts truthFacts(const Settings& settings, const Light& light)
{
    truth::Options options = truthOptions(settings);
    TruthFacts facts;
    facts.kind = options.kind;
    facts.pixels = options.pixels;
    facts.seed = options.seed;
    facts.point_like = isPointLike(light);
    options.kind = facts.point_like ? truth::Kind::hard : options.kind;
    facts.samples = truth::raysPerPixel(options);
    return facts;
}

Judged judge(const Shot& shot, const Settings& settings)
{
    const std::size_t light = lightIndex(shot, settings);
    Judged judged;
    judged.subject = {&shot.scene, &shot.state, shot.eye, {shot.lights[light]}, 0};
    TruthTracer tracer(shot, settings);
    TruthRun run = tracer.trace(light);
    judged.truth = std::move(run.traced);
    const truth::Visibility& visibility = judged.truth.visibility;
    judged.facts = truthFacts(settings, shot.lights[light].caster);
    judged.facts.rays = visibility.rays;
    judged.facts.seconds = visibility.seconds;
    judged.facts.from_cache = run.from_cache;
    return judged;
}

std::unique_ptr<const JudgedShot> judgeShot(const Settings& settings)
{
    auto made = std::make_unique<JudgedShot>();
    made->shot = makeShot(settings);
    noteSizesWithoutEffect(made->shot, settings, {&made->shot.lights[lightIndex(made->shot, settings)], 1});
    made->judged = judge(made->shot, settings);
    return made;
}

} // namespace gnomon::app
