// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include "cpu_fins.h"

#include <gnomon/shared/smoothie_fins.h>

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gnomon::test {
namespace {

using shared::Fin;

/// A scene's edges in a view.
class EdgesInView {
public:
    EdgesInView(const Scene& scene, const View& view)
        : edges_(sceneEdges()), transforms_(scene.transforms()), view_(view)
    {
    }

    template <class Use>
    void forEachFin(Use&& use) const
    {
        for (std::size_t object = 0; object < transforms_.size(); ++object) {
            const vulkan::VolumeMesh& mesh = edges_.meshes[object == 0 ? 0 : 1];
            for (std::uint32_t i = 0; i < mesh.element_count; ++i) {
                if (const auto fin = finOf(object, mesh, edges_.elements[mesh.first_element + i])) {
                    use(*fin);
                }
            }
        }
    }

private:
    [[nodiscard]] glm::dvec4 pointOf(std::size_t object, const vulkan::VolumeMesh& mesh, std::uint32_t vertex) const
    {
        const glm::dvec4 p(glm::dvec3(edges_.positions[mesh.first_vertex + vertex]), 1.0);
        const vulkan::Rows3x4& rows = transforms_[object];
        return {glm::dot(glm::dvec4(rows.x), p), glm::dot(glm::dvec4(rows.y), p), glm::dot(glm::dvec4(rows.z), p), 1.0};
    }
    [[nodiscard]] glm::dvec3 clipOf(const glm::dvec4& p) const
    {
        const glm::dvec4 clip = view_.projection.clip_from_world * p;
        return {clip.x, clip.y, clip.w};
    }
    /// In the tile.
    [[nodiscard]] glm::dvec2 texelOf(const glm::dvec3& clip) const
    {
        return (glm::dvec2(clip) / clip.z * 0.5 + 0.5) * glm::dvec2(view_.place.tile.width, view_.place.tile.height);
    }
    [[nodiscard]] std::optional<Fin> finOf(std::size_t object, const vulkan::VolumeMesh& mesh,
                                           const glm::uvec4& element) const
    {
        const glm::dvec4 from = pointOf(object, mesh, element.x);
        const glm::dvec4 to = pointOf(object, mesh, element.y);
        const glm::dvec3 a = clipOf(from);
        const glm::dvec3 along = clipOf(to - from);
        std::array<double, 2> sides{};
        for (int i = 0; i < 2; ++i) {
            const std::uint32_t triangle = i == 1 && element.w < edges_.triangles.size() ? element.w : element.z;
            const auto third = std::ranges::find_if(edges_.triangles[triangle],
                                                    [&](std::uint32_t v) { return v != element.x && v != element.y; });
            sides[static_cast<std::size_t>(i)] =
                shared::finSide(a, along, clipOf(pointOf(object, mesh, *third) - from));
        }
        const glm::dvec3 b = a + along;
        if (!shared::isSilhouette(sides[0], sides[1]) || std::max(a.z, b.z) <= 0.0) {
            return std::nullopt;
        }
        const auto depth = [&](double t) {
            return glm::dot(view_.projection.metric.metric_ws, glm::mix(from, to, t));
        };
        const double near_a = view_.projection.clamp_near ? 0.0 : depth(0.0);
        const double near_b = view_.projection.clamp_near ? 0.0 : depth(1.0);
        const double begin = std::max(shared::finCut(a.z, b.z), shared::finBeforeNear(near_a, near_b));
        const double end = 1.0 - std::max(shared::finCut(b.z, a.z), shared::finBeforeNear(near_b, near_a));
        if (begin >= end) {
            return std::nullopt;
        }
        const glm::dvec3 first = a + along * begin;
        const glm::dvec3 last = a + along * end;
        const glm::dvec2 p = texelOf(first);
        const glm::dvec2 q = texelOf(last);
        return Fin{p, q, shared::finOutward(p, q, sides[0] + sides[1]), depth(begin), depth(end), first.z, last.z};
    }

    SceneEdges edges_;
    std::vector<vulkan::Rows3x4> transforms_;
    const View& view_;
};

} // namespace

std::vector<int> finsOf(const Scene& scene, const View& view, const CpuMap& map, int reach, double quantum)
{
    const auto width = static_cast<int>(view.place.tile.width);
    const auto height = static_cast<int>(view.place.tile.height);
    const auto depth = [&](int x, int y) {
        return texelAt(map, 0, view.place.tile.x + std::clamp(x, 0, width - 1),
                       view.place.tile.y + std::clamp(y, 0, height - 1))
            .x;
    };
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<int> made(count, shared::packSmoothie({1.0, -1.0}));
    std::vector<double> order(count, 1.0);
    const auto draw = [&](const Fin& fin, int x, int y) {
        const glm::dvec2 centre(x + 0.5, y + 0.5);
        const double nearest = shared::finNearest(fin, centre);
        const double distance = shared::finDistance(fin, centre, nearest);
        if (distance > reach || shared::isBehindFin(fin, centre)) {
            return;
        }
        const double here = depth(x, y);
        const glm::dvec2 lean(shared::flatterLean(depth(x - 1, y), here, depth(x + 1, y)),
                              shared::flatterLean(depth(x, y - 1), here, depth(x, y + 1)));
        const double edge = shared::finDepth(fin, nearest);
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        const double of_fin = shared::finOrder(distance, here - edge);
        if (shared::isOverSurface(here - edge, glm::length(lean), distance, quantum) && of_fin <= order[i]) {
            order[i] = of_fin;
            made[i] = shared::packSmoothie({edge, distance});
        }
    };
    EdgesInView(scene, view).forEachFin([&](const Fin& fin) {
        const auto from = [&](double a, double b) {
            return std::max(static_cast<int>(std::floor(std::min(a, b))) - reach - 1, 0);
        };
        const auto to = [&](double a, double b, int end) {
            return std::min(static_cast<int>(std::ceil(std::max(a, b))) + reach + 1, end);
        };
        for (int y = from(fin.from.y, fin.to.y); y < to(fin.from.y, fin.to.y, height); ++y) {
            for (int x = from(fin.from.x, fin.to.x); x < to(fin.from.x, fin.to.x, width); ++x) {
                draw(fin, x, y);
            }
        }
    });
    return made;
}

} // namespace gnomon::test
