// SPDX-License-Identifier: Apache-2.0
// `gnomon view`, from the window to the pixels in it, one turn at a time.
#pragma once

#include "app/settings.h"
#include "host/window/interface.h"
#include "view/map_inset.h"
#include "view/panels.h"
#include "view/pointer.h"
#include "view/shader_reload.h"

#include <chrono>
#include <memory>
#include <optional>

namespace gnomon::app::view {

class ViewWindow {
public:
    /// Opens the window, so that the picture has --size where the screen has room, and loads the scene. A software
    /// rasteriser starts at half that size, enlarged, unless the command line gave one. `shaders`: whose sources are
    /// followed, if any's are. Throws UsageError and Error.
    explicit ViewWindow(const Settings& settings, const std::optional<ShaderBuild>& shaders = std::nullopt);
    ~ViewWindow();
    ViewWindow(const ViewWindow&) = delete;
    ViewWindow& operator=(const ViewWindow&) = delete;

    /// Waits for something to be done, for a second, where nothing else is due.
    void nap();
    /// Hears what was done, changes what that changes, draws and shows. False: the window was closed. Throws Error;
    /// of the kind device_lost, and then there is nothing more to do with this window.
    bool turn();
    /// The same, and what the window shows then; empty where it shows nothing.
    [[nodiscard]] Image8 turnAndRead();

    /// Null where none are followed.
    [[nodiscard]] const ShaderReload* shaders() const { return shaders_.get(); }
    [[nodiscard]] Viewer& viewer() { return *viewer_; }
    [[nodiscard]] host::Window& window() { return window_; }
    [[nodiscard]] Widgets& widgets() { return widgets_; }
    [[nodiscard]] Shown& shown() { return shown_; }
    [[nodiscard]] Typed& typed() { return typed_; }
    /// That open a window as large as this one, with this picture.
    [[nodiscard]] Settings settingsOfWindow() const;
    [[nodiscard]] const Pointer& pointer() const { return pointer_; }
    /// Where the picture is, in pixels of the window.
    [[nodiscard]] glm::ivec2 pictureAt() const;
    [[nodiscard]] glm::uvec2 size_px() const { return interface_->size_px(); }
    /// Of the last turn, all of it but waiting for the screen.
    [[nodiscard]] double turn_ms() const { return turn_ms_; }

private:
    bool prepare();
    void followShaders(double now_s);
    void takeShaders();
    void shaderFaults();
    void build(double elapsed_s);
    void panel();
    void status();
    void overlays(bool drew);
    [[nodiscard]] host::PicturePlace insetPlace() const;
    void fitPicture();
    void retitle();
    [[nodiscard]] std::vector<host::PicturePlace> places() const;
    void addPictures(std::vector<host::PicturePlace>& places, const host::Canvas& canvas, const glm::ivec2& at) const;

    using Clock = std::chrono::steady_clock;

    // In this order: the window goes last.
    host::Window window_;
    std::unique_ptr<ShaderReload> shaders_;
    std::unique_ptr<host::Gpu> gpu_;
    std::unique_ptr<host::Interface> interface_;
    std::unique_ptr<Viewer> viewer_;
    Shown shown_;
    Typed typed_;
    Widgets widgets_;
    Pointer pointer_;
    std::optional<MapInset> inset_;
    PictureArea area_;
    std::string title_;
    bool validates_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
    double turn_ms_ = 0.0;
    int quiet_turns_ = 0;    // in which nothing was drawn
    bool is_hidden_ = false; // minimised
    std::string said_;       // the last word, and since when it stands there
    Clock::time_point said_at_;
};

} // namespace gnomon::app::view
