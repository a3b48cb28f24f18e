// SPDX-License-Identifier: Apache-2.0
// Lets gnomon/lib compile as C++ in the GPU's single precision, with whatever maps hold. All tests that do so include
// this, so that the shaders' functions are the same ones in each.
#pragma once
#define GNOMON_REAL float
#define GNOMON_SMOOTHIES

#include <gnomon/shared/discs.h>
#include <gnomon/shared/smoothies.h>

#include <functional>

namespace gnomon::test {
/// The answer to any read of a map.
inline std::function<glm::vec4()> float_texel;
/// GpuDepthLayers::layer of a view.
inline std::function<glm::vec4(int i)> float_layers;
} // namespace gnomon::test

GN_BEGIN
inline real mapTexel(real2, real, real)
{
    return test::float_texel().x;
}
inline real2 mapBlock(real2, int, real)
{
    return {0.0F, 1.0F};
}
inline real4 mapGather(real2, real, real)
{
    return test::float_texel();
}
inline int mapSmoothie(real2, real)
{
    return packSmoothie({0.0F, -1.0F});
}
inline real4 mapMoments(real2, real, real)
{
    return test::float_texel();
}
inline real4 mapDepthLayer(int, int i)
{
    return test::float_layers(i);
}
inline real2 discPoint(int i)
{
    return kPoissonPoints[i];
}
GN_END

#include <gnomon/lib/visibility.glsl>
