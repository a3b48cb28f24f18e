// SPDX-License-Identifier: Apache-2.0
#include "textures.h"

#include <algorithm>
#include <bit>
#include <string>

namespace gnomon::host {
namespace {

constexpr std::uint32_t kCookieSide = 256;
constexpr VkImageUsageFlags kUsage =
    VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;

VkSamplerAddressMode address(scene::Wrap wrap)
{
    switch (wrap) {
    case scene::Wrap::mirrored_repeat:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case scene::Wrap::clamp_to_edge:
        return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case scene::Wrap::repeat:
        break;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

// Average over the source texels that a cookie texel covers, or the nearest one when it covers less than one.
void resample(const scene::Image& source, std::uint8_t* target)
{
    for (std::uint32_t y = 0; y < kCookieSide; ++y) {
        const std::uint32_t y0 = y * source.height / kCookieSide;
        const std::uint32_t y1 = std::max((y + 1) * source.height / kCookieSide, y0 + 1);
        for (std::uint32_t x = 0; x < kCookieSide; ++x) {
            const std::uint32_t x0 = x * source.width / kCookieSide;
            const std::uint32_t x1 = std::max((x + 1) * source.width / kCookieSide, x0 + 1);
            for (std::uint32_t c = 0; c < 4; ++c) {
                std::uint64_t sum = 0;
                for (std::uint32_t v = y0; v < y1; ++v) {
                    for (std::uint32_t u = x0; u < x1; ++u) {
                        sum += source.rgba[(std::size_t{v} * source.width + u) * 4 + c];
                    }
                }
                *target++ = static_cast<std::uint8_t>(sum / (std::uint64_t{x1 - x0} * (y1 - y0)));
            }
        }
    }
}

} // namespace

Textures::Textures(const Gpu& gpu, Memory& memory, Uploader& uploader, const scene::Scene& scene)
    : gpu_(gpu), memory_(memory), uploader_(uploader), scene_(scene)
{
    white_ = uploadTexel(0xFFFFFFFFU, "white");
    flat_ = uploadTexel(0xFFFF8080U, "flat normal");
    nearest_ =
        makeSampler(VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, false, false, false);
    plain_ =
        makeSampler(VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, true, true, false);
    uploadCookies();
}

VkSampler Textures::makeSampler(VkSamplerAddressMode u, VkSamplerAddressMode v, bool magnify, bool minify, bool mips)
{
    const std::uint32_t key = static_cast<std::uint32_t>(u) << 8 | static_cast<std::uint32_t>(v) << 4 |
                              (magnify ? 4U : 0U) | (minify ? 2U : 0U) | (mips ? 1U : 0U);
    OwnedSampler& made = samplers_[key];
    if (!made) {
        VkSamplerCreateInfo info{VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
        info.magFilter = magnify ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
        info.minFilter = minify ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
        info.mipmapMode = minify ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
        info.addressModeU = u;
        info.addressModeV = v;
        info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
        info.maxLod = mips ? VK_LOD_CLAMP_NONE : 0.0F;
        VkSampler sampler = VK_NULL_HANDLE;
        check(vkCreateSampler(gpu_.view().device, &info, nullptr, &sampler), "making a sampler");
        made = {gpu_, sampler};
        memory_.names().name(VK_OBJECT_TYPE_SAMPLER, sampler, "scene sampler");
    }
    return made.get();
}

VkSampler Textures::mipSampler(bool linear)
{
    constexpr VkSamplerAddressMode kClamp = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return makeSampler(kClamp, kClamp, linear, linear, true);
}

VkSampler Textures::sampler(const scene::Texture& texture)
{
    return makeSampler(address(texture.wrap_u), address(texture.wrap_v), texture.magnify_linear, texture.minify_linear,
                       texture.mipmaps);
}

Image Textures::upload(const scene::Image& source, bool srgb)
{
    ImageWish wish;
    wish.name = source.name.c_str();
    wish.purpose = "scene textures";
    wish.format = srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
    wish.extent = {source.width, source.height};
    wish.usage = kUsage;
    wish.mips = static_cast<std::uint32_t>(std::bit_width(std::max(source.width, source.height)));
    const Image image = memory_.image(wish);
    uploader_.toImage(image, 0, source.rgba.data(), 4);
    uploader_.finishImage(image);
    return image;
}

Image Textures::uploadTexel(std::uint32_t rgba, const char* name)
{
    ImageWish wish;
    wish.name = name;
    wish.purpose = "scene textures";
    wish.format = VK_FORMAT_R8G8B8A8_UNORM;
    wish.extent = {1, 1};
    wish.usage = kUsage;
    const Image image = memory_.image(wish);
    uploader_.toImage(image, 0, &rgba, 4);
    uploader_.finishImage(image);
    return image;
}

void Textures::uploadCookies()
{
    for (const scene::Light& light : scene_.lights) {
        if (light.cookie != scene::kNone && cookieLayer(light.cookie) < 0) {
            cookie_images_.push_back(light.cookie);
        }
    }
    ImageWish wish;
    wish.name = "cookies";
    wish.purpose = "scene textures";
    wish.format = VK_FORMAT_R8G8B8A8_SRGB;
    const std::uint32_t side = cookie_images_.empty() ? 1 : kCookieSide;
    wish.extent = {side, side};
    wish.usage = kUsage;
    wish.layers = static_cast<std::uint32_t>(cookie_images_.size()) + 1;
    wish.array_view = true;
    cookies_ = memory_.image(wish);
    std::vector<std::uint8_t> texels(std::size_t{4} * side * side, 255);
    uploader_.toImage(cookies_, 0, texels.data(), 4);
    for (std::uint32_t i = 0; i < cookie_images_.size(); ++i) {
        resample(scene_.images[cookie_images_[i]], texels.data());
        uploader_.toImage(cookies_, i + 1, texels.data(), 4);
    }
    uploader_.finishImage(cookies_);
}

VkDescriptorImageInfo Textures::use(const scene::TextureUse& use, Role role)
{
    const bool there = use.texture != scene::kNone && scene_.textures[use.texture].image != scene::kNone;
    if (!there) {
        return {plain_, role == Role::normal ? flat_.view : white_.view, kSampled.layout};
    }
    const scene::Texture& texture = scene_.textures[use.texture];
    const auto key = std::pair{texture.image, role == Role::colour};
    auto found = images_.find(key);
    if (found == images_.end()) {
        found = images_.emplace(key, upload(scene_.images[texture.image], key.second)).first;
    }
    return {sampler(texture), found->second.view, kSampled.layout};
}

VkDescriptorImageInfo Textures::cookies() const
{
    return {plain_, cookies_.view, kSampled.layout};
}

int Textures::cookieLayer(std::uint32_t image) const
{
    const auto found = std::find(cookie_images_.begin(), cookie_images_.end(), image);
    return found == cookie_images_.end() ? -1 : static_cast<int>(found - cookie_images_.begin()) + 1;
}

} // namespace gnomon::host
