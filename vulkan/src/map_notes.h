// SPDX-License-Identifier: Apache-2.0
// What the texels of each map hold, by the content numbers of the plans that were recorded, and what there is to draw
// so that they hold what a plan wants. The one place that knows: the passes do as they are told.
#pragma once

#include <gnomon/plan.h>

#include <span>
#include <vector>

namespace gnomon::vulkan {

/// What there is to do for one view.
struct ViewWork {
    bool draw = false;      // the map, or a part of it
    bool whole = false;     // all of the tile; else what ViewContents::dirty says
    bool draw_kept = false; // what stands still, into the kept layer, first
};

class MapNotes {
public:
    /// What is to be drawn for each view of the plan; good until the next call. A view without a MapId is drawn as it
    /// says by itself: whoever made the plan by hand answers for it.
    [[nodiscard]] std::span<const ViewWork> workFor(const Plan& plan);
    /// The last work has been recorded: maps hold what their views make. Allocates nothing.
    void done(const Plan& plan);
    /// Grows whenever what any map holds may be another than before.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    void change() { ++changes_; }
    /// Room for such a plan, so that neither of the above allocates.
    void reserve(const Plan& plan);
    /// The texels of all maps of one of the plan's options are gone, and of the kept ones, too.
    void lose(std::uint32_t options);

private:
    // Where a map lies, and what it holds. 0: nothing that is known.
    struct Held {
        ContentNumber content = 0;
        std::uint32_t options = 0; // of Plan::options: whose images
        Tile tile;
        TexelPart part = TexelPart::whole;
        bool kept = false; // in the images of what stands still
    };

    [[nodiscard]] static Held mapOf(const Plan& plan, const View& view);
    [[nodiscard]] static Held keptOf(const Plan& plan, const View& view);
    [[nodiscard]] bool holds(MapId id, const Held& wanted) const;
    void forgetUnder(const Held& held);
    void note(MapId id, const Held& held);

    std::vector<Held> held_; // by MapId::index
    std::vector<ViewWork> work_;
    std::uint64_t changes_ = 0;
};

} // namespace gnomon::vulkan
