// SPDX-License-Identifier: Apache-2.0
// The least that a renderer by OpenGL needs to get soft-shadow masks from Gnomon: it owns its context, its frame loop
// and its depth prepass, and hands Gnomon a frame and a way to draw. Usage: gl_host FOLDER. Writes the masks of a sun
// and a spot light there as PGM; exits with 1 if they are not as the scene's geometry says, and with 77 where EGL makes
// no context of OpenGL 4.5 without a window.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <gnomon/gl/shadow_renderer.h>
#include <gnomon/pack/caster_rows.h>
#include <gnomon/planner.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

namespace {

constexpr glm::uvec2 kSize{640, 400};
constexpr int kFrames = 6;
int messages = 0;

// ---- The context. Its errors are counted.

bool makeContext()
{
    const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        return false;
    }
    eglBindAPI(EGL_OPENGL_API);
    constexpr EGLint kWanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_CONTEXT_OPENGL_DEBUG,
                                  EGL_TRUE,
                                  EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kWanted);
    if (context == EGL_NO_CONTEXT || eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        return false;
    }
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void*) {
            if (type == GL_DEBUG_TYPE_ERROR) {
                std::printf("OpenGL: %s\n", text);
                ++messages;
            }
        },
        nullptr);
    return true;
}

// ---- The scene: boxes on and over a ground (object 0, a box too), a sun and a spot light.

struct Scene {
    std::array<glm::vec3, 4> centres{{{0, -0.5F, 0}, {0, 1, 0}, {-3, 0.75F, 2}, {2.5F, 3, 1}}};
    std::array<glm::vec3, 4> halves{{{20, 0.5F, 20}, {1, 1, 1}, {0.5F, 0.75F, 0.5F}, {1, 0.1F, 1}}};
    std::array<gnomon::pack::Rows3x4, 4> world_from_object{};
    gnomon::ObjectSet objects;
    std::array<gnomon::Light, 2> lights{};
    gnomon::Frame frame;

    Scene()
    {
        for (std::size_t i = 0; i < centres.size(); ++i) {
            const glm::vec3 c = centres[i];
            const glm::vec3 h = halves[i];
            world_from_object[i] = {{h.x, 0, 0, c.x}, {0, h.y, 0, c.y}, {0, 0, h.z, c.z}};
            objects.add({c - h, c + h});
        }
        lights[0].direction_ws = glm::normalize(glm::dvec3(0.8, -1.0, 0.3));
        lights[1].key = 1;
        lights[1].type = gnomon::LightType::spot;
        lights[1].position_ws = {4.0, 7.0, -5.0};
        lights[1].direction_ws = glm::normalize(glm::dvec3(0.0) - lights[1].position_ws);
        lights[1].outer_half_angle_rad = 0.6;
        lights[1].range_m = 30.0;
        const glm::dvec3 eye(3.0, 9.0, 11.0);
        // Far and near swapped: reversed depth, by glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE). y is up, as ever.
        const glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.8, double(kSize.x) / kSize.y, 100.0, 0.1);
        frame.camera.eye_ws = eye;
        frame.camera.clip_from_world = clip_from_view * glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0, 1, 0));
        frame.size_px = kSize;
        frame.lights = lights;
        frame.objects = &objects;
    }
};

// ---- One program for all: rows that take an object's own points to clip space, and to the map's metric.

constexpr const char* kVertex = R"(#version 450
layout(location = 0) uniform vec4 rows[5]; // x, y, z, w, metric
layout(location = 0) sample out float metric;
const int kFaces[36] = int[36](0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6);
void main()
{
    int corner = kFaces[gl_VertexID];
    vec4 p = vec4(ivec3(corner, corner >> 1, corner >> 2) & 1, 1.0) * 2.0 - 1.0;
    p.w = 1.0;
    metric = dot(rows[4], p);
    gl_Position = vec4(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p), dot(rows[3], p));
})";
constexpr const char* kMetric = R"(#version 450
layout(location = 0) sample in float metric;
void main() { gl_FragDepth = clamp(metric, 0.0, 1.0); })";

GLuint makeProgram(const char* fragment)
{
    const GLuint program = glCreateProgram();
    const auto add = [&](GLenum stage, const char* text) {
        const GLuint shader = glCreateShader(stage);
        glShaderSource(shader, 1, &text, nullptr);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    };
    add(GL_VERTEX_SHADER, kVertex);
    add(GL_FRAGMENT_SHADER, fragment);
    glLinkProgram(program);
    return program;
}

struct Drawer {
    const Scene& scene;
    GLuint plain = makeProgram("#version 450\nvoid main() {}");
    GLuint metric = makeProgram(kMetric);
    GLuint no_vertices = 0;

    explicit Drawer(const Scene& of) : scene(of) { glCreateVertexArrays(1, &no_vertices); }

    void drawBox(const std::array<glm::vec4, 5>& rows) const
    {
        glUniform4fv(0, 5, &rows[0].x);
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
    void drawMap(const gnomon::gl::MapPass& pass) const
    {
        const gnomon::pack::CasterRows of_view(*pass.view);
        glUseProgram(pass.formats.write_frag_depth ? metric : plain);
        glBindVertexArray(no_vertices);
        for (const std::uint32_t object : pass.casters) {
            std::array<glm::vec4, 5> rows;
            of_view.write(scene.world_from_object[object], rows.data());
            if (pass.view->projection.orthographic) { // three rows: x, y and the metric, which is z
                rows[3] = {0.0F, 0.0F, 0.0F, 1.0F};
                rows[4] = rows[2];
            }
            drawBox(rows);
        }
    }
    void drawPicture() const
    {
        glUseProgram(plain);
        glBindVertexArray(no_vertices);
        for (std::size_t i = 0; i < scene.centres.size(); ++i) {
            const glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(scene.centres[i]));
            const glm::mat4 rows(
                glm::transpose(scene.frame.camera.clip_from_world * glm::scale(place, glm::dvec3(scene.halves[i]))));
            drawBox({rows[0], rows[1], rows[2], rows[3], {}});
        }
    }
};

// ---- The host's own depth prepass.

struct Prepass {
    GLuint depth = 0;
    GLuint framebuffer = 0;

    Prepass()
    {
        glCreateTextures(GL_TEXTURE_2D, 1, &depth);
        glTextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, GLsizei{kSize.x}, GLsizei{kSize.y});
        glCreateFramebuffers(1, &framebuffer);
        glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
    }
    void draw(const Drawer& drawer) const
    {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glViewport(0, 0, GLsizei{kSize.x}, GLsizei{kSize.y});
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glClearDepth(0.0); // far, as depth is reversed
        glClear(GL_DEPTH_BUFFER_BIT);
        drawer.drawPicture();
    }
};

// ---- The masks, read back and judged. Row 0 is the lowest.

int visibilityAt(const Scene& scene, const std::vector<std::uint8_t>& mask, std::size_t light, glm::dvec3 p)
{
    const glm::dvec4 clip = scene.frame.camera.clip_from_world * glm::dvec4(p, 1.0);
    const auto x = static_cast<std::size_t>((clip.x / clip.w * 0.5 + 0.5) * kSize.x);
    const auto y = static_cast<std::size_t>((clip.y / clip.w * 0.5 + 0.5) * kSize.y);
    return mask[(y * kSize.x + x) * 4 + light]; // two lights: LightPlan::mask_layer 0, mask_channel as they come
}

// Points on the ground that boxes hide from a light, and points that they do not.
bool isAsExpected(const Scene& scene, const std::vector<std::uint8_t>& mask)
{
    const auto behind = [&](std::size_t light, glm::dvec3 p) { // follows light through p down to the ground
        const glm::dvec3 d = light == 0 ? scene.lights[0].direction_ws : p - scene.lights[1].position_ws;
        return p - d * (p.y / d.y);
    };
    const glm::dvec3 plate(2.5, 3.0, 1.0);
    bool good = true;
    for (std::size_t light = 0; light < 2; ++light) {
        good &= visibilityAt(scene, mask, light, behind(light, plate)) == 0;
        good &= visibilityAt(scene, mask, light, behind(light, plate - glm::dvec3(1.3, 0.0, 0.5))) == 255;
        good &= visibilityAt(scene, mask, light, behind(light, {0.0, 1.0, 0.9})) == 0;
        good &= visibilityAt(scene, mask, light, {-4.5, 0.0, -2.0}) == 255;
        good &= visibilityAt(scene, mask, light, {-8.0, 0.0, -8.0}) == 255; // outside the spot's cone
    }
    return good;
}

void write(const std::string& path, const std::vector<std::uint8_t>& mask, std::size_t channel)
{
    std::ofstream out(path, std::ios::binary);
    out << "P5\n" << kSize.x << ' ' << kSize.y << "\n255\n";
    for (std::size_t y = kSize.y; y-- > 0;) { // files have the highest row first
        for (std::size_t x = 0; x < kSize.x; ++x) {
            out.put(static_cast<char>(mask[(y * kSize.x + x) * 4 + channel]));
        }
    }
}

int run(const std::string& folder)
{
    if (!makeContext()) {
        std::fprintf(stderr, "gl_host: EGL makes no context of OpenGL 4.5 without a window\n");
        return 77;
    }
    Scene scene;
    const Drawer drawer(scene);
    const Prepass prepass;
    gnomon::Planner planner; // partition, fit, filter and bias are automatic
    gnomon::gl::ShadowRenderer shadows(
        {[](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); }, {}});
    for (int i = 0; i < kFrames; ++i) {
        const gnomon::Plan& plan = planner.plan(scene.frame);
        shadows.prepare(plan, kSize);
        prepass.draw(drawer);
        shadows.drawMaps(plan, [&](const gnomon::gl::MapPass& pass) { drawer.drawMap(pass); });
        shadows.drawMask(plan, {.size_px = kSize, .depth = prepass.depth});
        // Here a renderer would shade with shadows.mask(); this one reads the last frame's back.
    }
    std::vector<std::uint8_t> mask(std::size_t{4} * kSize.x * kSize.y);
    glGetTextureImage(shadows.mask().texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(mask.size()),
                      mask.data());
    write(folder + "/gl_sun.pgm", mask, 0);
    write(folder + "/gl_spot.pgm", mask, 1);
    return isAsExpected(scene, mask) && messages == 0 ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc > 1 ? argv[1] : ".");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gl_host: %s\n", error.what());
        return 1;
    }
}
