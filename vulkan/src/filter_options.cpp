// SPDX-License-Identifier: Apache-2.0
#include <gnomon/vulkan/shadow_renderer.h>

namespace gnomon::vulkan {

FilterOptions filterOptionsOf(const ShadowOptions& options)
{
    return {options.technique.filter,
            formatOf(options),
            options.pcf.kernel,
            options.pcf.taps,
            options.pcf.radius_texels,
            options.pcf.sigma_texels.value_or(0.0F),
            options.bias,
            options.moments};
}

float filterReachTexels(const FilterOptions& filter)
{
    ShadowOptions options;
    options.technique.filter = filter.filter;
    options.pcf.kernel = filter.pcf_kernel;
    options.pcf.radius_texels = filter.disc_radius_texels;
    options.moments = filter.moments;
    return reachTexels(options);
}

} // namespace gnomon::vulkan
