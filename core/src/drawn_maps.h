// SPDX-License-Identifier: Apache-2.0
// What the maps hold that earlier plans had drawn, and so what of a view has to be drawn again.
#pragma once

#include <gnomon/object_set.h>
#include <gnomon/plan.h>

#include <span>
#include <vector>

namespace gnomon {

/// Records of what is in each tile (and part of its texels), and in each kept layer. They last as long as the images,
/// also over frames in which a map is not read.
class DrawnMaps {
public:
    void forget();
    /// Before the views of a plan. Forgets what other images or another set's objects filled.
    void begin(const Plan& plan, const ObjectSet& objects);
    /// Sets View::redraw and what goes with it, and takes it for granted that the view is drawn accordingly. With a
    /// kept layer in `kept_layer` what moves is kept apart, if anything is: then the view's casters are reordered, the
    /// still ones first. kNoIndex: the map is drawn all at once.
    void decide(View& view, std::uint32_t kept_layer, std::span<std::uint32_t> casters, const ObjectSet& objects);

private:
    struct Mover {
        std::uint32_t object = 0;
        TexelRect texels; // where it may be in the tile
    };
    struct Record {
        bool filled = false;
        // Where: a tile and part, or for a kept layer nothing but its place in the list.
        Tile tile;
        TexelPart part = TexelPart::whole;
        // What of a view its content depends on.
        glm::dmat4 clip_from_world{1.0};
        glm::dvec4 metric_ws{0.0};
        bool orthographic = true;
        bool clamp_near = true;
        ContentNumber content = 0;
        std::uint64_t version = 0;        // of the set when it was drawn
        std::vector<std::uint32_t> still; // casters; in a map that is drawn all at once, all of them
        std::vector<Mover> moving;        // those of a map with a kept layer; ascending, as `still`

        [[nodiscard]] bool shows(const View& view, std::span<const std::uint32_t> casters,
                                 std::span<const std::uint64_t> changes) const;
        [[nodiscard]] bool showsMovers() const;
        void fill(const View& view, std::span<const std::uint32_t> casters, std::uint64_t drawn_version);
    };
    Record& recordOf(const View& view);
    void split(std::span<const std::uint32_t> casters, const ObjectSet& objects);
    TexelRect placeMovers(const View& view, const Record* drawn, const ObjectSet& objects);
    void decideAtOnce(View& view, Record& map, std::span<const std::uint32_t> casters, const ObjectSet& objects) const;

    std::vector<Record> maps_;
    std::vector<Record> kept_;
    MapPages atlas_;
    std::uint32_t kept_layers_ = 0;
    std::uint64_t identity_ = 0;
    // Scratch: the casters of a view.
    std::vector<std::uint32_t> still_;
    std::vector<Mover> moving_;
};

/// Where a box may be in a view's tile: around its image, a texel more on each side, cut by the tile. All of the tile
/// where the box is partly behind a light with a place.
[[nodiscard]] TexelRect texelsOf(const View& view, const Aabb& box_ws);
/// Around both; an empty one changes nothing.
[[nodiscard]] TexelRect merge(const TexelRect& a, const TexelRect& b);

} // namespace gnomon
