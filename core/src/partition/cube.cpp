// SPDX-License-Identifier: Apache-2.0
// The six faces of a cube around a light that has a place, with a map each: the baseline that `multi` is measured
// against.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (what omni lights were given before).
// Departure: a fit takes what is seen of a face, so a face whose receivers fill a part of it has finer texels, and one
// without any has no map. Neither has one that a spot light's cone does not reach into.
#include "light_space.h"
#include "partition/partition.h"

#include <glm/gtc/constants.hpp>

namespace gnomon {
namespace {

constexpr double kFaceCorner_rad = 0.9553166181; // from a face's middle: acos(1 / sqrt(3))

} // namespace

Slice cubeFace(const Light& light, int face)
{
    const auto row = [&](int axis, double sign) {
        glm::dvec3 along(0.0);
        along[axis] = sign;
        return glm::dvec4(along, -sign * light.position_ws[axis]);
    };
    const int axis = face / 2;
    Slice slice;
    slice.sector = {row((axis + 1) % 3, 1.0), row((axis + 2) % 3, 1.0), row(axis, face % 2 == 0 ? 1.0 : -1.0)};
    slice.axis_ws = glm::dvec3(slice.sector.w);
    slice.half_angle_rad = glm::quarter_pi<double>();
    return slice;
}

bool shinesIntoFace(const Light& light, const Slice& face)
{
    return shinesInto(light, face.axis_ws, kFaceCorner_rad);
}

void partitionCube(const PartitionInput& input, std::vector<Slice>& out)
{
    for (int face = 0; face < static_cast<int>(kCubeFaces); ++face) {
        if (const Slice slice = cubeFace(input.light, face); shinesIntoFace(input.light, slice)) {
            out.push_back(slice);
        }
    }
}

} // namespace gnomon
