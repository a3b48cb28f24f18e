// SPDX-License-Identifier: Apache-2.0
#include "map_storage.h"

#include <algorithm>
#include <iterator>

namespace gnomon::vulkan {
namespace {

// Single precision carries about 4e-6 through matrix, interpolation and comparison; 16 bits add one step and a half.
constexpr float kArithmetic = 4e-6F;
constexpr MapStorage kStorages[] = {
    {MapFormat::d16, VK_FORMAT_UNDEFINED, VK_FORMAT_D16_UNORM, 1.5F / 65535.0F + kArithmetic},
    {MapFormat::d32f, VK_FORMAT_UNDEFINED, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::r32f, VK_FORMAT_R32_SFLOAT, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::rg16, VK_FORMAT_R16G16_UNORM, VK_FORMAT_D32_SFLOAT, 1.5F / 65535.0F + kArithmetic},
    {MapFormat::rg16f, VK_FORMAT_R16G16_SFLOAT, VK_FORMAT_D32_SFLOAT, 1.0F / 2048.0F},
    {MapFormat::rg32f, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::rgba16, VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_D32_SFLOAT, 1.5F / 65535.0F + kArithmetic},
    {MapFormat::rgba16f, VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_D32_SFLOAT, 1.0F / 2048.0F},
    {MapFormat::rgba32f, VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_D32_SFLOAT, kArithmetic},
    {MapFormat::r16f, VK_FORMAT_R16_SFLOAT, VK_FORMAT_D32_SFLOAT, 1.0F / 2048.0F},
};

} // namespace

const MapStorage* findMapStorage(MapFormat format)
{
    const auto* found = std::find_if(std::begin(kStorages), std::end(kStorages),
                                     [&](const MapStorage& storage) { return storage.format == format; });
    return found != std::end(kStorages) ? found : nullptr;
}

} // namespace gnomon::vulkan
