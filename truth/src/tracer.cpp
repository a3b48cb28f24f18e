// SPDX-License-Identifier: Apache-2.0
#include "truth/visibility.h"

#include "camera_rays.h"
#include "parallel.h"
#include "pixel_points.h"
#include "scene_geometry.h"
#include "shadow_rays.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>

#include <cassert>
#include <chrono>
#include <limits>
#include <new>
#include <string>

namespace gnomon::truth {
namespace {

/// Up to this many triangles each object gets its own copy in the world, which rays cross in three quarters of the time
/// that instances take; a triangle takes some 200 bytes.
constexpr std::uint64_t kFlatTriangles = 3'000'000;

/// Null when cancelled.
std::unique_ptr<SceneGeometry> buildGeometry(const scene::Scene& scene, const scene::State& state,
                                             const Options& options)
{
    try {
        return std::make_unique<SceneGeometry>(scene, state, kFlatTriangles, options);
    } catch (const BuildingCancelled&) {
        return nullptr;
    } catch (const std::bad_alloc&) {
        throw Error("building the ray tracer's structure", "memory ran out", "use a smaller scene",
                    ErrorKind::out_of_memory);
    }
}

void requireSamples(const Options& options)
{
    const std::uint32_t samples = options.samples;
    if (options.kind == Kind::area && (samples < kSampleSets || samples > kMaxSamples || samples % kSampleSets != 0)) {
        throw Error("tracing area light", std::to_string(samples) + " rays per pixel were asked for",
                    "ask for a multiple of " + std::to_string(kSampleSets) + " up to " + std::to_string(kMaxSamples));
    }
}

glm::dvec3 read3(const float* values)
{
    return {values[0], values[1], values[2]};
}

void write3(float* values, const glm::dvec3& v)
{
    values[0] = static_cast<float>(v.x);
    values[1] = static_cast<float>(v.y);
    values[2] = static_cast<float>(v.z);
}

} // namespace

struct Tracer::Impl {
    std::unique_ptr<SceneGeometry> geometry; // null: building was cancelled

    /// Nothing where no shadow ray is to be traced.
    [[nodiscard]] std::optional<Receiver> receiverAt(const Surfaces& surfaces, const View& view, std::uint32_t x,
                                                     std::uint32_t y) const;
};

std::optional<Receiver> Tracer::Impl::receiverAt(const Surfaces& surfaces, const View& view, std::uint32_t x,
                                                 std::uint32_t y) const
{
    const std::uint32_t id = *surfaces.object_ids.pixel(x, y);
    if (id == 0) {
        return {};
    }
    std::optional<Receiver> receiver = receiverOn(*geometry, view,
                                                  {.object = id - 1,
                                                   .triangle = *surfaces.triangle_ids.pixel(x, y),
                                                   .point = read3(surfaces.points.pixel(x, y)),
                                                   .normal = read3(surfaces.normals.pixel(x, y))});
    if (receiver) {
        receiver->pixel = std::uint64_t{y} * view.size_px.x + x;
    }
    return receiver;
}

Tracer::Tracer(const scene::Scene& scene, const scene::State& state, const Options& options)
    : impl_(std::make_unique<Impl>())
{
    impl_->geometry = buildGeometry(scene, state, options);
}

Tracer::~Tracer() = default;

std::optional<Surfaces> Tracer::see(const View& view, const Options& options) const
{
    assert(view.size_px.x >= 1 && view.size_px.y >= 1);
    if (!impl_->geometry) {
        return {};
    }
    const glm::uvec2 size = view.size_px;
    Surfaces surfaces{ImageOf<std::uint32_t>(size.x, size.y, 1, 0),
                      ImageOf<std::uint32_t>(size.x, size.y, 1, scene::kNone), ImageF(size.x, size.y, 3, 0.0F),
                      ImageF(size.x, size.y, 3, 0.0F), ImageF(size.x, size.y, 3, 0.0F)};
    const CameraRays rays(*impl_->geometry, view);
    const bool finished = forEachTile(size, options, [&](const Tile& tile) {
        tile.forEachPixel([&](std::uint32_t x, std::uint32_t y) {
            if (const auto seen = rays.trace({x + 0.5, y + 0.5})) {
                *surfaces.object_ids.pixel(x, y) = seen->object + 1;
                *surfaces.triangle_ids.pixel(x, y) = seen->triangle;
                write3(surfaces.points.pixel(x, y), seen->point);
                write3(surfaces.normals.pixel(x, y), seen->normal);
                write3(surfaces.smooth_normals.pixel(x, y), seen->smooth_normal);
            }
        });
    });
    return finished ? std::optional(std::move(surfaces)) : std::nullopt;
}

std::optional<Visibility> Tracer::trace(const Surfaces& surfaces, const View& view, const Light& light,
                                        const Options& options) const
{
    assert(surfaces.object_ids.width == view.size_px.x && surfaces.object_ids.height == view.size_px.y);
    requireSamples(options);
    if (!impl_->geometry) {
        return {};
    }
    const auto start = std::chrono::steady_clock::now();
    const glm::uvec2 size = view.size_px;
    Visibility result{options.kind, ImageF(size.x, size.y, 1, 1.0F), ImageF(size.x, size.y, 1, 0.0F),
                      ImageF(size.x, size.y, 1, std::numeric_limits<float>::infinity())};
    const bool over_pixels = options.pixels == PixelTruth::area;
    const CameraRays camera(*impl_->geometry, view);
    const ShadowRays shadow_rays(*impl_->geometry, light, over_pixels ? optionsOfPoint(options) : options);
    std::atomic<std::uint64_t> rays{0};
    const bool finished = forEachTile(size, options, [&](const Tile& tile) {
        std::uint64_t rays_of_tile = 0;
        tile.forEachPixel([&](std::uint32_t x, std::uint32_t y) {
            if (const auto receiver = impl_->receiverAt(surfaces, view, x, y)) {
                const ShadowRays::Result traced =
                    over_pixels ? traceOverPixel(*impl_->geometry, view, camera, shadow_rays, options.seed, {x, y})
                                : shadow_rays.trace(*receiver);
                *result.visibility.pixel(x, y) = static_cast<float>(traced.visibility);
                *result.standard_error.pixel(x, y) = static_cast<float>(traced.standard_error);
                *result.first_blocker_m.pixel(x, y) = static_cast<float>(traced.first_blocker_m);
                rays_of_tile += traced.rays;
            }
        });
        rays += rays_of_tile;
    });
    if (!finished) {
        return {};
    }
    result.rays = rays;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace gnomon::truth
