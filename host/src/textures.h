// SPDX-License-Identifier: Apache-2.0
// A scene's images on the GPU, their samplers, and the cookies of its lights.
#pragma once

#include "commands.h"
#include "scene/model.h"

#include <map>
#include <span>
#include <vector>

namespace gnomon::host {

class Textures {
public:
    Textures(const Gpu& gpu, Memory& memory, Uploader& uploader, const scene::Scene& scene);
    ~Textures() = default;
    Textures(const Textures&) = delete;
    Textures& operator=(const Textures&) = delete;

    enum class Role : std::uint8_t { colour, data, normal };
    /// The texture to bind for a use; one neutral texel where there is no texture.
    [[nodiscard]] VkDescriptorImageInfo use(const scene::TextureUse& use, Role role);
    /// All cookies as layers of one array, because samplers cannot be indexed on every device. Layer 0 is white.
    [[nodiscard]] VkDescriptorImageInfo cookies() const;
    /// Layer of a scene image that some light uses as a cookie; -1 for any other.
    [[nodiscard]] int cookieLayer(std::uint32_t image) const;
    [[nodiscard]] VkSampler plainSampler() const { return plain_; }     // linear, clamped, no mips
    [[nodiscard]] VkSampler nearestSampler() const { return nearest_; } // for texels as they are
    /// Clamped, of all mip levels: linear within and between them, or nearest.
    [[nodiscard]] VkSampler mipSampler(bool linear);

private:
    VkSampler sampler(const scene::Texture& texture);
    VkSampler makeSampler(VkSamplerAddressMode u, VkSamplerAddressMode v, bool magnify, bool minify, bool mips);
    Image upload(const scene::Image& source, bool srgb);
    Image uploadTexel(std::uint32_t rgba, const char* name);
    void uploadCookies();

    const Gpu& gpu_;
    Memory& memory_;
    Uploader& uploader_;
    const scene::Scene& scene_;
    std::map<std::pair<std::uint32_t, bool>, Image> images_; // by scene image and whether it is colour
    std::map<std::uint32_t, OwnedSampler> samplers_;
    std::vector<std::uint32_t> cookie_images_; // layer - 1
    Image white_;
    Image flat_;
    Image cookies_;
    VkSampler plain_ = VK_NULL_HANDLE;
    VkSampler nearest_ = VK_NULL_HANDLE;
};

} // namespace gnomon::host
