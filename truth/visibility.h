// SPDX-License-Identifier: Apache-2.0
// Ray-traced visibility, with which every technique is compared. It shares no shadow code with the techniques; it knows
// the scene, a camera's rays and a light, nothing else.
#pragma once

#include "image/image.h"
#include "scene/state.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace gnomon::truth {

/// `hard`: one ray to the light's centre. `area`: many to the light's disc as the surface point sees it.
enum class Kind : std::uint8_t { hard, area };

/// The part of a pixel that its visibility is of. `centre`: the surface point in its middle, where a renderer shades.
/// `area`: the mean over all of the pixel, which a renderer with many points a pixel approaches.
enum class PixelTruth : std::uint8_t { centre, area };

/// A light as the rays see it.
struct Light {
    scene::LightType type = scene::LightType::directional;
    glm::dvec3 position_ws{0.0};                // spot, point
    glm::dvec3 direction_ws{0.0, -1.0, 0.0};    // directional, spot: unit, the way light travels
    double angular_diameter_rad = 0.0092502450; // directional: 0.53 degrees, the sun; [0, pi)
    double radius_m = 0.0;                      // spot, point: of the emitting sphere; 0 makes area the same as hard
    /// Nearer objects do not cast, as in a shadow map's projection. Spot: a plane, metres from the centre along
    /// `direction_ws`, so near_m / cos(a) from the centre at the angle a off that axis; 0: no plane, and objects behind
    /// the light cast too. Point: a sphere, metres from the centre.
    double near_m = 0.0;
    /// A bit for each group of objects that block its rays (scene::Object::groups); other objects do not block them.
    std::uint32_t groups = 0xFFFFFFFFU;
};

/// Where the rays start and which pixel each goes through: pixel (x, y) looks through the point
/// ((x + 0.5) / width * 2 - 1, (y + 0.5) / height * 2 - 1) of clip space, y down.
struct View {
    glm::dvec3 eye_ws{0.0};
    /// The inverse of any camera matrix with depth range [0, 1]. Nothing outside that range is seen. The eye of an
    /// orthographic one is nearer to its near plane than to its far one.
    glm::dmat4 world_from_clip{1.0};
    glm::uvec2 size_px{0}; // >= 1 each
};

/// The number of sets of a pixel's rays. Each set is stratified by itself and shifted at random, so that their spread
/// gives the standard error of the pixel's estimate.
inline constexpr std::uint32_t kSampleSets = 4;
inline constexpr std::uint32_t kMaxSamples = 65536;
/// Points in a pixel for PixelTruth::area, a stratified share of them in each set. They share Options::samples, but
/// have kSampleSets rays each at least.
inline constexpr std::uint32_t kPixelPoints = 64;

struct Options {
    Kind kind = Kind::area;
    /// Rays per pixel for area: kSampleSets .. kMaxSamples and a multiple of kSampleSets, else trace() throws Error.
    /// Plays no part for hard.
    std::uint32_t samples = 256;
    PixelTruth pixels = PixelTruth::centre;
    std::uint64_t seed = 1;
    std::uint32_t threads = 0; // 0: all cores; the result does not depend on it
    /// Called now and then from the calling thread with the share done, [0, 1]. May be empty.
    std::function<void(double)> progress;
    /// Any thread or signal handler may set it to true to cancel. May be null.
    const std::atomic<bool>* cancel = nullptr;
    /// Seconds, at least 1. When no thread finishes a row of a tile, 16 pixels, for this time, a call hangs: the
    /// process says so and ends with status 1. The slowest rows take a few seconds.
    std::uint32_t patience_s = 600;
};

/// Shadow rays that each pixel gets by these options, where its centre or all of its points count.
[[nodiscard]] std::uint32_t raysPerPixel(const Options& options);

/// The surfaces that the camera sees, by a ray through each pixel's centre. Images have the view's size.
struct Surfaces {
    ImageOf<std::uint32_t> object_ids;   // index into State::objects + 1; 0: background
    ImageOf<std::uint32_t> triangle_ids; // within the object's primitive; kNone: background
    ImageF points;                       // xyz, metres, relative to the eye; 0 at background
    ImageF normals;                      // xyz, unit, geometric normal of the triangle, towards the eye
    /// xyz, unit, the normal interpolated between the vertices, on the same side; `normals` where no smooth surface
    /// lies over the triangle.
    ImageF smooth_normals;
};

/// One light's visibility at every pixel.
struct Visibility {
    Kind kind = Kind::area;
    ImageF visibility;     // [0, 1]: 1 fully lit, and at background and objects that do not receive
    ImageF standard_error; // area: of each pixel's estimate, noisy by itself (pool squares over pixels); hard: all 0
    /// Metres from the surface to the first blocker; +infinity where there is none besides the surface itself.
    ImageF first_blocker_m;
    std::uint64_t rays = 0; // shadow rays traced
    double seconds = 0.0;   // that tracing took; kept when the result comes from a cache
};

/// Holds the acceleration structure of a scene at one moment. Opaque and alpha-masked surfaces are seen and cast
/// (masked ones where the texture's alpha, times factor and vertex colour, reaches the cutoff); blended ones are not
/// seen, and each lets 1 - alpha (1 - colour) of the light through; a mask holds the luminance of that. Parts that clip
/// planes cut away do not exist. Objects that do not cast, or in none of a light's groups, are seen only. Single-sided
/// triangles are seen from their front but cast from both sides. Objects whose transform is not finite take no part;
/// flattened ones do. Where memory runs out, all of this throws Error of the kind out_of_memory, or std::bad_alloc.
class Tracer {
public:
    /// `scene` and `state` must outlive the tracer and stay as they are. Builds on the calling thread, which takes
    /// about a second for a million triangles; of `options` only `progress` and `cancel` count. When building was
    /// cancelled, see() and trace() return nothing. Throws Error when the scene is beyond the limits of
    /// gnomon/world_range.h, and any exception of options.progress.
    Tracer(const scene::Scene& scene, const scene::State& state, const Options& options = {});
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// One ray per pixel. Nothing when cancelled.
    [[nodiscard]] std::optional<Surfaces> see(const View& view, const Options& options) const;
    /// Shadow rays from every surface point, offset along the geometric normal by an epsilon that follows the size of
    /// the coordinates. A surface whose smooth normal faces away from the light's centre has visibility 0; so has a ray
    /// of area truth that starts below the surface's own horizon. Where a triangle does not face all of the light but
    /// lies below the smooth surface of its vertices' normals, rays start on that surface (smooth_surface.h). A spot's
    /// cone and range play no part: that is shading. Nothing when cancelled. The same input gives the same bits,
    /// whatever the number of threads. With PixelTruth::area all this holds for each of a pixel's points. Points at
    /// background or on an object that does not receive do not count; first_blocker_m is the least of the others. A
    /// pixel whose centre does not count is 1.
    [[nodiscard]] std::optional<Visibility> trace(const Surfaces& surfaces, const View& view, const Light& light,
                                                  const Options& options) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::truth
