// SPDX-License-Identifier: Apache-2.0
// Notes the contents of each map's texels, by the content numbers of drawn plans, and finds the drawing that brings
// them to a plan's contents. A backend keeps one, and draws what it says.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <span>
#include <vector>

namespace gnomon::pack {

/// The work for one view.
struct ViewWork {
    bool draw = false;      // the map, or a part of it
    bool whole = false;     // all of the tile; else ViewContents::dirty
    bool draw_kept = false; // the still casters, into the kept layer, first
};

/// Which casters of a view.
enum class CasterShare : std::uint8_t { all, still, moving };
/// This share of a view's casters. Precondition: they lie in the plan's list (checkPlan()).
[[nodiscard]] GNOMON_API std::span<const std::uint32_t> castersOf(const Plan& plan, const View& view,
                                                                  CasterShare share);
/// The part of the map's tile that is drawn again: all of it, or ViewContents::dirty.
[[nodiscard]] GNOMON_API Tile redrawnPart(const View& view, bool all);

/// Throws Error where numbers of a plan point beyond its own lists or pages, or it has no options. `tried`: the Error's
/// first part.
GNOMON_API void checkPlan(const char* tried, const Plan& plan);

/// Notes what maps hold. Not thread-safe. Plans of one planner only: another one may give out the same names.
class GNOMON_API MapNotes {
public:
    /// The work for each view of the plan; valid until the next call. A view without a MapId is drawn by its own
    /// `redraw` and `dirty`: the plan was made by hand, and its maker is responsible.
    [[nodiscard]] std::span<const ViewWork> workFor(const Plan& plan);
    /// The last work has been recorded: maps hold what their views make. Allocates nothing.
    void done(const Plan& plan);
    /// Grows whenever the contents of any map may have changed.
    [[nodiscard]] std::uint64_t changes() const { return changes_; }
    /// Makes changes() grow.
    void change() { ++changes_; }
    /// Room for such a plan, so that neither of the above allocates.
    void reserve(const Plan& plan);
    /// The texels of all maps of one of the plan's options are gone, and of the kept ones, too.
    void lose(std::uint32_t options);

private:
    // Where a map lies, and what it holds. 0: nothing that is known.
    struct Held {
        ContentNumber content = 0;
        std::uint32_t options = 0; // index into Plan::options, whose images it lies in
        Tile tile;
        TexelPart part = TexelPart::whole;
        bool kept = false; // in the images of what stands still
    };

    [[nodiscard]] GNOMON_LOCAL static Held mapOf(const Plan& plan, const View& view);
    [[nodiscard]] GNOMON_LOCAL static Held keptOf(const Plan& plan, const View& view);
    [[nodiscard]] GNOMON_LOCAL bool holds(MapId id, const Held& wanted) const;
    GNOMON_LOCAL void forgetUnder(const Held& held);
    GNOMON_LOCAL void note(MapId id, const Held& held);

    std::vector<Held> held_; // by MapId::index
    std::vector<ViewWork> work_;
    std::uint64_t changes_ = 0;
};

} // namespace gnomon::pack
