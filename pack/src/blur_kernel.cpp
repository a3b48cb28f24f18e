// SPDX-License-Identifier: Apache-2.0
// Two texels by one filtered read: D. Rakos, "Efficient Gaussian blur with linear sampling", 2010.
#include <gnomon/pack/filter_rule.h>

#include <array>
#include <cmath>

namespace gnomon::pack {

shared::BlurKernel blurKernel(const MomentOptions& options)
{
    const std::uint32_t radius = blurRadius(options);
    const double sigma = static_cast<double>(options.blur_sigma_texels);
    std::array<double, shared::kBlurTableLength> weights{};
    double sum = 0.0;
    for (std::uint32_t i = 0; i <= radius; ++i) {
        const double d = i / sigma;
        weights[i] = blurOf(options) == BlurKind::box ? 1.0 : std::exp(-0.5 * d * d);
        sum += i == 0 ? weights[i] : 2.0 * weights[i];
    }
    shared::BlurKernel kernel{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] /= sum;
        kernel.weight[i].x = static_cast<float>(weights[i]);
    }
    // A linear filter between texels d and d + 1 at d + f weighs them 1 - f and f.
    kernel.weight[0].z = kernel.weight[0].x;
    for (std::size_t i = 1; 2 * i - 1 <= radius; ++i) {
        const double near = weights[2 * i - 1];
        const double far = weights[2 * i]; // 0 beyond the radius
        const double both = near + far;
        // Far out a narrow kernel weighs nothing at all.
        const double away = both > 0.0 ? far / both : 0.0;
        kernel.weight[i].y = static_cast<float>(static_cast<double>(2 * i - 1) + away);
        kernel.weight[i].z = static_cast<float>(both);
    }
    return kernel;
}

} // namespace gnomon::pack
