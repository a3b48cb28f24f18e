// SPDX-License-Identifier: Apache-2.0
// One of a planner's options, resolved: the functions of its choices, and their meaning for a light.
#pragma once

#include "fit/fit.h"
#include "motion/motion.h"
#include "partition/partition.h"
#include "store/map_store.h"

#include <gnomon/planner.h>

namespace gnomon {

struct Recipe {
    ShadowOptions asked;
    std::string_view refused; // why check() refuses every light; empty: these options can be had
    ResolvedOptions resolved; // the default ones where the given ones are refused
    const PartitionTraits* partition = nullptr;
    FitFunction fit = nullptr; // null for fit auto
    const MotionTraits* motion = nullptr;

    explicit Recipe(const ShadowOptions& given) : Recipe(given, resolve(given)) {}

    /// The options of `resolved`.
    [[nodiscard]] const ShadowOptions& options() const { return resolved.asked(); }

    /// ok, or why this light has no map whatever it shines on.
    [[nodiscard]] Outcome check(const Light& light) const;

    // For lights that check() accepts:

    /// The light is a sun that moves in steps.
    [[nodiscard]] bool steps(const Light& light) const;
    /// It is one with maps of two positions.
    [[nodiscard]] bool pairs(const Light& light) const;
    /// It depends on the options, the light's own numbers and what was chosen for it alone, so that maps last.
    /// `divided`: the recipe's own partition, or with partition auto the one that was chosen. `halvings`: of a
    /// side that is the planner's choice, as AutoDecision has it.
    [[nodiscard]] MapWish wishOf(const Light& light, std::uint32_t index, const PartitionTraits& divided,
                                 std::uint32_t halvings) const;
    /// How many maps a light has so.
    [[nodiscard]] std::uint32_t mapsOf(const PartitionTraits& divided) const;

    /// Depth is measured from a plane that leans with what receives shadow.
    [[nodiscard]] bool levelsDepth() const;
    /// A map needs the receiver itself: its depth, or its id.
    [[nodiscard]] bool drawsReceivers() const { return resolved.traits().filterable || resolved.traits().ids; }
    /// Filter volumes has none: its lights want none, and have casters instead (plan/views_of_volumes.cpp).
    [[nodiscard]] bool hasMaps() const { return resolved.hasMaps(); }
    /// A frame's drawing is bounded.
    [[nodiscard]] bool takesTurns() const { return boundsDrawing(options()); }
    /// A light's cascades take turns each by itself.
    [[nodiscard]] bool turnsByCascade() const { return gnomon::turnsByCascade(options()); }
    /// Its mask is a mean over frames.
    [[nodiscard]] bool converges() const { return options().technique.soften == Soften::converge; }
    [[nodiscard]] bool steady() const { return (motion != nullptr && motion->steady) || holdsScene(); }
    /// One map around all of the scene, made once.
    [[nodiscard]] bool holdsScene() const { return options().technique.fit == Fit::scene; }
    [[nodiscard]] bool layersWorld() const { return hasWorldLayers(resolved.filter(), options().moments); }
    /// The planner finds out how strong a warp is (fit auto).
    [[nodiscard]] bool searchesWarp() const { return options().technique.fit == Fit::automatic && !steady(); }
    /// Its fit warps maps by a rule, which is held against no warp.
    [[nodiscard]] bool warps() const
    {
        return fit != nullptr && fit != fitUniform && fit != fitScene && !steady() && !grows() && !hasPages();
    }
    /// It also finds out how a light is divided (partition auto).
    [[nodiscard]] bool choosesPartition() const { return options().technique.partition == Partition::automatic; }
    /// One map around what the camera's depth shows, found on the GPU: what best quality spends on it. Not of a light
    /// that shines all around, whose faces no one rectangle holds.
    [[nodiscard]] bool takesDepth(LightType type) const
    {
        return choosesPartition() && resolved.fitsOnGpu() && type != LightType::point;
    }
    /// Each light's frustums depend on what is seen (MultiPartition).
    [[nodiscard]] bool grows() const { return partition != nullptr && partition->grows; }
    /// Each light has pages (VirtualPartition).
    [[nodiscard]] bool hasPages() const { return partition != nullptr && partition->pages; }
    /// It also finds out how many texels are of use (map-size auto).
    [[nodiscard]] bool sizesMap() const { return !options().map_size && !steady(); }
    /// AutoChooser decides for it.
    [[nodiscard]] bool predicts() const
    {
        return hasMaps() && !grows() && !hasPages() && (searchesWarp() || choosesPartition() || sizesMap());
    }

private:
    Recipe(const ShadowOptions& given, const Resolution& resolution);
};

} // namespace gnomon
