// SPDX-License-Identifier: Apache-2.0
// Records how maps of one of a plan's options are drawn: DepthMaps only draws them; MomentMaps draws depths and makes
// filterable maps of them.
#pragma once

#include "commands/recording.h"

#include <gnomon/pack/filter_passes.h>
#include <gnomon/pack/map_notes.h>

#include <memory>
#include <span>

namespace gnomon::pack {

/// One drawing of a plan's maps.
struct MapJob {
    const Plan& plan;
    std::uint32_t options = 0;      // index into Plan::options: views of others are left alone
    std::span<const ViewWork> work; // by view

    /// The work for a view: none for one of other options.
    [[nodiscard]] ViewWork of(std::uint32_t view) const;
};

class MapCommands {
public:
    MapCommands() = default;
    virtual ~MapCommands() = default;
    MapCommands(const MapCommands&) = delete;
    MapCommands& operator=(const MapCommands&) = delete;

    struct Prepared {
        bool changed = false; // the maps are another image
        bool lost = false;    // and what they held could not be taken over
    };
    virtual Prepared prepare(const Plan& plan) = 0;
    virtual void draw(const MapJob& job) = 0;
    /// Did prepare() make room for this view of its options?
    [[nodiscard]] virtual bool covers(const Plan& plan, const View& view) const = 0;
};
/// For maps of these options, which are the plan's at this index.
[[nodiscard]] std::unique_ptr<MapCommands> makeMapCommands(Recording& recording, const RecorderTraits& traits,
                                                           const ResolvedOptions& options, std::uint32_t index);
/// Those of filterable options.
[[nodiscard]] std::unique_ptr<MapCommands> makeMomentMaps(Recording& recording, const RecorderTraits& traits,
                                                          const ResolvedOptions& options, std::uint32_t index);

/// The format of the depths that such maps are drawn with.
[[nodiscard]] MapFormat depthFormatOf(MapFormat format);

} // namespace gnomon::pack
