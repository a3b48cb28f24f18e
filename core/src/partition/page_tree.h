// SPDX-License-Identifier: Apache-2.0
// Which pages a light of partition virtual has: a quadtree over a square across the light, or over several of them,
// divided where that makes the picture's error fall most. A square is as PageSpace (page_space.h) has it: in it rays of
// light are points, and rays to the light's rim lead away from them in proportion to how far they come.
// Based on: R. Fernando, S. Fernandez, K. Bala, D. P. Greenberg, "Adaptive shadow maps", SIGGRAPH 2001 (a quadtree of
// pages of one size, divided by benefit under a bound on texels); A. Lefohn, S. Sengupta, J. Owens,
// "Resolution-matched shadow maps", 2007 (texels as wide as pixels are).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// A point that the camera sees, and how much a finer texel is worth there.
struct PagePoint {
    std::uint32_t face = 0; // index of its root
    glm::dvec2 at{0.0};     // across the light
    double depth = 0.0;     // along it
    double pixel = 0.0;     // a pixel's side there, across the light, on a surface that faces the eye
    double weight = 0.0;
};

/// A caster's box as pages ask for it.
struct PageCaster {
    std::uint32_t object = 0;
    glm::dvec2 low{0.0}; // its rectangle across the light
    glm::dvec2 high{0.0};
    double nearest = 0.0; // its least depth along the light
    /// For each pair of its faces the depth where a ray of light comes in between them: z + x and y times the place.
    std::array<glm::dvec3, 3> faces{};
};

/// The least depth where light comes into its box over a rectangle, or less: no less than any one pair of the box's
/// faces allows.
[[nodiscard]] double nearestOver(const PageCaster& caster, const glm::dvec2& low, const glm::dvec2& high);

/// A square of a light's grid: the same in every frame. Sides are powers of two of the space's unit.
struct PageKey {
    int level = 0;          // its side is 2^level
    std::uint32_t face = 0; // index of its root
    std::int64_t x = 0;     // its low corner, in quarters of its side from the space's middle
    std::int64_t y = 0;

    friend auto operator<=>(const PageKey&, const PageKey&) = default; // NOLINT(modernize-use-nullptr)
};
[[nodiscard]] double sideOf(const PageKey& key);
[[nodiscard]] glm::dvec2 lowOf(const PageKey& key);

/// A square that is divided, and the range of Input::casters over it. Without casters it has no pages.
struct PageRoot {
    PageKey key;
    std::uint32_t first_caster = 0;
    std::uint32_t caster_count = 0;
};

/// A page that was found. Its casters are a range of PageTree::casters().
struct FoundPage {
    PageKey key;
    std::uint32_t first_caster = 0;
    std::uint32_t caster_count = 0;
};

/// Deterministic, and keeps its memory.
class PageTree {
public:
    struct Input {
        std::span<const PageRoot> roots; // of one level, each at its place by `face`
        std::span<const PagePoint> points;
        std::span<const PageCaster> casters; // root after root, of each ascending by object
        double inner_texels = 0.0;           // of a page's side, its border taken off
        double border_texels = 0.0;          // on each side
        double reach_texels = 0.0;           // that the filter reads around a place, its rays to the light apart
        double spread = 0.0;                 // how far a ray to the light's rim is off, for each unit of depth
        double slant = 0.0; // at a place x or y across it is sqrt(1 + slant x^2) times as far off along that axis
        std::uint32_t most_pages = 1;
        std::span<const PageKey> known; // taken() in the frame before
        std::uint32_t rested = 0;       // frames in which nothing changed, except for what edges were seen
    };
    /// Roots with casters are always among the pages. A page whose four quarters have pages has none itself.
    void divide(const Input& input);
    /// Finest first, those of one side by place; roots last.
    [[nodiscard]] std::span<const FoundPage> pages() const { return pages_; }
    /// All squares that were divided or have pages, ascending: with those whose quarters serve all of them.
    [[nodiscard]] std::span<const PageKey> taken() const { return taken_; }
    /// Indices into Input::casters, ascending for each page.
    [[nodiscard]] std::span<const std::uint32_t> castersOf(const FoundPage& page) const
    {
        return std::span(casters_).subspan(page.first_caster, page.caster_count);
    }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    struct Node {
        PageKey key;
        std::uint32_t parent = kNone;
        std::uint32_t first_point = 0; // in order_
        std::uint32_t point_count = 0;
        std::uint32_t first_caster = 0; // in casters_
        std::uint32_t caster_count = 0;
        double served = 0.0; // texel of the finest page around it
        int depth = 0;       // how many times narrower than its root, as a power of two
        std::uint32_t covered = 0;
        bool mapped = false;
        bool taken = false;
    };
    struct Wish {
        double gain = 0.0;
        std::uint32_t node = 0;
    };
    void addRoots(const Input& input);
    void addQuarters(const Input& input, std::uint32_t parent);
    void addQuarter(const Input& input, std::uint32_t parent, const PageKey& key, std::uint32_t first,
                    std::uint32_t count);
    [[nodiscard]] bool listCasters(const Input& input, const Node& parent, Node& node);
    [[nodiscard]] bool holdsRays(const Input& input, const Node& node) const;
    [[nodiscard]] double gainOf(const Input& input, const Node& node) const;
    [[nodiscard]] bool comesLater(const Wish& a, const Wish& b) const;
    void take(std::uint32_t node);
    void listPages();

    std::vector<Node> nodes_;
    std::vector<Wish> wishes_; // a heap
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> casters_;
    std::vector<FoundPage> pages_;
    std::vector<PageKey> taken_;
    std::uint32_t page_count_ = 0;
    double stays_ = 1.0; // how many times more a page gains that is there
};

} // namespace gnomon
