// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "frame_data.h"
#include "scene_draws.h"
#include "screen.h"
#include "seen_light.h"
#include "shadows.h"
#include "sky_table.h"

#include <chrono>
#include <utility>

namespace gnomon::host {

/// Where a frame's maps come from.
enum class Maps : std::uint8_t {
    planned,
    kept, // those of the frame before, as they are
};

struct FrameRenderer::Impl {
    Impl(SceneData& scene, const RenderOptions& options);
    /// Waits until the GPU has finished all frames; for the destructor.
    void settle() noexcept;

    /// Resources of a frame until the GPU has finished it.
    struct Slot {
        std::shared_ptr<Screen> screen;
        std::shared_ptr<Shadows> shadows;
        Buffer frame_data;
        Buffer deformed;        // vertices
        Buffer instead_staging; // masks of someone else's
        std::unique_ptr<Commands> commands;
        std::uint64_t drawn_texels = 0; // texels of maps, by its frame; 0: it was not drawn
    };
    using Clock = std::chrono::steady_clock;

    SceneData& scene;
    Gpu& gpu;
    RenderOptions options;
    Memory memory;
    SceneDraws draws;
    vulkan::Profiler profiler;
    std::vector<Slot> slots;
    Commands read_commands;
    // For frames to come. Earlier frames may have others, which their slots hold.
    std::shared_ptr<Screen> screen;
    std::shared_ptr<Shadows> shadows; // null: none are wanted

    SeenLight seen_light;
    std::vector<std::uint8_t> fading_objects; // by object: it fades into the sky
    Daylight daylight;
    std::optional<SkyTable> sky_table; // null: no sky is physical

    // This frame, until the next one.
    const FrameLight* all_light = nullptr;
    bool brings_sky = false;
    std::uint32_t slot = 0;
    const Plan* plan = nullptr;     // null: without shadows
    const Image* instead = nullptr; // masks of someone else's
    FinishedFrame finished;
    VkDescriptorSet frame_set = VK_NULL_HANDLE;
    /// Pipelines of a frame that is shaded as it is drawn.
    struct Forward {
        bool on = false;
        ForwardFacts facts;
        const KindPipelines* pipelines = nullptr;
    } forward;
    /// Pipelines of a frame with a G-buffer.
    struct {
        GBufferShape shape;
        const KindPipelines* pipelines = nullptr;
    } gbuffer;
    bool occluded = false; // shaded deferred, with ambient occlusion
    Toning toned;          // toning in the pass that shades
    VkPipeline sky = VK_NULL_HANDLE;
    VkPipeline fading = VK_NULL_HANDLE; // where a surface fades into the sky
    VkPipeline shade = VK_NULL_HANDLE;
    VkPipeline shade_compact = VK_NULL_HANDLE; // in its place where the mask is compact
    Sight sight;
    Frame frame;
    FrameTimes times;
    Clock::time_point start;
    bool deform_now = false;
    bool whole = true; // it was submitted; false: something threw before

    /// The view that depth and G-buffer show, and the number that names it.
    struct Shown {
        Camera camera;
        glm::uvec2 size_px{0};
        std::uint64_t version = 0; // the version of `objects`

        bool operator==(const Shown&) const = default;
    } shown_last;
    ContentNumber content = 0;

    ObjectSet objects;
    std::vector<Light> frame_lights;
    std::vector<int> cookie_layers;
    std::vector<std::uint32_t> visible; // nearest first
    std::vector<std::pair<float, std::uint32_t>> by_distance;
    std::uint64_t next_index = 0;
    std::uint64_t next_sample = 0;       // with RenderOptions::average_pixels
    std::optional<double> deformed_at_s; // as `objects` has been told
    double occlusion_radius_m = 0.0;
    Plan no_plan;

    [[nodiscard]] std::shared_ptr<Screen> makeScreen(const RenderOptions& wish) const;
    [[nodiscard]] Slot& now() { return slots[slot]; }
    void drawFrame(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights, Present* present,
                   const std::vector<ImageF>* masks_instead, Maps maps);
    void prepareFrame(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                      const std::vector<ImageF>* masks_instead, Maps maps);
    void forgetBroken();
    void beginSlot();
    void learnRate();
    void finish();
    void update(const scene::State& state);
    void look(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights, Maps maps);
    void nameContent();
    void sortNearestFirst();
    void makePlan(Maps maps, bool masked_instead);
    void lookAtSky(const scene::State& state, const std::vector<ShadedLight>& lights);
    void writeFrameData(const std::vector<ShadedLight>& lights);
    void writeInstead(const std::vector<ImageF>& masks);
    void describeFrame();
    /// Is this frame's mask compact?
    [[nodiscard]] bool hasTiles() const;
    /// The shadows for surfaces that are shaded as they are drawn; null: there are no such surfaces, or no maps.
    [[nodiscard]] ForwardShadows* forwardShadows();
    void choosePipelines();
    void chooseForward(const ShadedBy& by);
    [[nodiscard]] const Image& shadedTo() const;
    void endShading(VkCommandBuffer cmd);
    void record(Present* present);
    void recordDeferred(VkCommandBuffer cmd);
    void recordForward(VkCommandBuffer cmd);
    void recordDepth(VkCommandBuffer cmd);
    void recordSurfaces(VkCommandBuffer cmd);
    void recordGBuffer(VkCommandBuffer cmd);
    [[nodiscard]] vulkan::MaskInputs depthInputs() const;
    void recordMaps(VkCommandBuffer cmd, const vulkan::MaskInputs& inputs);
    void recordShadows(VkCommandBuffer cmd);
    void recordInstead(VkCommandBuffer cmd);
    void recordOcclusion(VkCommandBuffer cmd);
    void recordLight(VkCommandBuffer cmd);
    std::uint32_t recordBlended(VkCommandBuffer cmd);
    void recordBloom(VkCommandBuffer cmd);
    void recordPicture(VkCommandBuffer cmd);
    void screenPass(VkCommandBuffer cmd, const char* name, VkPipeline pipeline, const Image& target);
};

} // namespace gnomon::host
