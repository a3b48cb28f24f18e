// SPDX-License-Identifier: Apache-2.0
#include "host/window/window.h"

#include <gnomon/error.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace gnomon::host {
namespace {

constexpr const char* kTried = "opening a window";

std::string lastError()
{
    const char* text = nullptr;
    (void)glfwGetError(&text);
    return text != nullptr ? text : "no reason is given";
}

/// GLFW, for as long as there is a window.
struct Desktop {
    Desktop()
    {
        if (glfwInit() != GLFW_TRUE) {
            throw Error(kTried, "there is no window system (" + lastError() + ")",
                        "run it on a desktop, or draw to a file with `gnomon render`");
        }
    }
    ~Desktop() { glfwTerminate(); }
    Desktop(const Desktop&) = delete;
    Desktop& operator=(const Desktop&) = delete;
};

/// Of the first screen what the desktop leaves to windows, in pixels; 0 where it says nothing.
glm::ivec2 workArea()
{
    int x = 0;
    int y = 0;
    glm::ivec2 size(0);
    if (GLFWmonitor* const monitor = glfwGetPrimaryMonitor(); monitor != nullptr) {
        glfwGetMonitorWorkarea(monitor, &x, &y, &size.x, &size.y);
    }
    return size;
}

/// Only a window that there is knows how large its frame and its pixels are.
void fitOnScreen(GLFWwindow* window)
{
    glm::ivec2 size(0);
    glm::ivec2 size_px(0);
    glm::ivec2 before(0);
    glm::ivec2 behind(0);
    glfwGetWindowSize(window, &size.x, &size.y);
    glfwGetFramebufferSize(window, &size_px.x, &size_px.y);
    glfwGetWindowFrameSize(window, &before.x, &before.y, &behind.x, &behind.y);
    const glm::ivec2 fitting = sizeOnScreen(size, size_px, before + behind, workArea());
    if (fitting != size) {
        glfwSetWindowSize(window, fitting.x, fitting.y);
    }
}

} // namespace

struct Window::Impl {
    Desktop desktop;
    GLFWwindow* handle = nullptr;
    std::vector<std::string> dropped;
    std::string letters;
    bool exposed = true;
    bool heard = false; // something, since listen() began

    static Impl& of(GLFWwindow* window) { return *static_cast<Impl*>(glfwGetWindowUserPointer(window)); }
    void hearAll();
    ~Impl()
    {
        if (handle != nullptr) {
            glfwDestroyWindow(handle);
        }
    }
};

glm::ivec2 sizeOnScreen(const glm::ivec2& size, const glm::ivec2& size_px, const glm::ivec2& frame,
                        const glm::ivec2& area_px)
{
    glm::ivec2 fitting = size;
    for (int axis = 0; axis < 2; ++axis) {
        if (area_px[axis] > 0 && size_px[axis] > 0) {
            const int room = static_cast<int>(std::int64_t{area_px[axis]} * size[axis] / size_px[axis]) - frame[axis];
            fitting[axis] = std::clamp(size[axis], 1, std::max(room, 1));
        }
    }
    return fitting;
}

Window::Window(const WindowOptions& options) : impl_(std::make_unique<Impl>())
{
    if (glfwVulkanSupported() != GLFW_TRUE) {
        throw Error(kTried, "Vulkan cannot draw in windows here",
                    "install the desktop's Vulkan driver, or draw to a file with `gnomon render`");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE); // until it has its size
    impl_->handle = glfwCreateWindow(static_cast<int>(options.size.x), static_cast<int>(options.size.y),
                                     options.title.c_str(), nullptr, nullptr);
    if (impl_->handle == nullptr) {
        throw Error(kTried, lastError());
    }
    fitOnScreen(impl_->handle);
    glfwSetWindowUserPointer(impl_->handle, impl_.get());
    impl_->hearAll();
    glfwShowWindow(impl_->handle);
}

/// Interface adds its own to these and calls them, too.
void Window::Impl::hearAll()
{
    glfwSetDropCallback(handle, [](GLFWwindow* window, int count, const char** paths) {
        of(window).heard = true;
        std::vector<std::string>& all = of(window).dropped;
        all.insert(all.end(), paths, paths + count);
    });
    glfwSetKeyCallback(handle, [](GLFWwindow* window, int key, int, int action, int mods) {
        of(window).heard = true;
        const bool is_plain = (mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) == 0;
        if (action == GLFW_PRESS && is_plain && key >= GLFW_KEY_A && key <= GLFW_KEY_Z) {
            of(window).letters += static_cast<char>('A' + (key - GLFW_KEY_A));
        }
    });
    glfwSetWindowRefreshCallback(handle, [](GLFWwindow* window) { of(window).heard = of(window).exposed = true; });
    glfwSetFramebufferSizeCallback(handle,
                                   [](GLFWwindow* window, int, int) { of(window).heard = of(window).exposed = true; });
    glfwSetWindowCloseCallback(handle, [](GLFWwindow* window) { of(window).heard = true; });
    glfwSetWindowFocusCallback(handle, [](GLFWwindow* window, int) { of(window).heard = true; });
    glfwSetWindowIconifyCallback(handle, [](GLFWwindow* window, int) { of(window).heard = true; });
    glfwSetCursorEnterCallback(handle, [](GLFWwindow* window, int) { of(window).heard = true; });
    glfwSetCursorPosCallback(handle, [](GLFWwindow* window, double, double) { of(window).heard = true; });
    glfwSetMouseButtonCallback(handle, [](GLFWwindow* window, int, int, int) { of(window).heard = true; });
    glfwSetScrollCallback(handle, [](GLFWwindow* window, double, double) { of(window).heard = true; });
    glfwSetCharCallback(handle, [](GLFWwindow* window, unsigned) { of(window).heard = true; });
}

Window::~Window() = default;

std::vector<const char*> Window::instanceExtensions() const
{
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

bool Window::canShow(VkInstance instance, VkPhysicalDevice device, std::uint32_t queue_family)
{
    return glfwGetPhysicalDevicePresentationSupport(instance, device, queue_family) == GLFW_TRUE;
}

VkSurfaceKHR Window::makeSurface(VkInstance instance) const
{
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(instance, impl_->handle, nullptr, &surface) != VK_SUCCESS) {
        throw Error(kTried, "Vulkan cannot draw in it (" + lastError() + ")");
    }
    return surface;
}

bool Window::listen(double seconds)
{
    impl_->heard = false;
    if (seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    return impl_->heard;
}

bool Window::isClosing() const
{
    return glfwWindowShouldClose(impl_->handle) == GLFW_TRUE;
}

glm::uvec2 Window::size_px() const
{
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(impl_->handle, &width, &height);
    const bool is_minimised = glfwGetWindowAttrib(impl_->handle, GLFW_ICONIFIED) == GLFW_TRUE;
    return is_minimised ? glm::uvec2(0) : glm::uvec2(std::max(width, 0), std::max(height, 0));
}

double Window::contentScale() const
{
    float x = 1.0F;
    float y = 1.0F;
    glfwGetWindowContentScale(impl_->handle, &x, &y);
    constexpr float kLeast = 0.5F; // what a desktop without a notion of it says may be anything
    constexpr float kMost = 4.0F;
    return x >= kLeast && x <= kMost ? static_cast<double>(x) : 1.0;
}

void Window::setTitle(const std::string& title)
{
    glfwSetWindowTitle(impl_->handle, title.c_str());
}

void Window::resize(glm::uvec2 size)
{
    assert(size.x > 0 && size.y > 0);
    glfwSetWindowSize(impl_->handle, static_cast<int>(size.x), static_cast<int>(size.y));
}

std::vector<std::string> Window::takeDropped()
{
    return std::exchange(impl_->dropped, {});
}

std::string Window::takeLetters()
{
    return std::exchange(impl_->letters, {});
}

bool Window::takeExposed()
{
    return std::exchange(impl_->exposed, false);
}

void Window::toClipboard(const std::string& text)
{
    glfwSetClipboardString(impl_->handle, text.c_str());
}

std::string Window::clipboard() const
{
    const char* const text = glfwGetClipboardString(impl_->handle);
    return text != nullptr ? text : "";
}

GLFWwindow* Window::handle() const
{
    return impl_->handle;
}

} // namespace gnomon::host
