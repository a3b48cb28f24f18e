// SPDX-License-Identifier: Apache-2.0
// A host's description of one frame: camera, lights and the bounds of its objects. Plain data; nothing is kept.
#pragma once

#include <gnomon/choices.h>
#include <gnomon/device_rates.h>
#include <gnomon/export.h>
#include <gnomon/geometry.h>
#include <gnomon/moment_options.h>
#include <gnomon/object_set.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <cstdint>
#include <span>

namespace gnomon {

/// The range of z in a camera's clip space, from one depth plane to the other.
enum class ClipDepth : std::uint8_t {
    zero_to_one,      // [0, w]: Vulkan, Direct3D, Metal
    minus_one_to_one, // [-w, w]: OpenGL; the depth buffer holds z / w * 0.5 + 0.5
};

/// The viewer. Any projection, left- or right-handed, near or far first.
struct Camera {
    glm::dvec3 eye_ws{0.0}; // metres, world space
    /// From world space to clip space, where y is -1 in row 0 of the picture: of a picture that is drawn through a
    /// viewport of negative height, the matrix with its row of y negated.
    glm::dmat4 clip_from_world{1.0};
    /// Depth is 1 at the near plane, 0 at the far plane and where nothing was drawn. False: the other way round. All
    /// lights get Outcome degenerate where the matrix disagrees.
    bool reversed_z = true;
    /// How far clip_from_world moves the picture for anti-aliasing, pixels of Frame::size_px, y down; 0 where it does
    /// not. A jitter that is given here does not count as movement of the camera: see convergeSample().
    glm::dvec2 jitter_px{0.0};
    /// Only the host knows this: each matrix is a valid camera of the other kind too, with its near plane nearly twice
    /// or half as far away.
    ClipDepth clip_depth = ClipDepth::zero_to_one;

    bool operator==(const Camera&) const = default;
};
/// The camera's matrix with z in [0, w], whichever it has: z / w is what the depth buffer holds.
[[nodiscard]] GNOMON_API glm::dmat4 clipFromWorld(const Camera& camera);
/// Are its lines of sight parallel?
[[nodiscard]] GNOMON_API bool isOrthographic(const Camera& camera);
/// Does `now` see the same picture as `before`, apart from jitter_px and rounding? `size_px`: the size of both
/// pictures.
[[nodiscard]] GNOMON_API bool sameSight(const Camera& before, const Camera& now, const glm::uvec2& size_px);

/// One light that may cast. `key` tells lights apart over time: the same key in the next frame is the same light.
/// Several lights with one key are matched in their order: where one of them goes, the others are drawn anew.
struct Light {
    std::uint32_t key = 0;                   // the same as long as it is the same light
    LightType type = LightType::directional; // which of the numbers below count
    glm::dvec3 position_ws{0.0};             // spot, point
    glm::dvec3 direction_ws{0.0, -1.0, 0.0}; // directional, spot: unit, the way light travels
    /// spot: (0, pi / 2], from the axis. One frustum holds 60 degrees (1.0471); a wider light is divided as a point
    /// light is, by partition cube, multi, paraboloid or auto.
    double outer_half_angle_rad = 0.7853981634;
    double range_m = 0.0; // spot, point: reach, > 0; 0 means "as far as the scene goes"
    double near_m = 0.0;  // spot, point: nothing nearer along a map's axis casts; 0: found, see below
    /// Directional: how wide it is in the sky, 0 .. pi/2; 0.53 degrees is the sun. Filters that know the light's size
    /// make penumbrae from it. 0 is a light without size, with hard shadows.
    double angular_diameter_rad = 0.00925025;
    double radius_m = 0.0;    // spot, point: radius of the sphere that shines, 0 .. 1e9; 0: hard shadows
    bool casts_shadow = true; // false: no map; its mask channel reads 1
    /// Its brightness relative to the other lights: candela for a spot or point light, lux for a directional one, both
    /// in any one scale; >= 0. It weighs the lights where maps share a budget (ShadowOptions::budget_texels).
    double brightness = 1.0;
    std::uint32_t options = 0; // index of the planner's options for it; beyond them: Outcome refused
    /// Texels on a side of each of its maps: 16 .. those of its options, which also replace a value outside. 0: as its
    /// options say.
    std::uint32_t map_size = 0;
    /// The groups of casters that it makes shadows of (ObjectFlags::groups): bits, all values are legal. A caster
    /// in none of them is in none of its maps. 0: nothing casts, and the light needs no map.
    std::uint32_t groups = kAllGroups;

    bool operator==(const Light&) const = default;
};

/// As which type of light its maps are laid out: a spot light that is wider than one frustum holds as a point light.
[[nodiscard]] GNOMON_API LightType layoutOf(const Light& light);

/// How far along a spot or point light's rays things count.
struct LightExtent {
    double near_m = 0.0;  // nothing nearer casts
    double reach_m = 0.0; // nothing farther matters
};
/// The distances that Light::near_m and range_m stand for, zeros included. A range of 0 reaches the farthest corner of
/// the scene, but at least twice the near distance, or 1 m where the scene is only the light's own place. A near
/// distance of 0 is a thousandth of the reach. A planner takes a smaller one, down to a 100,000th: half the way to the
/// nearest bounds of a caster, and a 4000th where a caster's bounds are around the light. The bounds are those of all
/// objects, not empty. Precondition: the light's numbers are finite and not negative. For a directional light, zeros.
[[nodiscard]] GNOMON_API LightExtent extentOf(const Light& light, const Aabb& scene_bounds_ws);

/// A cell of a picture, as partition virtual asks for it: one of its points, and how much of it is the edge of a
/// shadow.
struct SeenCell {
    glm::vec2 place_px{0.0F}; // the point's pixel from the picture's top left corner; a pixel's middle is at 0.5
    float depth = 0.0F;       // as the depth buffer holds it there
    /// How much a finer map is worth to the cell: the sum over its pixels of the difference in visibility from one
    /// pixel to the next. Where the light's filter makes edges as soft as the light is large, squared differences are
    /// summed: a soft edge asks for less. A sharp edge across a cell of 8 x 8 pixels has about 8. Less than 0: nothing
    /// is to be seen in the cell.
    float edge = -1.0F;
};

/// The cells of an earlier picture for one light, from which partition virtual finds the next one's pages. A host makes
/// them from depth and mask of any frame before; the newer, the better.
struct PageRequests {
    std::uint32_t light_key = 0; // Light::key
    /// clipFromWorld() of the camera of that picture.
    glm::dmat4 clip_from_world{1.0};
    glm::uvec2 size_px{1};           // that picture's size
    std::span<const SeenCell> cells; // in any order; kept by the host
};

/// All that planning asks of a host.
struct Frame {
    std::uint64_t index = 0;            // counted by the host; the plan has it as well
    double time_s = 0.0;                // s, on any clock that does not run back; for steps and fades
    Camera camera;                      // the camera that looks at the scene
    glm::uvec2 size_px{1280, 720};      // the picture's size; >= 1
    std::span<const Light> lights;      // in any order; kept by the host
    const ObjectSet* objects = nullptr; // null: all lights get Outcome degenerate
    /// Layers of the world for options with LayerPlacement::world that give none themselves: from low to high, as many
    /// as their `layers`; else those lights get Outcome refused. Maps that were drawn with them are drawn again where
    /// they change. Empty: layers are found.
    std::span<const WorldLayer> layers;
    /// The camera was cut: the picture does not continue the last one. Nothing remembered from earlier pictures is
    /// used.
    bool cut = false;
    /// The time that drawing a texel of a map takes on this device, milliseconds, as far as the host knows (DrawRate,
    /// gnomon/draw_rate.h). Only ShadowOptions::draw_budget_ms uses it. A value that is not a finite number above 0
    /// means that it is not known.
    double draw_ms_per_texel = 0.0;
    /// The device's, by which map size auto weighs error against time. They are those of the table for a GPU where a
    /// host does not know better.
    DeviceRates rates = ratesOf(RateSource::gpu);
    /// The backend can clamp casters onto a near plane that they are before (Vulkan: depthClamp). False: near planes
    /// lie before all casters, which costs some precision of depth (ViewProjection::clamp_near is false).
    bool clamps_depth = true;
    /// Partition virtual: what an earlier picture has shown, at most one for each light. A light without any has pages
    /// by what its objects' bounds let expect. After a cut they are not used.
    std::span<const PageRequests> requests;
};

} // namespace gnomon
