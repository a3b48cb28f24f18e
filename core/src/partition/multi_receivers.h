// SPDX-License-Identifier: Apache-2.0
// Partition multi with MultiDivide::receivers: receivers are gathered into cones of a light, each a frustum.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006.
#pragma once

#include "camera_view.h"
#include "light_space.h"
#include "partition/partition.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon {

/// All that a light sees within `radius` of `centre`. For a lamp these are a unit direction and an angle: a cone. For a
/// sun they are a point across its rays (z is 0) and metres: a cylinder.
struct LightCone {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
};

/// Tangent of half the angle of a lamp's widest frustum, 120 degrees.
inline constexpr double kWidestTangent = 1.7320508;

/// A frustum around some receivers.
struct ReceiverCone {
    std::uint32_t id = 0;     // within its light: the same from frame to frame
    LightCone cone;           // around its receivers
    LightRect rect;           // around them, across the cone's axis
    double texel = 0.0;       // as LightRect has it: the largest that is fine enough for all of them
    double coarsest = 0.0;    // the largest that is fine enough for one of them
    std::uint32_t pieces = 0; // receivers in it, or pieces of them
    bool joined = false;      // one of them is ObjectFlags::joined
    bool held = false;        // it is of an earlier frame: neither its axis nor `texel` changes
    int promised = 0;         // with motion snap: the step (texelOfStep()) of `texel`
    int step = 0;             // and of the texels that it is drawn with, which are no finer
    double opacity = 1.0;     // ViewServes::faded_in
    std::uint32_t side = 0;   // side of its map, texels
    double sum = 0.0;         // FacingTexels::sum_px
};

/// Which cone a receiver, or a piece of one, was in.
struct ReceiverHome {
    std::uint64_t piece = 0;
    std::uint32_t cone = 0; // ReceiverCone::id
};

/// Gathers the receivers of one light. Keeps its memory.
class ReceiverCones {
public:
    struct Input {
        const Light& light;
        const CameraView& camera; // measured
        const ObjectSet& objects;
        std::span<const std::uint32_t> receivers; // that the camera sees, in the light's reach
        double pixel_m = 0.0;                     // side of a pixel 1 m before a perspective camera, else anywhere
        double texels_per_pixel = 1.0;
        double most_times = 4.0;     // the most times that a texel is finer than one of its receivers wants
        double largest_texels = 0.0; // texels on a side of the largest map
        double blend = 0.0;          // how much wider frustums of joined receivers are, share of half their width
        bool steady = false;
    };
    /// Near receivers first, each is put into the cone that it was in, else the first that suits it, else the one that
    /// has to grow least for it, else one of its own. Begins with `held`, which come first in what is returned; those
    /// without pieces are no longer of use. `homes` ascend by piece. Valid until the next call.
    [[nodiscard]] std::span<ReceiverCone> gather(const Input& input, std::span<const ReceiverCone> held,
                                                 std::span<const ReceiverHome> homes);
    /// The homes of all that gather() found, by the ids that its cones have by now.
    void listHomes(std::vector<ReceiverHome>& out) const;

private:
    /// A receiver, or a part of one that is too large for one frustum, as far as camera and light see it.
    struct Piece {
        std::uint32_t object = 0;
        std::uint32_t number = 0; // piece of the object, from 1 on; 0: it is whole
        double depth_m = 0.0;     // distance of its nearest point from the eye
        double texel = 0.0;       // the largest texel that is fine enough for all of it
        LightCone cone;
        std::uint32_t first_point = 0;
        std::uint32_t point_count = 0;
        bool joined = false;
        std::uint32_t in = 0; // which of cones_
        [[nodiscard]] std::uint64_t key() const { return std::uint64_t{object} << 3U | number; }
    };
    void listPieces(const Input& input);
    void chop(const Input& input, const Piece& whole);
    Piece pieceOf(const Input& input, std::uint32_t object, std::uint32_t number);
    LightCone coneAround(const Input& input, std::span<const glm::dvec3> points);
    void place(const Input& input, std::span<const ReceiverHome> homes, Piece& piece);
    [[nodiscard]] bool putHome(const Input& input, std::span<const ReceiverHome> homes, Piece& piece);
    [[nodiscard]] static bool grow(const Input& input, const Piece& piece, ReceiverCone& cone);
    void put(std::size_t in, const ReceiverCone& grown, Piece& piece);
    void measure(const Input& input);

    std::vector<ReceiverCone> cones_;
    std::vector<Piece> pieces_;
    std::vector<glm::dvec3> points_; // corners of pieces, world space
    std::vector<glm::dvec3> seen_;   // by the light, of one piece
    ConvexBody body_;
    ConvexBody whole_;
};

/// The way that the maps of a cone look.
[[nodiscard]] glm::dvec3 axisOf(const Light& light, const LightCone& cone);
/// The plane that `row` is 0 on. Its normal is not 0.
[[nodiscard]] Plane planeOf(const glm::dvec4& row);

} // namespace gnomon
