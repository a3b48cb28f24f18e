// SPDX-License-Identifier: Apache-2.0
// Figures of claims that need no picture: they come from the library's own arithmetic, in double precision, or from
// what a document prints.
#pragma once

namespace gnomon::app {

/// How much more of [0, 1] one metre takes with planes at 1 and 100 m than at 1 and 10,000 m.
[[nodiscard]] double precisionOfTightPlanes();
/// From the last single-precision number below 1 to 1.
[[nodiscard]] double stepOfFloats();
/// The deviation of depth that two moments in single precision cannot tell from none, as a share of the range.
[[nodiscard]] double deviationLostByMoments();

/// The largest difference, in metres, between a distance interpolated over a triangle 20 m across and the distance
/// itself, the triangle being some 10 m from the light.
[[nodiscard]] double errorOfPlaneDistance(); // to the light's plane
[[nodiscard]] double errorOfPlaceDistance(); // to the light's place
[[nodiscard]] double errorOfClipDepth();     // a lamp's clip-space z, over its range

/// The largest error of Chebyshev's bound for one occluder over one receiver, both parallel to the map, whatever share
/// of the texel is covered.
[[nodiscard]] double errorOfPlanarBound();

/// Texels per degree at the edge of a map of so wide a field of view, by those in its middle.
[[nodiscard]] double densityAtEdge(double fov_deg);
/// One step of depth at the far plane, in metres, near 0.1 m and far 1000 m, in so many bits.
[[nodiscard]] double stepOfBits(int bits);
/// The same of z / w.
[[nodiscard]] double stepOfBitsInZOverW(int bits);

/// By how much a step of depth grows when depth is moved into the half from 0.5 to 1: of codes of 16 bits; of floats at
/// a share of the range.
[[nodiscard]] double coarserInUpperHalf();
[[nodiscard]] double coarserInUpperHalf(double depth);
/// By how much a least variance against rounding shrinks, as a deviation, when depth is stored in -1 to 1.
[[nodiscard]] double finerBySign();

/// The largest error of depth in two bytes, in steps of 16 bits: as the document packs them, and as ours are.
[[nodiscard]] double errorOfPublishedBytes();
[[nodiscard]] double errorOfBytes();

/// Of the fifteen taps of the published blur: the sum of their weights, where their centre lies in pixels, and the
/// weight of the right side by that of the left.
struct PublishedBlur {
    double sum = 0.0;
    double centre_px = 0.0;
    double sides = 0.0;
};
[[nodiscard]] PublishedBlur publishedBlur();
/// Texels between the published taps of a kernel, whose offsets are divided by w, so many metres from the lamp.
[[nodiscard]] double publishedTapsApart(double distance_m);
/// From the last single-precision number below so many metres to them.
[[nodiscard]] double stepOfFloatsBelow(double metres);

} // namespace gnomon::app
