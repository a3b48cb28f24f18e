// SPDX-License-Identifier: Apache-2.0
#include "desktop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/extensions/XTest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::test {

struct Desktop::Impl {
    pid_t server = -1;
    Display* display = nullptr;

    ~Impl()
    {
        if (display != nullptr) {
            XCloseDisplay(display);
        }
        if (server > 0) {
            kill(server, SIGTERM);
            waitpid(server, nullptr, 0);
        }
        unsetenv("DISPLAY");
    }
};

namespace {

/// The number of a display that Xvfb has found to be free, by a pipe; empty where it does not start.
std::string startServer(pid_t& server)
{
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) {
        throw std::runtime_error("no pipe");
    }
    server = fork();
    if (server == 0) {
        close(ends[0]);
        const int quiet = ::open("/dev/null", O_RDWR);
        dup2(quiet, 1);
        dup2(quiet, 2);
        const std::string fd = std::to_string(ends[1]);
        const std::string screen = std::to_string(kScreen_px.x) + "x" + std::to_string(kScreen_px.y) + "x24";
        execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", screen.c_str(), "-nolisten", "tcp",
               static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[1]);
    std::string number;
    char letter = 0;
    while (read(ends[0], &letter, 1) == 1 && letter != '\n') {
        number += letter;
    }
    close(ends[0]);
    return number;
}

} // namespace

std::unique_ptr<Desktop> Desktop::open()
{
    std::unique_ptr<Desktop> desktop(new Desktop());
    desktop->impl_ = std::make_unique<Impl>();
    const std::string number = startServer(desktop->impl_->server);
    if (number.empty()) {
        return nullptr;
    }
    setenv("DISPLAY", (":" + number).c_str(), 1);
    desktop->impl_->display = XOpenDisplay(nullptr);
    return desktop->impl_->display != nullptr ? std::move(desktop) : nullptr;
}

Desktop::~Desktop() = default;

void Desktop::setDensity(int dpi)
{
    const std::string resources = "Xft.dpi:\t" + std::to_string(dpi) + "\n"; // as desktops say it
    XChangeProperty(impl_->display, DefaultRootWindow(impl_->display), XA_RESOURCE_MANAGER, XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(resources.data()),
                    static_cast<int>(resources.size()));
    XSync(impl_->display, False);
}

void Desktop::point(const glm::dvec2& at)
{
    XTestFakeMotionEvent(impl_->display, -1, static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)),
                         0);
    XSync(impl_->display, False);
}

void Desktop::press(int button)
{
    XTestFakeButtonEvent(impl_->display, static_cast<unsigned>(button), True, 0);
    XSync(impl_->display, False);
}

void Desktop::release(int button)
{
    XTestFakeButtonEvent(impl_->display, static_cast<unsigned>(button), False, 0);
    XSync(impl_->display, False);
}

void Desktop::key(std::string_view name, bool down)
{
    const KeyCode code = XKeysymToKeycode(impl_->display, XStringToKeysym(std::string(name).c_str()));
    XTestFakeKeyEvent(impl_->display, code, down ? True : False, 0);
    XSync(impl_->display, False);
}

} // namespace gnomon::test
