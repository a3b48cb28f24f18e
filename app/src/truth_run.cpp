// SPDX-License-Identifier: Apache-2.0
#include "truth_run.h"

#include "interrupt.h"
#include "lab/compare.h"
#include "progress.h"
#include "streams.h"

#include <cassert>
#include <optional>
#include <utility>

namespace gnomon::app {

struct TruthTracer::Impl {
    const Shot& shot;
    const Settings& settings;
    std::optional<truth::Cache> cache;
    bool stores = true;
    // The tracer of the shot's present moment, made when first needed.
    std::optional<truth::Tracer> tracer;
    std::optional<truth::Surfaces> surfaces;

    void openCache();
    void keep(const scene::Hash128& key, const truth::Traced& traced);
    truth::Traced traceAnew(const truth::View& view, const truth::Light& light, truth::Options options);
};

void TruthTracer::Impl::openCache()
{
    if (settings.no_cache) {
        return;
    }
    if (const auto folder = truth::Cache::defaultFolder()) {
        cache.emplace(*folder);
    } else {
        notice("truths are not kept: neither XDG_CACHE_HOME nor HOME names a folder");
    }
}

void TruthTracer::Impl::keep(const scene::Hash128& key, const truth::Traced& traced)
{
    std::string why;
    if (cache && stores && !cache->store(key, traced, &why)) {
        notice("the truth is not kept: " + why);
        stores = false; // said once, and not tried for every frame; what is there already can still be had
    }
}

truth::Traced TruthTracer::Impl::traceAnew(const truth::View& view, const truth::Light& light, truth::Options options)
{
    options.cancel = &interruptFlag();
    if (!tracer) {
        Progress building("building");
        options.progress = [&](double share) {
            building.show(share);
        };
        tracer.emplace(shot.scene, shot.state, options);
    }
    if (interruptFlag()) {
        tracer.reset(); // it may be empty
        throw Interrupted();
    }
    Progress progress("tracing");
    options.progress = [&](double share) {
        progress.show(share);
    };
    if (!surfaces) {
        surfaces = tracer->see(view, options);
    }
    std::optional<truth::Visibility> visibility;
    if (surfaces) {
        visibility = tracer->trace(*surfaces, view, light, options);
    }
    if (!visibility) {
        throw Interrupted();
    }
    truth::Traced traced{std::move(*surfaces), std::move(*visibility)};
    surfaces.reset();
    return traced;
}

TruthTracer::TruthTracer(const Shot& shot, const Settings& settings) : impl_(new Impl{shot, settings})
{
    assert(settings.truth);
    impl_->openCache();
}

TruthTracer::~TruthTracer() = default;

void TruthTracer::moved()
{
    if (!impl_->shot.state.dynamic_objects.empty()) { // else only the camera did
        impl_->tracer.reset();
    }
    impl_->surfaces.reset();
}

void TruthTracer::takeBack(truth::Surfaces surfaces)
{
    assert(glm::uvec2(surfaces.object_ids.width, surfaces.object_ids.height) == impl_->settings.size_px);
    impl_->surfaces = std::move(surfaces);
}

TruthRun TruthTracer::trace(std::size_t light)
{
    const Shot& shot = impl_->shot;
    const Settings& settings = impl_->settings;
    const lab::Subject subject{&shot.scene, &shot.state, shot.eye, shot.lights, static_cast<std::uint32_t>(light)};
    const truth::View view = lab::truthView(subject, settings.size_px);
    const truth::Light rays_to = lab::truthLight(subject);
    const truth::Options options = truthOptions(settings);
    TruthRun run;
    if (impl_->cache) {
        run.key = truth::keyOf(shot.scene, shot.state, view, rays_to, options);
        if (auto kept = impl_->cache->load(run.key, view.size_px, *settings.truth)) {
            run.traced = std::move(*kept);
            run.from_cache = true;
        }
    }
    if (!run.from_cache) {
        run.traced = impl_->traceAnew(view, rays_to, options);
        impl_->keep(run.key, run.traced);
    }
    run.rays = run.traced.visibility.rays;
    run.seconds = run.traced.visibility.seconds;
    return run;
}

truth::Options truthOptions(const Settings& settings)
{
    assert(settings.truth);
    truth::Options options;
    options.kind = *settings.truth;
    options.samples = settings.samples;
    options.pixels = settings.truth_pixels;
    options.seed = settings.seed;
    return options;
}

bool isPointLike(const Light& light)
{
    return light.type == LightType::directional ? light.angular_diameter_rad == 0.0 : light.radius_m == 0.0;
}

} // namespace gnomon::app
