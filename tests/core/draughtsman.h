// SPDX-License-Identifier: Apache-2.0
// Draws as a plan says, into pages whose texels are sums of marks of what was drawn there.
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
    /// A strict one expects of every plan that it presumes what is there. One that isn't may have skipped plans: it
    /// draws whole what it does not have, as ViewContents::presumes has it.
    explicit Draughtsman(bool strict = true) : strict_(strict) {}

    void follow(const Plan& plan, const ObjectSet& set);
    /// Every map that is read holds what drawing it from scratch gives.
    void check(const Plan& plan, const ObjectSet& set) const;
    /// The texels are gone.
    void lose(const View& view, bool kept);

    std::uint64_t still_drawn = 0; // casters
    std::uint64_t moving_drawn = 0;
    std::uint64_t dirty_texels = 0;
    std::uint64_t mended = 0; // maps

private:
    using Image = std::vector<std::uint64_t>;
    /// Of one options' pages: those of kept copies apart, and the parts of their texels.
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

/// Places are no two views', names neither, and casters are in order.
void expectOrder(const Plan& plan, const ObjectSet& set);

} // namespace gnomon::test
