// SPDX-License-Identifier: Apache-2.0
// Our own small renderer: draws depth and a G-buffer, asks the library for the mask, and shades; or shades surfaces as
// they are drawn. A host like any other: it knows the library by its public headers alone.
#pragma once

#include "host/present.h"
#include "host/scene_on_gpu.h"
#include "host/view.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::host {

/// `fxaa` smooths edges of the finished picture; `ssaa4` draws and shades four samples a pixel (twice the size on each
/// side) and averages them.
enum class AntiAliasing : std::uint8_t { none, fxaa, ssaa4 };

/// The tone curve from light to what a screen can show. `neutral`: Khronos PBR Neutral, 2024, which keeps hues.
/// `filmic`: K. Narkowicz, 2015, applied to each channel by itself, which has more contrast and turns bright orange to
/// yellow. Both show a grey of 18 % in full light alike.
enum class ToneCurve : std::uint8_t { neutral, filmic };

/// How surfaces reflect. `phong_2005`: the shading of A. S. Shastry, "Soft-Edged Shadows", 2005: no ambient light, a
/// diffuse and a specular term of the base colour, the latter by the angle between eye and reflected ray to the power
/// of 8. Blended surfaces stay as they are.
enum class Reflection : std::uint8_t { materials, phong_2005 };

/// How a picture is shaded, once depths are drawn. `deferred`: surfaces go to a G-buffer, the library makes a mask of
/// it, and a pass over the screen shades. `forward`: each surface is shaded as it is drawn and asks the maps itself
/// (door 2 of docs/integrating.md), so that there is neither G-buffer nor mask.
enum class Shading : std::uint8_t { deferred, forward };

/// The sky behind everything, and its light. `plain`: a gradient of the scene's colours (scene::Environment), whatever
/// its lights do. `physical`: the air under the scene's sun and moon at their heights above the horizon, +y being up.
/// Their colour, ambient light, stars, lit windows and the exposure follow from it. The sun is the directional light
/// whose scene::Body is sun, or the brightest that shines from above; a scene without one has the plain sky.
enum class SkyModel : std::uint8_t { plain, physical };

/// Bloom: light brighter than a threshold glows into its surroundings, as in every lens. Light is measured in exposed
/// radiance, the unit of Picture::linear: ToneCurve::neutral shows 1 at 92 % of display white, filmic at 80 %.
struct BloomOptions {
    bool on = false;
    float threshold = 0.8F;   // exposed radiance of the brightest channel from which on light glows in full; [0, 64]
    float knee = 0.25F;       // share of the threshold, to both sides of it, over which that sets in; [0, 1]
    float intensity = 1.0F;   // how much of the light above the threshold is spread; [0, 4]
    float radius = 1.0F;      // half the reach of the tent that enlarges each level, in the level's texels; [0.5, 3]
    std::uint32_t levels = 6; // halvings, each of which doubles the glow's reach; 1 to 8, and no more than the size has
};

/// Ambient occlusion: where surfaces near by hide part of the sky, its light is less. It is found from depths on the
/// screen, so surfaces outside the picture hide nothing. It leaves the light of lamps and suns as it is.
struct AmbientOcclusionOptions {
    bool on = false;       // nothing where a frame is shaded forward, or Reflection has no ambient light
    float radius_m = 0.0F; // largest distance of a surface that hides; [0, 1e6]. 0: found from the scene, see
                           // occlusionRadius()
};

struct RenderOptions {
    std::uint32_t width = 1280; // pixels; changed by FrameRenderer::resize()
    std::uint32_t height = 720;
    AntiAliasing anti_aliasing = AntiAliasing::none;
    BloomOptions bloom;
    SkyModel sky = SkyModel::plain;
    double exposure_ev = 0.0; // stops by which the picture is brighter than its light asks for; [-16, 16]
    AmbientOcclusionOptions ambient_occlusion;
    ToneCurve tone = ToneCurve::neutral;
    bool dither =
        false; // noise of one step at most, the same for ever at a pixel, before the picture is rounded to 8 bits
    Reflection reflection = Reflection::materials;
    /// Forward: masks and geometry cannot be asked for (Error). A frame with `masks_instead` is shaded deferred all the
    /// same.
    Shading shading = Shading::deferred;
    /// Picture::linear may be asked for. False: shading may write the finished picture at once. It does so where the
    /// scene has nothing that blends or emits, and there is neither bloom nor supersampling; asking for Picture::linear
    /// is an Error then.
    bool keeps_light = true;
    std::uint32_t frames_in_flight = 2; // how many frames the GPU may be behind; 1 to 4
    /// Changed by FrameRenderer::setShadows(). cascades.pass = layered is refused (Error) where ShadowRenderer refuses
    /// it.
    ShadowOptions shadow;
    bool shadows = true;    // false: no plan, no maps, every mask reads 1 (the baseline of frame_ratio)
    bool reuse_maps = true; // false: every map is drawn every frame whatever the plan says
    /// A mask that would equal the last one is not drawn again (MaskInputs::content). False: masks are drawn in every
    /// frame, as with a camera that moves.
    bool reuse_masks = true;
    /// Each frame samples another point of its pixels (convergeSample()), so that an average over frames is one over
    /// pixels too. The first samples their middles.
    bool average_pixels = false;
    /// vulkan::ShadowRendererOptions::compact. A compact mask has no images by light, so Picture::masks cannot be asked
    /// for (Error). No effect without shadows.
    pack::CompactMaskRule compact_mask;
    bool shows_rays = false; // vulkan::ShadowRendererOptions::shows_rays
};

/// Why a renderer of these options cannot shade forward, as a sentence's part; empty: it can.
[[nodiscard]] std::string_view refusalOfForward(const RenderOptions& options);

/// The passes of a frame, in order; a value that needs no heap. Passes that do not fit are left out.
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

/// CPU stages and GPU passes of one frame, milliseconds.
struct FrameTimes {
    double advance_ms = 0.0; // ObjectSet update + transform upload
    double plan_ms = 0.0;
    double record_ms = 0.0;
    double frame_ms = 0.0; // from the start of submit() to the end of finish(), without read-back
    PassRecords passes;
    vulkan::MapReuse reuse; // which maps were drawn, restored and left as they were; zeros without shadows
    bool mask_kept = false; // the mask was left as it was
};

/// Draws frames of one size, one after the other. Several may share a scene.
///
/// Functions that wait for the GPU also throw what GpuOptions::while_waiting throws. A frame whose drawing threw is not
/// drawn; the next one is drawn as a new renderer would. After Error with ErrorKind::device_lost only the destructors
/// of this, of its scene and of its Gpu may be called: they do not throw, and wait a few seconds at most. All can be
/// made again with a new Gpu.
class FrameRenderer {
public:
    /// Makes its pipelines. `scene` outlives it. Throws Error (limits, memory, device).
    FrameRenderer(const SceneOnGpu& scene, const RenderOptions& options);
    ~FrameRenderer();
    FrameRenderer(const FrameRenderer&) = delete;
    FrameRenderer& operator=(const FrameRenderer&) = delete;

    /// Sets the size from the next frame on. Frames that the GPU has not finished keep their images. Throws Error, and
    /// then all stays as it was.
    void resize(std::uint32_t width, std::uint32_t height);
    /// Sets another technique from the next frame on, or none. It begins with empty maps. Frames that the GPU has not
    /// finished keep their maps. Throws Error, and then all stays as it was.
    void setShadows(const std::optional<ShadowOptions>& wanted);
    [[nodiscard]] const RenderOptions& options() const;

    /// Draws one frame of `state` (same scene, any time; only its dynamic objects may differ), and `present` it if that
    /// is given. Waits for the frame that is RenderOptions::frames_in_flight older, and for no other. Blended surfaces
    /// are not in the masks: they are in the shadow of the maps, and with `masks_instead` in none. Throws Error, for
    /// more than kMaxLights lights too.
    /// Allocates nothing once warm, unless the plan outgrows the maps or the number of lights changes. `masks_instead`:
    /// use these visibility masks (one per light, as Picture::masks) instead of the library's, e.g. the ray tracer's.
    void submit(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                Present* present = nullptr, const std::vector<ImageF>* masks_instead = nullptr);
    /// Waits for the GPU to finish the last frame. Precondition: submit().
    FrameTimes finish();
    /// submit() and finish().
    FrameTimes draw(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                    const std::vector<ImageF>* masks_instead = nullptr);
    /// Draws the moment of the last draw() again from another eye: only the picture and its masks are new, maps stay.
    /// `state` and `lights` are as in that draw(). It serves to measure changes at a point of the world from frame to
    /// frame. The technique's memory of frames stays as it is, so a technique that reads it (step-alternate) or makes
    /// maps from the picture (sdsm) must not be used. Precondition: draw() without `masks_instead`.
    void drawAgain(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights);

    /// Waits for the last frame and reads it back. Throws Error when there is none.
    [[nodiscard]] Picture read(const WantedImages& wanted);
    /// The map's texels of one layer of the image at its finest level, as stored: one to four channels, unorm ones in
    /// [0, 1]. For tests and debug views. Throws Error when there is no such layer.
    [[nodiscard]] ImageF readMap(std::uint32_t layer);

    // These describe the last frame, and wait for it where the GPU has the answer.
    /// Its plan; views with ViewProjection::gpu_cascade as the GPU has fitted them.
    [[nodiscard]] const Plan& plan() const;
    /// Whether the mask's pass is given object ids: where some object does not receive, or the filter tells objects
    /// apart.
    [[nodiscard]] bool masksReadIds() const;
    /// The cost of making its maps filterable; zeros without such passes.
    [[nodiscard]] vulkan::FilterCost filterCost() const;
    /// lvsm: the layers of depth of a view of plan(), nearest first; else empty.
    [[nodiscard]] std::vector<pack::DepthLayer> depthLayers(std::uint32_t view) const;

    /// Bytes of every image and buffer, by purpose: the scene's, its own and the library's.
    [[nodiscard]] std::vector<vulkan::MemoryUse> memory() const;
    /// How cascades are drawn, if there are any: each or layered.
    [[nodiscard]] CascadePass cascadePass() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::host
