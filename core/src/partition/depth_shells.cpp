// SPDX-License-Identifier: Apache-2.0
#include "partition/depth_shells.h"

#include "auto/map_error.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon {
namespace {

/// A lamp before the eye takes no more than four (T. Forsyth: "usually only need 3-4 regions at extreme"). Six erred by
/// 13 % less on the street of docs/techniques/multi.md, with twice the maps.
constexpr std::size_t kMostShells = 4;
/// Two shells become one where that needs at most kMergeCost times their texels, because each shell costs some passes.
constexpr double kMergeCost = 1.3;
/// The share of the nearest points that get no shell of their own. They may be guesses in a box around the eye, and so
/// small a part of the picture may have texels that are too large.
constexpr double kFewPoints = 0.02;
/// The shells of the last frame are kept while they need no more than this many times the texels of the best ones.
constexpr double kKeepCost = 1.6;

int octaveOf(double depth)
{
    constexpr double kLeast = 1e-6;
    constexpr double kMost = 1e6;
    return static_cast<int>(std::floor(std::log2(std::clamp(depth, kLeast, kMost))));
}

} // namespace

double beginOfOctave(int octave)
{
    return std::ldexp(1.0, octave);
}

std::size_t cubeFaceOf(const glm::dvec3& way)
{
    const glm::dvec3 a = glm::abs(way);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return static_cast<std::size_t>(2 * axis) + (way[axis] < 0.0 ? 1 : 0);
}

void ShellCell::add(const ShellCell& other)
{
    if (!other.used) {
        return;
    }
    rect.low = used ? glm::min(rect.low, other.rect.low) : other.rect.low;
    rect.high = used ? glm::max(rect.high, other.rect.high) : other.rect.high;
    density = std::max(density, other.density);
    points += other.points;
    used = true;
}

double ShellCell::texels() const
{
    const glm::dvec2 size = rect.high - rect.low;
    return used ? size.x * size.y * density * density : 0.0;
}

void DepthShell::add(const DepthShell& other)
{
    octave = std::min(octave, other.octave);
    end = std::max(end, other.end);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        cells[i].add(other.cells[i]);
    }
}

double DepthShell::texels() const
{
    double sum = 0.0;
    for (const ShellCell& cell : cells) {
        sum += cell.texels();
    }
    return sum;
}

double DepthShells::texelsOf(std::span<const DepthShell> shells)
{
    double sum = 0.0;
    for (const DepthShell& shell : shells) {
        sum += shell.texels();
    }
    return sum;
}

bool DepthShells::find(const Input& input, std::vector<int>& ends, KeepShells keep)
{
    gather(input);
    shells_ = octaves_;
    if (input.widest > 0) {
        mergeUpTo(input.widest);
    } else {
        mergeWhereItPays();
    }
    group(ends, kept_);
    const bool filled = std::ranges::all_of(kept_, [](const DepthShell& shell) { return shell.texels() > 0.0; });
    const bool narrow = input.widest == 0 || std::ranges::all_of(kept_, [&](const DepthShell& shell) {
                            return &shell == &kept_.back() || shell.end - shell.octave <= input.widest;
                        });
    const bool suffices = filled && narrow && texelsOf(kept_) <= kKeepCost * texelsOf(shells_);
    if (keep == KeepShells::all || (keep == KeepShells::good_enough && suffices)) {
        std::swap(kept_, shells_);
    }
    ends.clear();
    for (std::size_t i = 0; i + 1 < shells_.size(); ++i) {
        ends.push_back(shells_[i].end);
    }
    return suffices;
}

void DepthShells::findAgain(const Input& input, std::span<const int> ends)
{
    gather(input);
    group(ends, shells_);
}

void DepthShells::join()
{
    while (shells_.size() > 1) {
        mergeNext(0);
    }
}

/// Into shells that end there, whether a point is in them or not.
void DepthShells::group(std::span<const int> ends, std::vector<DepthShell>& out) const
{
    out.assign(ends.size() + 1, {});
    for (std::size_t i = 0; i < ends.size(); ++i) {
        out[i].end = ends[i];
        out[i + 1].octave = ends[i];
    }
    out.front().octave = ends.empty() ? octaves_.front().octave : std::min(octaves_.front().octave, ends.front() - 1);
    out.back().end = std::max(octaves_.back().end, out.back().octave + 1);
    for (const DepthShell& octave : octaves_) {
        DepthShell& shell = out[static_cast<std::size_t>(std::ranges::upper_bound(ends, octave.octave) - ends.begin())];
        for (std::size_t i = 0; i < kCubeFaces; ++i) {
            shell.cells[i].add(octave.cells[i]);
        }
    }
}

void DepthShells::gather(const Input& input)
{
    octaves_.clear();
    const Light& light = input.light;
    std::array<LightSpace, kCubeFaces> spaces;
    for (std::size_t i = 0; i < input.ways.size(); ++i) {
        spaces[i] = lightSpaceOf(light, input.ways[i].axis_ws, input.ways[i].half_angle_rad, input.camera.scene_ws);
    }
    for (const SightPoint& point : input.points) {
        const std::size_t sector = input.ways.size() > 1 ? cubeFaceOf(point.p_ws - light.position_ws) : 0;
        const std::optional<LitPoint> lit = litPoint(spaces[sector], point);
        if (!lit || !(lit->facing > 0.0)) {
            continue;
        }
        const double unit = glm::dot(input.ways[sector].depth.over, glm::dvec4(point.p_ws, 1.0));
        const int octave = input.camera.perspective ? octaveOf(point.depth_m / unit) : 0;
        auto shell = std::ranges::lower_bound(octaves_, octave, {}, &DepthShell::octave);
        if (shell == octaves_.end() || shell->octave != octave) {
            shell = octaves_.insert(shell, {octave, octave + 1, {}});
        }
        const glm::dvec2 half = 0.5 * lit->facing * input.cell_px;
        shell->cells[sector].add({{lit->q - half, lit->q + half}, 1.0 / lit->facing, 1, true});
    }
    if (octaves_.empty()) {
        octaves_.emplace_back();
    }
    joinFewNear();
}

void DepthShells::joinFewNear()
{
    const auto points = [](std::span<const DepthShell> shells) {
        int sum = 0;
        for (const DepthShell& shell : shells) {
            for (const ShellCell& cell : shell.cells) {
                sum += cell.points;
            }
        }
        return sum;
    };
    const double few = kFewPoints * points(octaves_);
    while (octaves_.size() > 1 && points(std::span(octaves_).first(1)) <= few) {
        for (ShellCell& cell : octaves_[0].cells) {
            cell.density = 0.0;
        }
        octaves_[1].add(octaves_[0]);
        octaves_.erase(octaves_.begin());
    }
}

void DepthShells::mergeNext(std::size_t shell)
{
    shells_[shell].add(shells_[shell + 1]);
    shells_.erase(shells_.begin() + static_cast<std::ptrdiff_t>(shell) + 1);
}

/// From the fine end on. The last one takes what is left, which is coarse.
void DepthShells::mergeUpTo(int octaves)
{
    for (std::size_t i = 0; i + 1 < shells_.size();) {
        const bool joins = i + 1 == kMostShells || shells_[i + 1].end - shells_[i].octave <= octaves;
        if (joins) {
            mergeNext(i);
        } else {
            ++i;
        }
    }
}

void DepthShells::mergeWhereItPays()
{
    while (shells_.size() > 1) {
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + 1 < shells_.size(); ++i) {
            DepthShell both = shells_[i];
            both.add(shells_[i + 1]);
            const double cost = both.texels() / (shells_[i].texels() + shells_[i + 1].texels());
            if (cost < least) {
                least = cost;
                best = i;
            }
        }
        if (least > kMergeCost && shells_.size() <= kMostShells) {
            return;
        }
        mergeNext(best);
    }
}

} // namespace gnomon
