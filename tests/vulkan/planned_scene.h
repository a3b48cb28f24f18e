// SPDX-License-Identifier: Apache-2.0
// The scene of boxes as a planner sees it, and the mask of a frame of it by whichever renderer, on a real device.
#pragma once

#include "scene.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/classics.h>

#include <vector>

namespace gnomon::test {

/// A renderer and drawers on a device.
struct Drawing {
    Drawing(Gpu& gpu, const SceneMesh& mesh, const pack::CompactMaskRule& compact_in = {},
            std::uint32_t frames_in_flight = 2);
    Drawing(const vulkan::DeviceView& view, const SceneMesh& mesh, const pack::CompactMaskRule& compact_in = {},
            std::uint32_t frames_in_flight = 2);

    Drawing(const Drawing&) = delete; // a callback points to it
    Drawing& operator=(const Drawing&) = delete;

    pack::CompactMaskRule compact;
    vulkan::ShadowRenderer renderer;
    vulkan::CasterDrawer drawer;
    vulkan::FinDrawer fins;
};

/// That many lights over the scene of boxes, suns and spots in turn; their keys are their indices.
[[nodiscard]] std::vector<Light> sunsAndSpots(std::uint32_t count);

class PlannedScene {
public:
    PlannedScene(Gpu& gpu, VkExtent2D screen);

    /// The camera moves; destroys the views of what it saw and makes them anew, of this size.
    void remakeViews(VkExtent2D screen, bool normals, bool ids);
    [[nodiscard]] Frame frameOf(std::span<const Light> lights) const;
    /// MaskInputs::content, until the views are made anew.
    void nameContent(ContentNumber content) { inputs_.content = content; }
    /// A box moves, for maps alone: the picture stays.
    void moveCaster();
    /// Draws maps and mask, and waits for them.
    void run(Drawing& drawing, const Plan& plan, std::uint32_t slot = 0, vulkan::Profiler* profiler = nullptr);
    /// run(), and all layers of the mask, one after the other.
    [[nodiscard]] std::vector<std::byte> draw(Drawing& drawing, const Plan& plan, std::uint32_t slot = 0,
                                              vulkan::Profiler* profiler = nullptr);
    [[nodiscard]] const SceneMesh& mesh() const { return mesh_; }

private:
    Gpu& gpu_;
    Scene scene_ = makeScene();
    SceneMesh mesh_;
    ObjectSet objects_;
    glm::dvec3 eye_{9.0, 6.0, 11.0};
    Camera camera_;
    struct Images {
        TestImage depth;
        TestImage normal;
        TestImage id;
    };
    Images images_;
    vulkan::MaskInputs inputs_;
};

} // namespace gnomon::test
