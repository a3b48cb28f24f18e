// SPDX-License-Identifier: Apache-2.0
// The first step of a plan: what is seen of a frame, by each of the planner's options and by each light.
#pragma once

#include "auto/sight.h"
#include "camera_view.h"
#include "light_shares.h"
#include "motion/sun_steps.h"
#include "recipe.h"
#include "scene_memory.h"
#include "soften/light_sample.h"
#include "soften/moved_boxes.h"

#include <gnomon/plan.h>

#include <span>
#include <vector>

namespace gnomon {

/// One of a planner's options, and what the camera sees that they count for.
struct Setup {
    explicit Setup(const ShadowOptions& options) : recipe(options) {}

    Recipe recipe;
    bool looked = false; // in this frame
    CameraView camera;
    std::vector<std::uint32_t> receivers;
    bool sighted = false; // `sight` is of this frame: where the recipe predicts, or lights share what room there is
    Sight sight;
    std::vector<WorldLayer> layers; // with layers of the world: this frame's

    /// The camera sees something that receives shadow.
    [[nodiscard]] bool sees() const { return camera.outcome.kind == OutcomeKind::ok && !receivers.empty(); }
};

/// One light in a frame, and what it shines on. The rest that is known of it is in its LightPlan.
struct LightSight {
    std::uint32_t first_receiver = 0; // index of its first receiver in reach, for a light that has a reach
    std::uint32_t receiver_count = 0;
    std::uint32_t earlier_slot = 0; // which of its maps the earlier position of a stepping sun has
    LightSample sample;             // from which point of a light whose mask is a mean over frames it is seen
};

/// The frames before this one.
struct FramesBefore {
    std::uint64_t count = 0; // planned so far
    bool camera_moves = true;
};

class Sights {
public:
    /// Without any options it has the default ones.
    explicit Sights(std::span<const ShadowOptions> options);

    /// Fills in what is seen, and of the plan the lights, with what is wrong with each, and the receivers. `fault`: not
    /// ok, no light has a map. plan.cut says whether the frame is one after a cut.
    void see(const Frame& frame, const Outcome& fault, const FramesBefore& before, Plan& plan);
    /// As many frames of a mean over frames are through.
    void passFrame() { ++converging_; }
    /// Nothing is known of the frame before: planner.reset().
    void forget() { scene_.forget(); }
    /// Before each plan. Where that throws nothing has changed, and where the plan throws mend() goes back to here.
    void remember() { suns_before_ = suns_; }
    /// A plan ended half way.
    void mend();

    /// The frame, with the near distances of its lights.
    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] std::vector<Setup>& setups() { return setups_; }
    [[nodiscard]] const std::vector<Setup>& setups() const { return setups_; }
    [[nodiscard]] const std::vector<LightSight>& lights() const { return lights_; }
    /// The receivers that the camera sees and the light may reach.
    [[nodiscard]] std::span<const std::uint32_t> receiversOf(std::uint32_t light) const;
    /// All receivers of the scene, where a steady map measures level depth.
    [[nodiscard]] std::span<const std::uint32_t> allReceivers() const { return all_receivers_; }
    [[nodiscard]] const Aabb& scene_ws() const { return scene_.box_ws(); }
    /// Which frame of a mean over frames this is.
    [[nodiscard]] std::uint64_t converging() const { return converging_; }
    /// Each light's share of the picture, by what is seen with one of the options.
    const LightShares& findShares(std::uint32_t options);

private:
    void begin(const Frame& frame, Plan& plan);
    void setNearDistances(const Outcome& fault);
    void noteMovement(Plan& plan);
    void addLight(std::uint32_t index, const Outcome& fault, Plan& plan);
    [[nodiscard]] Outcome check(const Light& light, Setup& setup);
    [[nodiscard]] Outcome layer(Setup& setup);
    void look(Setup& setup);
    void listInReach(const Light& light);
    void followSun(std::uint32_t index, const FramesBefore& before, LightPlan& planned);
    [[nodiscard]] LightSample sampleOf(const Light& light, const Recipe& recipe) const;
    void listReceivers(Plan& plan);

    std::vector<Setup> setups_; // at least one
    Frame frame_;
    std::vector<Light> near_lights_; // frame_.lights
    std::vector<LightSight> lights_;
    std::vector<std::uint32_t> in_reach_; // light after light
    std::vector<std::uint32_t> all_receivers_;
    LightShares shares_;
    SceneMemory scene_;
    MovedBoxes moved_;
    SunCourses suns_;
    SunCourses suns_before_;       // as they were before this frame
    std::uint64_t converging_ = 0; // frames since the last cut
    // Scratch.
    std::vector<std::uint32_t> near_casters_;
    std::vector<std::uint32_t> merged_;
    std::vector<Plane> planes_;
};

} // namespace gnomon
