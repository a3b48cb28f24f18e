// SPDX-License-Identifier: Apache-2.0
// Draws as a plan says, into pages whose texels are sums of the marks of casters drawn there.
#pragma once

#include <gnomon/object_set.h>
#include <gnomon/plan.h>

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <vector>

namespace gnomon::test {

class Draughtsman {
public:
    /// A strict one expects every plan to presume the contents that it has. Else it may have skipped plans, and draws
    /// contents that it lacks in full, as ViewContents::presumes has it.
    explicit Draughtsman(bool strict = true) : strict_(strict) {}

    void follow(const Plan& plan, const ObjectSet& set);
    /// Every map that is read holds the result of drawing it from scratch.
    void check(const Plan& plan, const ObjectSet& set) const;
    /// The texels are gone.
    void lose(const View& view, bool kept);

    std::uint64_t still_drawn = 0; // casters
    std::uint64_t moving_drawn = 0;
    std::uint64_t dirty_texels = 0;
    std::uint64_t mended = 0; // maps

private:
    using Image = std::vector<std::uint64_t>;
    /// A page of one options, kept copies apart, and a part of its texels.
    using Place = std::tuple<std::uint32_t, bool, TexelPart, std::uint32_t>;
    struct Page {
        std::uint32_t side = 0;
        Image texels;
    };
    /// A view's tile on its page.
    struct Canvas {
        Page& page;
        const View& view;
        std::uint64_t& at(std::uint32_t x, std::uint32_t y) const
        {
            return page.texels[std::size_t{view.place.tile.y + y} * page.side + view.place.tile.x + x];
        }
        void clear() const;
        void draw(std::span<const std::uint32_t> casters, const ObjectSet& set, const TexelRect& scissor) const;
    };
    Canvas canvas(const Plan& plan, const View& view, bool kept);
    void followView(const Plan& plan, const View& view, const ObjectSet& set);
    void restore(const Plan& plan, const View& view, const ObjectSet& set, bool map_holds);
    [[nodiscard]] bool holds(const MapId& map, ContentNumber presumed) const;
    void note(const MapId& map, ContentNumber made);

    bool strict_;
    std::map<Place, Page> pages_;
    std::map<std::uint32_t, ContentNumber> held_; // by MapId::index
    std::map<std::uint32_t, std::uint32_t> generations_;
    std::set<ContentNumber> given_;
};

/// No two views have the same place or name, and casters are in order.
void expectOrder(const Plan& plan, const ObjectSet& set);

} // namespace gnomon::test
