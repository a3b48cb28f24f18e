// SPDX-License-Identifier: Apache-2.0
// The scene of boxes with its renderer, on the real device.
#pragma once

#include "scene.h"

#include <vector>

namespace gnomon::test {

/// Fails the test for every validation message since the last call.
void expectSilence(Gpu& gpu);

/// Stored depths of one layer, as numbers.
[[nodiscard]] std::vector<float> readMapLayer(Gpu& gpu, const vulkan::ImageRef& maps, std::uint32_t layer);
/// One light's channel, one byte a pixel.
[[nodiscard]] std::vector<std::byte> readMaskChannel(Gpu& gpu, const vulkan::ImageRef& mask, const LightPlan& light);
/// Depth and normals of the picture as images.
[[nodiscard]] vulkan::MaskInputs uploadPicture(Gpu& gpu, const Picture& picture);

class Bench {
public:
    Bench(VkExtent2D screen, MapFormat format, bool reversed_z = true, bool cull = false);
    /// `clockwise`: CasterDrawerOptions::clockwise_front.
    Bench(VkExtent2D screen, const ShadowOptions& options, bool reversed_z = true, bool cull = false,
          const vulkan::MemoryHooks& memory = {}, bool clockwise = false);

    /// After changes to `scene`: makes plan, picture and mesh.
    void setLights(std::vector<Light> lights, const std::vector<Tile>& tiles, MapPages atlas);
    /// Gives the boxes a texture whose left half is clear.
    void maskBoxes();
    /// Turns the ground's triangles over.
    void flipGround();
    void prepare();
    /// Moves the camera for all later frames.
    void look(const glm::dvec3& eye, const glm::dvec3& target);
    /// Records and runs this many frames, all in slot 0 and one command buffer each.
    void record(int frames, vulkan::Profiler* profiler = nullptr);
    [[nodiscard]] std::vector<float> readMap(std::uint32_t layer);
    [[nodiscard]] std::vector<std::byte> readMask(std::uint32_t light);

    ShadowOptions options{.technique = kPlainTechnique};
    Scene scene = makeScene();
    SceneMesh mesh;
    std::vector<Light> lights;
    Plan plan;
    Camera camera;
    Picture picture;
    vulkan::MaskInputs inputs;
    vulkan::ShadowRenderer renderer;
    vulkan::CasterDrawer drawer;

private:
    VkExtent2D screen_;
};

} // namespace gnomon::test
