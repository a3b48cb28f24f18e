// SPDX-License-Identifier: Apache-2.0
// The context's functions and limits, and its objects: each is deleted with what holds it.
#pragma once

#include "functions.h"

#include <gnomon/gl/shadow_renderer.h>

#include <cstddef>
#include <span>
#include <utility>

namespace gnomon::gl {

struct Context {
    explicit Context(const ShadowRendererOptions& options);

    Functions gl;
    bool in_software = false;
    bool has_one_view = false; // the vertex shader may hand on all numbers of a view
    std::uint32_t sub_pixel_bits = 4;
    std::uint32_t most_layers = 0;
    std::uint32_t most_texels = 0; // along a side
    std::uint32_t uniform_alignment = 256;
};

/// An object with a name that `kDelete` deletes.
template <auto kDelete> class Object {
public:
    Object() = default;
    Object(const Context& context, GLuint name) : context_(&context), name_(name) {}
    Object(Object&& other) noexcept { *this = std::move(other); }
    Object& operator=(Object&& other) noexcept
    {
        std::swap(context_, other.context_);
        std::swap(name_, other.name_);
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object()
    {
        if (name_ != 0) {
            if constexpr (kIsProgram) {
                (context_->gl.*kDelete)(name_);
            } else {
                (context_->gl.*kDelete)(1, &name_);
            }
        }
    }

    [[nodiscard]] GLuint name() const { return name_; }
    [[nodiscard]] explicit operator bool() const { return name_ != 0; }

private:
    static constexpr bool kIsProgram = std::is_same_v<decltype(kDelete), PFNGLDELETEPROGRAMPROC Functions::*>;
    const Context* context_ = nullptr;
    GLuint name_ = 0;
};
using Texture = Object<&Functions::DeleteTextures>;
using Buffer = Object<&Functions::DeleteBuffers>;
using Framebuffer = Object<&Functions::DeleteFramebuffers>;
using Sampler = Object<&Functions::DeleteSamplers>;
using VertexArray = Object<&Functions::DeleteVertexArrays>;
using Program = Object<&Functions::DeleteProgram>;

[[nodiscard]] Buffer makeBuffer(const Context& context);
[[nodiscard]] Framebuffer makeFramebuffer(const Context& context);
/// Clamped to the edge; linear within and between levels, or nearest.
[[nodiscard]] Sampler makeSampler(const Context& context, bool linear);

struct ImageInfo {
    GLenum format = 0;
    glm::uvec2 size{0};
    std::uint32_t layers = 1; // 0: no array
    std::uint32_t levels = 1;
    std::uint32_t samples = 1;

    bool operator==(const ImageInfo&) const = default;
};

/// A texture, cleared to zeros, or to 1 where it has a depth format.
class Image {
public:
    Image() = default;
    /// Throws Error for sizes beyond the limits, and where memory is gone.
    Image(const Context& context, const ImageInfo& info);

    [[nodiscard]] GLuint name() const { return texture_.name(); }
    [[nodiscard]] const ImageInfo& info() const { return info_; }
    [[nodiscard]] GLenum target() const;
    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(texture_); }
    /// All of one level, as level 0 of a texture.
    [[nodiscard]] Texture viewOfLevel(const Context& context, std::uint32_t level) const;
    [[nodiscard]] TextureRef ref() const;

private:
    Texture texture_;
    ImageInfo info_;
};

[[nodiscard]] bool isDepth(GLenum format);
/// A rectangle of a layer to another layer, `to` with its own offset.
void copyTexels(const Context& context, const Image& from, const Tile& area, const Image& to, const Tile& at);
/// All texels of an image to one of the same format that is no smaller, as far as both have levels.
void copyLevels(const Context& context, const Image& from, const Image& to);

/// Uploads to a buffer, which gets this size.
template <class T> void upload(const Context& context, const Buffer& buffer, std::span<const T> data)
{
    context.gl.NamedBufferData(buffer.name(), static_cast<GLsizeiptr>(data.size_bytes()), data.data(), GL_STREAM_DRAW);
}

/// Makes writes of shaders visible to all that this backend does next.
void waitForShaders(const Context& context);

} // namespace gnomon::gl
