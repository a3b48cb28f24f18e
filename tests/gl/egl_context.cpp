// SPDX-License-Identifier: Apache-2.0
#include "egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace gnomon::test {
namespace {

void APIENTRY hear(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                   const void* user)
{
    const bool wrong =
        type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR || severity == GL_DEBUG_SEVERITY_HIGH;
    // Mesa's compiler warns of every variable that it cannot prove to be written, and takes that for high severity.
    const bool guess = source == GL_DEBUG_SOURCE_SHADER_COMPILER && type != GL_DEBUG_TYPE_ERROR;
    if (wrong && !guess) {
        static_cast<EglContext*>(const_cast<void*>(user))->add(message);
    }
}

} // namespace

EglContext& EglContext::instance()
{
    static EglContext context;
    return context;
}

EglContext::EglContext()
{
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1); // as the Vulkan side draws
    EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
        missing_ = "EGL has no display without a window (EGL_MESA_platform_surfaceless; Debian: libgl1-mesa-dri)";
        return;
    }
    eglBindAPI(EGL_OPENGL_API);
    constexpr EGLint kAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                      4,
                                      EGL_CONTEXT_MINOR_VERSION,
                                      5,
                                      EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                      EGL_CONTEXT_OPENGL_DEBUG,
                                      EGL_TRUE,
                                      EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes);
    if (context == EGL_NO_CONTEXT || eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        missing_ = "EGL makes no context of OpenGL 4.5 without a surface (Debian: libgl1-mesa-dri)";
        return;
    }
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(hear, this);
}

void* EglContext::function(const char* name)
{
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

void EglContext::expectSilence()
{
    for (const std::string& message : messages_) {
        ADD_FAILURE() << "OpenGL: " << message;
    }
    messages_.clear();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

} // namespace gnomon::test
