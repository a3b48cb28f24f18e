// SPDX-License-Identifier: Apache-2.0
// Divides a light's receivers into shells that want texels of about one size: for a sun by the camera's depth, for a
// lamp by the camera's depth over the depth from the lamp (ViewSlice).
#pragma once

#include "auto/sight.h"
#include "light_space.h"
#include "partition/partition.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon {

/// A group of a light's points: their rectangle across the light, and how fine it must be.
struct ShellCell {
    LightRect rect;
    double density = 0.0; // pixels a unit of length of the rectangle
    int points = 0;
    bool used = false;

    void add(const ShellCell& other);
    [[nodiscard]] double texels() const;
};

/// Between two of ViewSlice's numbers, octaves.
struct DepthShell {
    int octave = 0; // begins at 2^octave
    int end = 0;    // ends at 2^end
    std::array<ShellCell, kCubeFaces> cells;

    void add(const DepthShell& other);
    [[nodiscard]] double texels() const;
};

/// Which of the shells of the frame before are kept.
enum class KeepShells : std::uint8_t { none, good_enough, all };

/// The shells of one light in one frame, near ones first. Keeps its memory.
class DepthShells {
public:
    struct Input {
        const Light& light;
        const CameraView& camera;
        std::span<const Slice> ways; // the directions among which the light is divided: one, or a cube's faces
        std::span<const SightPoint> points;
        glm::dvec2 cell_px; // pixels that each of the points stands for
        int widest = 0;     // widest shell except the last, octaves; 0: as wide as it pays
    };

    /// A shell for each octave that a lit point is in, those as one that cost little more so; one for everything where
    /// there is no point. `ends` is where all but the last ended in the frame before, octaves, and
    /// becomes what it is now. Returns whether those of the frame before are good enough.
    bool find(const Input& input, std::vector<int>& ends, KeepShells keep);
    /// Those that the ends say.
    void findAgain(const Input& input, std::span<const int> ends);
    /// Makes one of them.
    void join();
    [[nodiscard]] std::span<const DepthShell> shells() const { return shells_; }

private:
    void gather(const Input& input);
    void group(std::span<const int> ends, std::vector<DepthShell>& out) const;
    void joinFewNear();
    void mergeWhereItPays();
    void mergeUpTo(int octaves);
    void mergeNext(std::size_t shell);
    static double texelsOf(std::span<const DepthShell> shells);

    std::vector<DepthShell> octaves_;
    std::vector<DepthShell> shells_;
    std::vector<DepthShell> kept_;
};

/// Where an octave begins: 2^octave.
[[nodiscard]] double beginOfOctave(int octave);
/// Which face of a cube around a light a direction leads through: as cubeFace() counts them.
[[nodiscard]] std::size_t cubeFaceOf(const glm::dvec3& way);

} // namespace gnomon
