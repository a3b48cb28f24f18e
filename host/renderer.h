// SPDX-License-Identifier: Apache-2.0
// Our own small renderer: uploads a scene, draws a G-buffer, asks the library for the mask, shades. A host like any
// other: it knows the library by its public headers alone.
#pragma once

#include "host/gpu.h"
#include "image/image.h"
#include "scene/state.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::host {

/// Where the picture is taken from; perspective.
struct Eye {
    glm::dvec3 position_ws{0.0};
    glm::dvec3 target_ws{0.0, 0.0, -1.0};
    glm::dvec3 up_ws{0.0, 1.0, 0.0};
    double fov_y_rad = 0.8; // vertical; (0, pi)
    double near_m = 0.0;    // 0: 1/20000 of the diagonal of the scene's bounds
    double far_m = 0.0;     // 0: behind everything
};

/// A light as it is shaded and as it casts. Made from the scene's placed lights (lightsOf) or from the command line.
struct ShadedLight {
    std::string name;
    Light caster;                        // gnomon/frame.h
    glm::vec3 colour{1.0F};              // linear, times intensity at full strength: lux (directional) or candela
    glm::vec3 strength{1.0F};            // what it gives now, as a share of that; the exposure is chosen for all of it
    double inner_half_angle_rad = 0.0;   // spot
    glm::vec3 up_ws{0.0F, 0.0F, 1.0F};   // orients the cookie
    std::uint32_t cookie = scene::kNone; // image of the scene
};
/// A light of strength 0 casts no shadow, so that nobody draws a map for it.
[[nodiscard]] std::vector<ShadedLight> lightsOf(const scene::Scene& scene, const scene::State& state);

/// `fxaa` smooths edges of the finished picture; `ssaa4` draws and shades four samples a pixel (twice the size on each
/// side) and averages them.
enum class AntiAliasing : std::uint8_t { none, fxaa, ssaa4 };

/// Bloom: what is brighter than a threshold glows into its surroundings, as it does in every lens. Light is measured in
/// exposed radiance, the unit of Picture::linear: the tone curve shows 1 at 80 % of display white and 7.2 at white.
struct BloomOptions {
    bool on = false;
    float threshold = 0.8F;   // exposed radiance of the brightest channel from which on light glows in full; [0, 64]
    float knee = 0.25F;       // share of the threshold, to both sides of it, over which that sets in; [0, 1]
    float intensity = 1.0F;   // how much of the light above the threshold is spread; [0, 4]
    float radius = 1.0F;      // half the reach of the tent that enlarges each level, in the level's texels; [0.5, 3]
    std::uint32_t levels = 6; // halvings, each of which doubles the glow's reach; 1 to 8, and no more than the size has
};

struct RenderOptions {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
    ShadowOptions shadow; // cascades.pass = layered is refused (Error) where ShadowRenderer refuses it
    AntiAliasing anti_aliasing = AntiAliasing::none;
    BloomOptions bloom;
    bool shadows = true;    // false: no plan, no maps, every mask reads 1 (the baseline of frame_ratio)
    bool reuse_maps = true; // false: every map is drawn every frame whatever the plan says
};

/// The passes of a frame, in order; a value that needs no heap. What does not fit is left out.
class PassRecords {
public:
    void push_back(const vulkan::PassRecord& pass)
    {
        if (size_ < records_.size()) {
            records_[size_++] = pass;
        }
    }
    [[nodiscard]] const vulkan::PassRecord* begin() const { return records_.data(); }
    [[nodiscard]] const vulkan::PassRecord* end() const { return records_.data() + size_; }
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] const vulkan::PassRecord& operator[](std::size_t i) const { return records_[i]; }

private:
    std::array<vulkan::PassRecord, 96> records_{};
    std::size_t size_ = 0;
};

/// Lights of one frame at most.
inline constexpr std::size_t kMaxLights = 64;

/// CPU stages and GPU passes of one frame, milliseconds.
struct FrameTimes {
    double advance_ms = 0.0; // ObjectSet update + transform upload
    double plan_ms = 0.0;
    double record_ms = 0.0;
    double frame_ms = 0.0; // from the start of the frame's work to the GPU being done, without read-back
    PassRecords passes;
    vulkan::MapReuse reuse; // which maps were drawn, restored and left as they were; zeros without shadows
};

/// A frame read back.
struct Picture {
    Image8 colour;                     // RGB, sRGB-encoded, tone-mapped
    ImageF linear;                     // RGB, linear radiance before the tone curve; only if asked for
    ImageF glow;                       // RGB, half the size: sum of the levels of bloom; only if asked for and on
    std::vector<ImageF> masks;         // one 1-channel image per light, in the order of the lights given
    ImageF depth;                      // camera depth, reversed z
    ImageOf<std::uint32_t> object_ids; // index into State::objects + 1; 0 background
    ImageF normals;                    // geometric, world space, xyz
};
struct WantedImages {
    bool colour = true;
    bool linear = false;
    bool glow = false;
    bool masks = false;
    bool geometry = false; // depth, ids, normals
};

class Renderer {
public:
    /// Uploads the scene. Throws Error (limits, memory, device).
    Renderer(Gpu& gpu, const scene::Scene& scene, const scene::State& state, const RenderOptions& options);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws one frame of `state` (same scene, any time; only its dynamic objects may differ) and waits for the GPU.
    /// Blended surfaces are lit without shadow, cast none and are not in the masks. Throws Error, for more than
    /// kMaxLights lights too. Allocates nothing once warm, unless the plan outgrows the maps or the number of lights
    /// changes. `masks_instead`: use these visibility masks (one per light, as Picture::masks) instead of the
    /// library's, e.g. the ray tracer's.
    FrameTimes draw(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                    const std::vector<ImageF>* masks_instead = nullptr);
    /// The moment of the last draw() once more, from another eye: maps stay as they are, only the picture and its masks
    /// are new. `state` and `lights` as they were then. For measuring what changes at a point of the world from frame
    /// to frame. Does nothing for what a technique remembers of its frames, so what reads that (step-alternate) or
    /// makes maps of the picture (sdsm) is not to be asked. Precondition: draw(), not with other masks.
    void drawAgain(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights);
    /// Reads back the last frame drawn.
    [[nodiscard]] Picture read(const WantedImages& wanted);

    /// The plan of the last frame; views with View::gpu_cascade as the GPU has fitted them.
    [[nodiscard]] const Plan& plan() const;
    /// Bytes of every image and buffer, by purpose: the scene's, the host's own and the library's.
    [[nodiscard]] std::vector<vulkan::MemoryUse> memory() const;
    /// How cascades are drawn, if there are any: each or layered.
    [[nodiscard]] vulkan::CascadePass cascadePass() const;
    /// What making the last frame's maps filterable took; zeros without such passes. After draw().
    [[nodiscard]] vulkan::FilterCost filterCost() const;
    /// lvsm: the layers of depth of a view of plan(), nearest first, as the last frame used them; else empty.
    [[nodiscard]] std::vector<vulkan::DepthLayer> depthLayers(std::uint32_t view) const;
    /// The map's texels of one layer of the image at its finest level, as stored: one to four channels, unorm ones in
    /// [0, 1]. For tests and debug views. Throws Error when there is no such layer.
    [[nodiscard]] ImageF readMap(std::uint32_t layer);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The camera of a frame: reversed z, y down. Used by whoever needs the same view as the picture (plan, truth).
[[nodiscard]] Camera cameraOf(const Eye& eye, std::uint32_t width, std::uint32_t height, const Aabb& scene_bounds_ws);
/// Fills an ObjectSet with a state's objects (handle = index) or updates it.
void fillObjectSet(const scene::State& state, ObjectSet& objects);

} // namespace gnomon::host
