// SPDX-License-Identifier: Apache-2.0
#include "gl_scene.h"

#include <gnomon/pack/caster_rows.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace gnomon::test {
namespace {

// As shaders/passes/caster.vert multiplies, so that maps are the same bit for bit.
constexpr const char* kVertex = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 0) uniform vec4 rows[5]; // x, y, z, w, metric
layout(location = 0) sample out float metric;
void main()
{
    vec4 p = vec4(position, 1.0);
    precise vec4 clip;
    clip = vec4(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p), dot(rows[3], p));
    metric = dot(rows[4], p);
    gl_Position = clip;
})";
constexpr const char* kPlain = R"(#version 450
void main() {})";
constexpr const char* kMetric = R"(#version 450
layout(location = 0) sample in float metric;
void main()
{
    gl_FragDepth = clamp(metric, 0.0, 1.0);
})";
// gnomonCasterTexel() where a texel, or its half, is one number.
constexpr const char* kColour = R"(#version 450
layout(location = 0) sample in float metric;
layout(location = 0) out vec4 stored;
void main()
{
    stored = vec4(clamp(metric, 0.0, 1.0));
})";

GLuint programOf(const char* fragment)
{
    const GLuint program = glCreateProgram();
    for (const auto& [stage, text] : {std::pair(GL_VERTEX_SHADER, kVertex), std::pair(GL_FRAGMENT_SHADER, fragment)}) {
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    char log[512] = {};
    glGetProgramInfoLog(program, sizeof log, nullptr, log);
    EXPECT_EQ(good, 1) << log;
    return program;
}

template <class T>
GLuint bufferOf(const std::vector<T>& data)
{
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), 0);
    return buffer;
}

GLuint textureOf(GLenum format, GLenum channels, GLenum type, VkExtent2D size, const void* texels)
{
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    const auto width = static_cast<GLsizei>(size.width);
    const auto height = static_cast<GLsizei>(size.height);
    glTextureStorage2D(texture, 1, format, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(texture, 0, 0, 0, width, height, channels, type, texels);
    return texture;
}

} // namespace

GlScene::GlScene(Scene scene_in)
    : scene(std::move(scene_in)), programs_{programOf(kPlain), programOf(kMetric), programOf(kColour)}
{
    const TestMesh mesh = testMesh();
    glCreateVertexArrays(1, &vertices_);
    glVertexArrayVertexBuffer(vertices_, 0, bufferOf(mesh.positions), 0, sizeof(glm::vec3));
    glVertexArrayElementBuffer(vertices_, bufferOf(mesh.indices));
    glEnableVertexArrayAttrib(vertices_, 0);
    glVertexArrayAttribFormat(vertices_, 0, 3, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(vertices_, 0, 0);
}

gl::MaskInputs GlScene::upload(const Picture& picture)
{
    glDeleteTextures(1, &depth_);
    glDeleteTextures(1, &normal_);
    depth_ = textureOf(GL_R32F, GL_RED, GL_FLOAT, picture.extent, picture.depth.data());
    normal_ = textureOf(GL_RG16_SNORM, GL_RG, GL_SHORT, picture.extent, picture.octahedral.data());
    return {.size_px = {picture.extent.width, picture.extent.height}, .depth = depth_, .normal = normal_};
}

gl::DrawCasters GlScene::callback()
{
    return [this](const gl::MapPass& pass) {
        draw(pass);
    };
}

void GlScene::draw(const gl::MapPass& pass)
{
    const bool orthographic = pass.view->projection.orthographic;
    const pack::CasterRows rows(*pass.view);
    const auto transforms = scene.transforms();
    glUseProgram(programs_[pass.formats.colour != 0 ? 2 : pass.formats.write_frag_depth ? 1 : 0]);
    glBindVertexArray(vertices_);
    for (const std::uint32_t object : pass.casters) {
        std::array<glm::vec4, 5> data;
        (void)rows.write(transforms[object], data.data());
        if (orthographic) { // x, y and the metric, which is z
            data[4] = data[2];
            data[3] = {0.0F, 0.0F, 0.0F, 1.0F};
        }
        glUniform4fv(0, 5, &data[0].x);
        const bool ground = object == 0;
        const std::uintptr_t first = (ground ? 0 : 6) * sizeof(std::uint32_t); // bytes into the buffer that is bound
        glDrawElementsBaseVertex(GL_TRIANGLES, ground ? 6 : 36, GL_UNSIGNED_INT, reinterpret_cast<const void*>(first),
                                 ground ? 0 : 4);
    }
}

std::vector<std::byte> GlScene::read(const gl::TextureRef& mask, std::uint32_t layers)
{
    const bool one = mask.format == GL_R8;
    std::vector<std::byte> texels(std::size_t{mask.size_px.x} * mask.size_px.y * layers * (one ? 1 : 4));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(mask.texture, 0, 0, 0, 0, static_cast<GLsizei>(mask.size_px.x),
                         static_cast<GLsizei>(mask.size_px.y), static_cast<GLsizei>(layers), one ? GL_RED : GL_RGBA,
                         GL_UNSIGNED_BYTE, static_cast<GLsizei>(texels.size()), texels.data());
    return texels;
}

} // namespace gnomon::test
