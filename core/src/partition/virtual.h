// SPDX-License-Identifier: Apache-2.0
// Partition `virtual`: a light's texels lie in pages of one size, each of which shows a square of a grid that stands
// still in the world. Pages are narrow where the picture has edges of shadows, and are kept from frame to frame.
#pragma once

#include "partition/page_space.h"
#include "recipe.h"
#include "region.h"
#include "store/light_rows.h"

#include "auto/sight.h"

#include <span>
#include <vector>

namespace gnomon {

/// The border on each side of a page that has to hold rays, as a share of its side; more where the filter needs more.
inline constexpr double kPageBorder = 14.0 / 128.0;
/// Texels on a side of a page, where a light may have so many, and its rays have room in pages of several sizes.
inline constexpr std::uint32_t kPageSide = 128;

/// One page of a light in one frame.
struct VirtualPage {
    std::uint32_t id = 0; // within its light: the same for as long as it is there
    PageKey key;
    ViewPage square;
    std::uint32_t first_caster = 0; // see VirtualPartition::castersOf()
    std::uint32_t caster_count = 0;
};

/// Remembers a light by its key for as long as it is in the frames.
class VirtualPartition {
public:
    struct Input {
        const Frame& frame;
        const Recipe& recipe;
        const CameraView& camera;
        std::span<const std::uint32_t> receivers; // that the camera sees
        const Sight& sight;
        const Light& light;
        std::uint32_t rested = 0; // frames in which nothing changed, except for requests
    };

    /// The lights of a frame. Those that are gone are forgotten, and nobody has pages yet.
    void follow(std::span<const Light> lights);
    /// Finds a light's pages.
    void divide(const Input& input, std::size_t light);
    /// ok, or why the light has no pages.
    [[nodiscard]] const Outcome& outcomeOf(std::size_t light) const { return found_[light].outcome; }
    /// Finest first. Holds until the next divide().
    [[nodiscard]] std::span<const VirtualPage> pagesOf(std::size_t light) const;
    /// Texels on a side of each of its pages.
    [[nodiscard]] std::uint32_t sideOf(std::size_t light) const { return found_[light].side; }
    /// Objects whose boxes reach into a page or its border, ascending.
    [[nodiscard]] std::span<const std::uint32_t> castersOf(const VirtualPage& page) const
    {
        return std::span(casters_).subspan(page.first_caster, page.caster_count);
    }
    /// Fills in how a page is projected onto `side` texels, and which points it serves.
    void project(std::size_t light, const VirtualPage& page, std::uint32_t side, View& view) const;

private:
    struct Known {
        PageKey key;
        std::uint32_t id = 0;
    };
    struct Memory {
        std::vector<Known> pages; // ascending
        std::vector<Known> next;
        std::vector<PageKey> taken; // PageTree::taken()
        std::uint32_t next_id = 1;
        // Pages of another place, direction or angle show something else.
        glm::dvec3 place_ws{0.0};
        glm::dvec3 direction_ws{0.0};
        double unit = 0.0;
    };
    /// A light in this frame.
    struct Found {
        Outcome outcome;
        std::uint64_t texels = 0;      // of all its pages
        std::uint32_t side = 0;        // texels of a page
        double border = 0.0;           // share of a page's side
        std::uint32_t first_space = 0; // of its roots, in spaces_
        std::uint32_t first_page = 0;
        std::uint32_t page_count = 0;
    };
    [[nodiscard]] static PageKey rootAround(const LightRect& rect, double least_m);
    void listRoots(const Input& input, Found& found);
    [[nodiscard]] Outcome addRoot(const Input& input, const Slice& slice, double border, PageRoot& root);
    void listCasters(const Input& input, const PageSpace& space, double border, PageRoot& root);
    void listPoints(const Input& input, const Found& found);
    void addRequested(const Input& input, const PageRequests& requests, const Found& found);
    void addPoint(const Light& light, const Found& found, const glm::dvec3& p_ws, double pixel_m, double weight);
    void widenPages(const Input& input, const PageSpread& spread, Found& found) const;
    void forgetOther(const Found& found, Memory& memory) const;
    void namePages(Memory& memory, Found& found);

    LightRows rows_;
    std::vector<Memory> memories_; // by row
    std::vector<Found> found_;     // by light
    std::vector<PageSpace> spaces_;
    std::vector<VirtualPage> pages_;
    std::vector<std::uint32_t> casters_;
    // Scratch.
    std::vector<std::uint64_t> keys_;
    Region region_;
    PageTree tree_;
    std::vector<PageRoot> roots_;
    std::vector<PagePoint> points_;
    std::vector<Plane> planes_;
    std::vector<std::uint32_t> objects_;
    std::vector<PageCaster> boxes_;
};

} // namespace gnomon
