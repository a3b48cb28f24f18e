// SPDX-License-Identifier: Apache-2.0
#include "context.h"

#include <gnomon/error.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace gnomon::gl {

Functions loadFunctions(void* (*get_proc_address)(const char*))
{
    constexpr const char* kTried = "load the functions of OpenGL";
    if (get_proc_address == nullptr) {
        throw Error(kTried, "there is no loader", "set ShadowRendererOptions::get_proc_address");
    }
    Functions functions;
#define GNOMON_GL_LOAD(TYPE, NAME)                                                                                     \
    functions.NAME = reinterpret_cast<PFNGL##TYPE##PROC>(get_proc_address("gl" #NAME));                                \
    if (functions.NAME == nullptr) {                                                                                   \
        throw Error(kTried, "the context has no gl" #NAME, "make a context of OpenGL 4.5 or newer");                   \
    }
    GNOMON_GL_FUNCTIONS(GNOMON_GL_LOAD)
#undef GNOMON_GL_LOAD
    return functions;
}

namespace {

std::uint32_t number(const Functions& gl, GLenum name)
{
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return static_cast<std::uint32_t>(std::max(value, 0));
}

void requireLimit(const Functions& gl, GLenum name, std::uint32_t least, const char* what)
{
    const std::uint32_t found = number(gl, name);
    if (found < least) {
        throw Error("make shadow maps by OpenGL",
                    "the context allows " + std::to_string(found) + " " + what + ", and " + std::to_string(least) +
                        " are needed",
                    "take another driver, or the Vulkan backend");
    }
}

} // namespace

Context::Context(const ShadowRendererOptions& options) : gl(loadFunctions(options.get_proc_address))
{
    const std::uint32_t version = number(gl, GL_MAJOR_VERSION) * 10 + number(gl, GL_MINOR_VERSION);
    if (version < 45) {
        throw Error("make shadow maps by OpenGL",
                    "the context is OpenGL " + std::to_string(version / 10) + "." + std::to_string(version % 10),
                    "make a context of OpenGL 4.5 or newer");
    }
    requireLimit(gl, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 13, "storage buffers");
    requireLimit(gl, GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, 4, "storage buffers of a fragment shader");
    requireLimit(gl, GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 1, "storage buffers of a vertex shader");
    requireLimit(gl, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS, 256, "invocations of a group");
    const auto* renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
    const std::string_view name = renderer != nullptr ? renderer : "";
    const bool looks_so = name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos;
    in_software = options.in_software.value_or(looks_so);
    // 120 of mask_numbers.glsl; and up to 7 of gl_PerVertex.
    has_one_view = in_software && number(gl, GL_MAX_VARYING_COMPONENTS) >= 120 &&
                   number(gl, GL_MAX_VERTEX_OUTPUT_COMPONENTS) >= 127 &&
                   number(gl, GL_MAX_FRAGMENT_INPUT_COMPONENTS) >= 127;
    sub_pixel_bits = number(gl, GL_SUBPIXEL_BITS);
    most_layers = number(gl, GL_MAX_ARRAY_TEXTURE_LAYERS);
    most_texels = number(gl, GL_MAX_TEXTURE_SIZE);
    uniform_alignment = std::max(number(gl, GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT), 16U);
}

Buffer makeBuffer(const Context& context)
{
    GLuint name = 0;
    context.gl.CreateBuffers(1, &name);
    return {context, name};
}

Framebuffer makeFramebuffer(const Context& context)
{
    GLuint name = 0;
    context.gl.CreateFramebuffers(1, &name);
    return {context, name};
}

Sampler makeSampler(const Context& context, bool linear)
{
    GLuint name = 0;
    context.gl.CreateSamplers(1, &name);
    Sampler sampler(context, name);
    const auto set = [&](GLenum parameter, GLenum value) {
        context.gl.SamplerParameteri(name, parameter, static_cast<GLint>(value));
    };
    set(GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
    set(GL_TEXTURE_MIN_FILTER, linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST);
    set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return sampler;
}

bool isDepth(GLenum format)
{
    return format == GL_DEPTH_COMPONENT16 || format == GL_DEPTH_COMPONENT24 || format == GL_DEPTH_COMPONENT32F;
}

Image::Image(const Context& context, const ImageInfo& info) : info_(info)
{
    constexpr const char* kTried = "make a texture of shadow maps";
    if (std::max(info.size.x, info.size.y) > context.most_texels || info.layers > context.most_layers) {
        throw Error(kTried,
                    "it has " + std::to_string(info.size.x) + " x " + std::to_string(info.size.y) + " texels in " +
                        std::to_string(info.layers) + " layers, and the context allows " +
                        std::to_string(context.most_texels) + " and " + std::to_string(context.most_layers),
                    "choose smaller maps");
    }
    while (context.gl.GetError() != GL_NO_ERROR) {
    }
    GLuint name = 0;
    context.gl.CreateTextures(target(), 1, &name);
    texture_ = Texture(context, name);
    const auto width = static_cast<GLsizei>(info.size.x);
    const auto height = static_cast<GLsizei>(info.size.y);
    const auto layers = static_cast<GLsizei>(info.layers);
    const auto levels = static_cast<GLsizei>(info.levels);
    const auto samples = static_cast<GLsizei>(info.samples);
    if (info.samples > 1 && info.layers > 0) {
        context.gl.TextureStorage3DMultisample(name, samples, info.format, width, height, layers, GL_TRUE);
    } else if (info.samples > 1) {
        context.gl.TextureStorage2DMultisample(name, samples, info.format, width, height, GL_TRUE);
    } else if (info.layers > 0) {
        context.gl.TextureStorage3D(name, levels, info.format, width, height, layers);
    } else {
        context.gl.TextureStorage2D(name, levels, info.format, width, height);
    }
    if (const GLenum error = context.gl.GetError(); error != GL_NO_ERROR) {
        const bool memory = error == GL_OUT_OF_MEMORY;
        throw Error(kTried, memory ? "the device has no memory left" : "OpenGL says error " + std::to_string(error),
                    "choose smaller maps or another format", memory ? ErrorKind::out_of_memory : ErrorKind::other);
    }
    for (GLint level = 0; level < levels; ++level) {
        const float far = 1.0F;
        if (isDepth(info.format)) {
            context.gl.ClearTexImage(name, level, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
        } else {
            const bool whole_numbers = info.format == GL_R32UI;
            context.gl.ClearTexImage(name, level, whole_numbers ? GL_RED_INTEGER : GL_RGBA,
                                     whole_numbers ? GL_UNSIGNED_INT : GL_FLOAT, nullptr);
        }
    }
}

GLenum Image::target() const
{
    if (info_.samples > 1) {
        return info_.layers > 0 ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_MULTISAMPLE;
    }
    return info_.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
}

Texture Image::viewOfLevel(const Context& context, std::uint32_t level) const
{
    GLuint view = 0;
    context.gl.GenTextures(1, &view);
    context.gl.TextureView(view, target(), name(), info_.format, level, 1, 0, std::max(info_.layers, 1U));
    return {context, view};
}

TextureRef Image::ref() const
{
    return {name(), info_.format, info_.size, info_.layers, info_.levels};
}

void copyTexels(const Context& context, const Image& from, const Tile& area, const Image& to, const Tile& at)
{
    context.gl.CopyImageSubData(from.name(), from.target(), 0, static_cast<GLint>(area.x), static_cast<GLint>(area.y),
                                static_cast<GLint>(area.layer), to.name(), to.target(), 0, static_cast<GLint>(at.x),
                                static_cast<GLint>(at.y), static_cast<GLint>(at.layer),
                                static_cast<GLsizei>(area.width), static_cast<GLsizei>(area.height), 1);
}

void copyLevels(const Context& context, const Image& from, const Image& to)
{
    const ImageInfo& info = from.info();
    for (std::uint32_t level = 0; level < std::min(info.levels, to.info().levels); ++level) {
        context.gl.CopyImageSubData(from.name(), from.target(), static_cast<GLint>(level), 0, 0, 0, to.name(),
                                    to.target(), static_cast<GLint>(level), 0, 0, 0,
                                    static_cast<GLsizei>(std::max(info.size.x >> level, 1U)),
                                    static_cast<GLsizei>(std::max(info.size.y >> level, 1U)),
                                    static_cast<GLsizei>(std::max(info.layers, 1U)));
    }
}

void waitForShaders(const Context& context)
{
    context.gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                             GL_SHADER_STORAGE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                             GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

} // namespace gnomon::gl
