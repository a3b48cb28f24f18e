// SPDX-License-Identifier: Apache-2.0
// A host on the null driver whose lights, screen, inputs and options change from frame to frame.
#pragma once

#include "null_driver.h"
#include "scene.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/classics.h>

#include <array>
#include <memory>
#include <ostream>
#include <vector>

namespace gnomon::test {

/// The setup of a frame.
struct FrameSetup {
    std::uint32_t lights = 1; // each third a spot, the others suns; they take the planner's options in turn
    std::uint32_t cast = ~0U; // how many of them cast; later ones cast no shadow
    std::uint32_t options = 1;
    VkExtent2D screen{64, 40};
    vulkan::MaskShape inputs;
};

/// The objects and memory that one recording made, which should have been there before.
struct Made {
    std::uint64_t pipelines = 0;
    std::uint64_t memory = 0; // allocations of the device's
    std::uint64_t heap = 0;   // allocations

    friend bool operator==(const Made&, const Made&) = default;
};
std::ostream& operator<<(std::ostream& out, const Made& made);

/// It has two frames in flight and waits only for a slot's last frame.
class ChangingHost {
public:
    /// It draws fins whatever the options.
    explicit ChangingHost(const vulkan::ShadowRendererOptions& options);
    /// With a driver that outlives it.
    ChangingHost(NullDriver& shared, const vulkan::ShadowRendererOptions& options);
    ChangingHost(const ChangingHost&) = delete;
    ChangingHost& operator=(const ChangingHost&) = delete;

    /// Plans, prepares and records a frame. Something has moved since the last one.
    [[nodiscard]] Made frame(Planner& planner, const FrameSetup& setup);
    /// The step at which frame() threw.
    enum class At : std::uint8_t { nothing, plan, prepare, drawer, record };
    At at = At::nothing;
    /// Plans a frame, prepares it as far as `until`, and does not draw it.
    void skipFrame(const FrameSetup& setup, Planner& planner, At until);
    /// The index of the frame that frame() is at, or that is next.
    [[nodiscard]] std::uint32_t frameIndex() const { return frames_; }
    /// Fails the test if anything was freed or changed that a frame in flight may use.
    void expectNoMistakes(const std::string& what) const;

private:
    std::unique_ptr<NullDriver> own_;

public:
    NullDriver& driver;
    vulkan::ShadowRenderer renderer;
    vulkan::CasterDrawer drawer;
    vulkan::FinDrawer fins;
    std::size_t views_seen = 0;     // in all frames
    std::uint64_t prepared_now = 0; // pipelines that the last frame made before it was recorded
    /// The type of light 0, for tests that want a spot.
    LightType first_light = LightType::directional;
    /// The place of the camera, which looks at the middle of the scene and comes a little nearer in each frame.
    glm::dvec3 eye_ws{9.0, 6.0, 11.0};
    Partition chosen = Partition::automatic; // for light 0 in the last frame, by a planner that chooses

private:
    struct Views {
        VkImageView depth = VK_NULL_HANDLE;
        VkImageView normal = VK_NULL_HANDLE;
        VkImageView id = VK_NULL_HANDLE;
    };

    void begin();
    void addObjects();
    void makeScene();
    void move(const FrameSetup& setup);
    [[nodiscard]] Frame nextFrame(const FrameSetup& setup);
    [[nodiscard]] vulkan::MaskInputs inputsOf(std::uint32_t slot, const FrameSetup& setup);
    [[nodiscard]] Made record(std::uint32_t slot, const Plan& plan, const vulkan::MaskInputs& inputs);

    Scene scene_ = test::makeScene();
    ObjectSet objects_;
    vulkan::CasterGeometry geometry_;
    vulkan::VolumeGeometry fin_geometry_;
    std::vector<vulkan::Rows3x4> transforms_;
    std::array<Views, 2> views_; // by slot
    std::vector<Light> lights_;
    vulkan::DrawCasters draw_;
    std::uint32_t frames_ = 0;
};

} // namespace gnomon::test
