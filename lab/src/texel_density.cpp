// SPDX-License-Identifier: Apache-2.0
#include "lab/texel_density.h"

namespace gnomon::lab {

TexelDensity texelDensity(const host::Picture& picture, const Counted& counted, const Camera& camera, const Plan& plan,
                          std::uint32_t light, double reach_texels)
{
    return texelDensity({camera, picture.depth, picture.normals}, counted, plan, light, reach_texels);
}

double fitEfficiency(const host::Picture& picture, const Counted& counted, const Camera& camera, const Plan& plan,
                     std::uint32_t light, double reach_texels)
{
    return fitEfficiency(texelUse({camera, picture.depth, picture.normals}, counted, plan, light, reach_texels));
}

Counted facingPixels(const host::Picture& picture, const Camera& camera, const Light& light)
{
    return facingPixels({camera, picture.depth, picture.normals}, light);
}

} // namespace gnomon::lab
