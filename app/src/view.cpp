// SPDX-License-Identifier: Apache-2.0
// `gnomon view`: a scene in a window.
#include "streams.h"
#include "subcommands.h"
#include "view/view_window.h"

#include <gnomon/error.h>

#include <chrono>
#include <memory>

namespace gnomon::app {

int runView(const Settings& settings)
{
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds kSoon{10}; // a device that is lost again so soon will be lost once more
    Settings last = settings;
    const std::optional<view::ShaderBuild> shaders = view::findShaderBuild();
    auto window = std::make_unique<view::ViewWindow>(last, shaders);
    Clock::time_point begun = Clock::now();
    for (;;) {
        try {
            window->nap();
            if (!window->turn()) {
                return 0;
            }
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::device_lost || Clock::now() - begun < kSoon) {
                throw;
            }
            notice(std::string(error.what()) + "; the window is opened anew");
            const view::Holding holding = window->viewer().holding();
            const view::Shown shown = window->shown();
            last = window->settingsOfWindow();
            window.reset();
            window = std::make_unique<view::ViewWindow>(last, shaders);
            window->shown() = shown;
            window->viewer().hold(holding);
            window->viewer().say({"the GPU was lost, and everything was made anew", true});
            begun = Clock::now();
        }
    }
}

} // namespace gnomon::app
