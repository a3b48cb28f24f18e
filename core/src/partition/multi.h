// SPDX-License-Identifier: Apache-2.0
// Partition `multi`: a light has as many frustums as what is seen of its receivers asks for, each with a map as large
// as they need it.
#pragma once

#include "auto/sight.h"
#include "frustum_planner.h"
#include "partition/depth_shells.h"
#include "partition/held_frustums.h"
#include "partition/multi_receivers.h"
#include "store/light_rows.h"
#include "store/texel_shares.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon {

/// One frustum of a light in one frame.
struct GrownFrustum {
    std::uint32_t id = 0; // within its light: the same from frame to frame as long as it serves the same part
    FrustumPart part;
    Slice slice;
    double size = 0.0;             // Prediction::size
    double texel = 0.0;            // for gathered receivers: its map's texel, in units of LightRect
    double wanted = 0.0;           // texels on a side of its map
    double sum = 0.0;              // FacingTexels::sum_px, for a map of the largest side
    std::uint32_t side_before = 0; // side in the last frame; 0: it was not there
    std::uint32_t side = 0;        // side that it gets
    double strength = 0.0;         // strength of its warp, with fit auto
    bool fades_out = false;
    std::uint32_t first_receiver = 0; // see MultiPartition::receiversOf()
    std::uint32_t receiver_count = 0;
};

/// Remembers a light by its key for as long as it is in the frames.
class MultiPartition {
public:
    struct Input {
        const Frame& frame;
        const Recipe& recipe;
        const CameraView& camera;                 // measured
        std::span<const std::uint32_t> receivers; // that the camera sees
        const Sight& sight;
        const Light& light;
    };

    /// The lights of a frame. Those that are gone are forgotten, and nobody has frustums yet.
    void follow(std::span<const Light> lights);
    /// Finds a light's frustums.
    void divide(const Input& input, std::size_t light, FrustumPlanner& frustums);
    // For a light that takes turns (ShadowOptions::draw_budget_texels), after divide():

    /// Its frustums, or the sides of their maps, are not those of the last time.
    [[nodiscard]] bool differs(std::size_t light) const;
    /// Undoes this frame's division: restores its memory, and with the input its frustums too.
    void restoreMemory(std::size_t light);
    void restoreFrustums(const Input& input, std::size_t light);
    /// In the order in which they fade over into each other: near ones first, what fades out before what comes in its
    /// place, then by direction. Those of gathered receivers: finest first. Holds until the next divide().
    [[nodiscard]] std::span<const GrownFrustum> frustumsOf(std::size_t light) const;
    /// The given receivers that a frustum may serve.
    [[nodiscard]] std::span<const std::uint32_t> receiversOf(const GrownFrustum& frustum) const
    {
        return std::span(receivers_).subspan(frustum.first_receiver, frustum.receiver_count);
    }

private:
    struct Known {
        std::uint32_t id = 0;
        std::uint32_t side = 0;
        double strength = 0.0;
    };
    struct Memory {
        std::vector<Known> frustums;
        std::vector<int> ends;                   // DepthShells::find()
        std::uint32_t patience = 0;              // frames for which `ends` are kept although others were better
        bool divides = false;                    // into shells
        LightType type = LightType::directional; // nothing is remembered of a light that was another
        HeldFrustums held;                       // with motion snap
        std::vector<ReceiverCone> cones;         // and gathered receivers
        std::vector<ReceiverHome> homes;
        std::uint32_t next_cone = 1;    // ReceiverCone::id of the next one that is held
        std::vector<GrownFrustum> last; // for a light that takes turns: the result of divide()
    };
    [[nodiscard]] static std::uint32_t largestSide(const Input& input);
    [[nodiscard]] static bool takesTurns(const Input& input) { return input.recipe.takesTurns(); }
    [[nodiscard]] static double texelsPerPixel(const Input& input);
    /// The rest of a light's texels goes to its frustums, too, once they have what they want.
    [[nodiscard]] static bool sharesRest(const Input& input);
    struct Range {
        std::size_t first = 0;
        std::size_t count = 0;
    };

    void findFrustums(const Input& input, Memory& memory, std::size_t first, FrustumPlanner& frustums);
    void addShell(const Input& input, std::size_t shell);
    void findWays(const Input& input);
    std::optional<Slice> aim(const Input& input);
    void addFrustum(const Input& input, const Slice& slice, const FrustumPart& part);
    void listReceivers(const Input& input, GrownFrustum& frustum);
    void sizeFrustums(const Input& input, Memory& memory, std::span<GrownFrustum> found);
    double addShells(const Input& input, const Memory& memory, FrustumPlanner& frustums);
    double predict(const Input& input, const Memory& memory, std::size_t first, FrustumPlanner& frustums);
    void hold(const Input& input, HeldFrustums& held, std::size_t first);
    void addFading(const Input& input, const HeldFrustums& held);

    // MultiDivide::receivers: multi_gather.cpp.
    void gather(const Input& input, Memory& memory, FrustumPlanner& frustums);
    [[nodiscard]] ReceiverCone& coneOf(std::uint32_t id);
    void addCone(const Input& input, const ReceiverCone& cone);
    void orderCones(const Input& input, Memory& memory, std::size_t first);
    void holdCones(const Input& input, Memory& memory, std::span<GrownFrustum> found);
    void addFadingCones(const Input& input, Memory& memory);

    LightRows rows_;
    std::vector<Memory> memories_; // by row
    std::vector<Memory> before_;   // as they were before this frame, of lights that take turns
    std::vector<std::uint64_t> keys_;
    std::vector<Range> ranges_; // ranges of frustums_, by light
    std::vector<GrownFrustum> frustums_;
    std::vector<std::uint32_t> receivers_;
    // Scratch.
    std::vector<Slice> ways_; // the light that is being divided
    bool aimed_ = false;      // it follows what is seen
    TexelShares shares_;
    std::vector<TexelClaim> claims_;
    DepthShells shells_;
    std::vector<HeldFrustum> found_;
    ReceiverCones cones_;
    std::span<ReceiverCone> gathered_; // the light that is being divided
    ConvexBody body_;
};

} // namespace gnomon
