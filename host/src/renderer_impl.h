// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bloom.h"
#include "frame_data.h"
#include "scene_draws.h"
#include "targets.h"

#include <memory>
#include <optional>
#include <utility>

namespace gnomon::host {

/// Where a frame's maps come from.
enum class Maps : std::uint8_t {
    planned,
    kept, // those of the frame before, as they are
};

struct Renderer::Impl {
    Impl(Gpu& gpu, const scene::Scene& scene, const scene::State& state, const RenderOptions& options);
    ~Impl();

    Gpu& gpu;
    const scene::Scene& scene;
    const RenderOptions options;
    Memory memory;
    std::unique_ptr<Uploader> uploader; // while the scene is uploaded
    Textures textures;
    Materials materials;
    Geometry geometry;
    Pipelines pipelines;
    Targets targets;
    std::optional<Bloom> bloom;
    SceneDraws draws;
    Commands commands;
    Buffer frame_buffer;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet frame_set = VK_NULL_HANDLE;
    vulkan::Profiler profiler;

    // The library.
    ObjectSet objects;
    Planner planner;
    Plan no_plan; // without shadows
    Plan fitted;  // with what the GPU found for a frame, when somebody has asked
    std::optional<std::uint64_t> fitted_frame;
    std::optional<vulkan::ShadowRenderer> shadows;
    std::optional<vulkan::CasterDrawer> casters;

    // This frame.
    const Plan* plan = nullptr;
    Plan kept_plan; // of drawAgain(): the last plan, nothing of which is to be drawn
    Sight sight;
    Frame frame;
    std::vector<Light> frame_lights;
    std::vector<int> cookie_layers;
    std::vector<std::uint32_t> visible; // nearest first
    std::vector<std::pair<float, std::uint32_t>> by_distance;
    std::uint64_t next_index = 0;
    std::optional<double> deformed_at_s;
    bool deform_now = false;
    std::size_t light_count = 0;
    VkImageView mask_view = VK_NULL_HANDLE; // as bound
    bool mask_instead = false;              // the last frame's mask is `instead`

    // Masks of someone else's.
    Image instead;
    Buffer instead_staging;

    Buffer read_back;

    FrameTimes drawFrame(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights,
                         const std::vector<ImageF>* masks_instead, Maps maps);
    void makeFrameSet();
    void bindMask(VkImageView view);
    void update(const scene::State& state);
    void look(const scene::State& state, const Eye& eye, const std::vector<ShadedLight>& lights);
    void sortNearestFirst();
    void makePlan();
    void keepPlan();
    void writeFrameData(const scene::State& state, const std::vector<ShadedLight>& lights, bool has_mask);
    void writeInstead(const std::vector<ImageF>& masks);
    void record(bool has_mask);
    void recordGBuffer(VkCommandBuffer cmd);
    void recordShadows(VkCommandBuffer cmd);
    void recordInstead(VkCommandBuffer cmd) const;
    void recordLight(VkCommandBuffer cmd);
    void recordBloom(VkCommandBuffer cmd);
    void recordPicture(VkCommandBuffer cmd);
    void setViewport(VkCommandBuffer cmd, VkExtent2D extent) const;
    void readColour(Picture& picture);
    void readLinear(Picture& picture);
    void readGlow(Picture& picture);
    void readMasks(Picture& picture);
    void readGeometry(Picture& picture);
    void screenPass(VkCommandBuffer cmd, const char* name, VkPipeline pipeline, const Image& target);
};

} // namespace gnomon::host
