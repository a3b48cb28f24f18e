// SPDX-License-Identifier: Apache-2.0
// What the window shows and how it got there, without the window: settings that are changed, pictures that follow.
#pragma once

#include "view/background_truth.h"
#include "view/drawing.h"
#include "view/edits.h"

#include <gnomon/error.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app::view {

/// What the picture is held against.
enum class Beside : std::uint8_t { nothing, technique, truth };
/// How: at the divider one gives way to the other; or their difference is painted.
enum class Held : std::uint8_t { split, difference };

/// What stands beside a picture, and how.
struct Holding {
    Beside beside = Beside::nothing;
    Held held = Held::split;
    std::string technique = "hard";
    truth::Kind truth_kind = truth::Kind::area;
};

/// A line for the person, and whether it is about something that cannot be.
struct Message {
    std::string text;
    bool is_refusal = false;
};

/// Times of the last frames, for a graph that rolls.
struct Pacing {
    static constexpr std::size_t kFrames = 240;
    std::array<float, kFrames> ms{};
    std::size_t next = 0;
    void push(double frame_ms)
    {
        ms[next] = static_cast<float>(frame_ms);
        next = (next + 1) % kFrames;
    }
};

/// The sun on its way (sunAt()): from where it stood, and how far.
struct SunCourse {
    glm::dvec3 noon_ws{0.0, -1.0, 0.0};
    double angle_rad = 0.0;
    std::string at; // --sun as it was set last; another one begins a new course
};

class Viewer {
public:
    /// Loads the scene. Throws as makeShot() does, and Error.
    Viewer(host::Gpu& gpu, const Settings& settings);

    /// Of the picture, as `render` has them.
    [[nodiscard]] const Settings& settings() const { return settings_; }
    [[nodiscard]] const Shot& shot() const { return scenery_->shot; }
    [[nodiscard]] host::Gpu& gpu() const { return gpu_; }
    /// The eye, with a target that is a place: where a camera has but a direction, as far away as the middle of the
    /// scene.
    [[nodiscard]] host::Eye aimed() const;
    /// That of the picture.
    [[nodiscard]] Camera camera() const;

    // Changes. False: it cannot be, and message() says why; all is as before.
    bool change(const Changes& changes);
    bool look(const host::Eye& eye) { return change(changesTo(eye)); }
    /// From where all of the scene is in the picture.
    bool frameAll();
    /// A file or the name of a built-in world; camera, lights and time are its own from then on.
    bool open(const std::string& scene);
    /// Everything anew, by the same settings. False: it cannot be, message() says why, and there is nothing to draw
    /// until it could.
    bool remake();
    /// A built-in preset's name or a file.
    bool loadPreset(const std::string& name_or_file);
    /// What `--preset` takes to draw the same.
    bool savePreset(const std::filesystem::path& file);
    /// What the picture shows, as `render` writes it; nothing else of the window.
    bool saveScreenshot(const std::filesystem::path& file);
    bool holdAgainst(Beside beside);
    bool setTechniqueBeside(const std::string& technique);
    void setHeld(Held held);
    void setTruthKind(truth::Kind kind);
    /// All of it, for another viewer that is to show the same.
    [[nodiscard]] Holding holding() const;
    void hold(const Holding& holding);

    [[nodiscard]] Beside beside() const { return beside_; }
    [[nodiscard]] Held held() const { return held_; }
    [[nodiscard]] const std::string& techniqueBeside() const { return technique_beside_; }
    [[nodiscard]] truth::Kind truthKind() const { return truth_kind_; }
    void play(bool plays) { plays_ = plays; }
    [[nodiscard]] bool plays() const { return plays_; }
    /// The sun goes on by itself, a day in two minutes, as by `--path day`. Where it stands is its noon.
    void moveSun(bool moves) { course_ = moves ? std::optional(SunCourse()) : std::nullopt; }
    [[nodiscard]] bool movesSun() const { return course_.has_value(); }

    /// The shell command that draws what the picture shows.
    [[nodiscard]] std::string command() const;
    [[nodiscard]] const Message& message() const { return message_; }
    void say(Message message) { message_ = std::move(message); }
    /// Of the light that is looked at, against as many rays as there are yet; nothing while that is not known.
    [[nodiscard]] std::optional<double> rmse() const { return rmse_; }
    [[nodiscard]] std::uint32_t truthRays() const { return truth_rays_; } // per pixel; 0: none yet
    [[nodiscard]] bool isTruthDone() const { return truth_done_; }

    /// Draws what is due at a moment in seconds, any clock's. True: something was drawn.
    bool update(double now_s);
    /// Nothing moves, and all that is to be seen is as `render` draws it.
    [[nodiscard]] bool isAtRest() const;
    /// Will there be anything to draw though nobody does anything?
    [[nodiscard]] bool isBusy() const { return plays_ || movesSun() || !isAtRest(); }

    /// Both of the picture's size; the second one null while there is nothing to show beside it. The first is the
    /// difference of both where that is wanted.
    [[nodiscard]] const host::Canvas& canvas() const;
    [[nodiscard]] const host::Canvas* canvasBeside() const;
    [[nodiscard]] const host::FrameTimes& times() const { return drawing_->times(); }
    [[nodiscard]] const host::FrameTimes* timesBeside() const;
    [[nodiscard]] const Pacing& pacing() const { return pacing_; }
    /// Its plan and memory; for panels.
    [[nodiscard]] host::FrameRenderer& renderer() { return drawing_->renderer(); }
    /// Its picture as `render` writes it.
    [[nodiscard]] Image8 picture() { return drawing_->picture(); }

private:
    bool take(const Settings& next);
    void adopt(const Settings& next);
    bool goBack(const Settings& before, const std::string& why);
    bool refuse(const std::string& why);
    void makeScenery(const Settings& next);
    void dropScenery();
    void makeBeside();
    void passTime(double elapsed_s);
    void passSun(double elapsed_s);
    bool drawDue(double now_s);
    void drawBoth(bool still);
    [[nodiscard]] bool averages() const;
    [[nodiscard]] bool restsBeside() const;
    void forgetTruth();
    bool followTruth();
    void judge(const BackgroundTruth::Level& level);
    void paintDifference();
    [[nodiscard]] std::optional<Settings> besideOf(const Settings& settings) const;
    void noteNotices();
    bool refuseUnlessLost(const Error& error);
    bool refuseAndGoBack(const std::string& why);

    host::Gpu& gpu_;
    Settings settings_;
    Settings drawn_;                   // by which the last picture was drawn
    std::unique_ptr<Scenery> scenery_; // before all that draws it
    std::unique_ptr<Drawing> drawing_;
    Beside beside_ = Beside::nothing;
    Held held_ = Held::split;
    std::string technique_beside_ = "hard";
    truth::Kind truth_kind_ = truth::Kind::area;
    std::unique_ptr<Drawing> drawing_beside_;
    std::unique_ptr<BackgroundTruth> truth_;
    bool truth_wanted_ = false; // of what is shown now, and not begun
    bool truth_shown_ = false;
    bool truth_done_ = false;
    std::uint32_t truth_rays_ = 0;
    std::optional<double> rmse_;
    std::optional<host::Canvas> difference_;
    bool plays_ = false;
    std::optional<SunCourse> course_;
    double last_s_ = 0.0;    // update()
    double changed_s_ = 0.0; // the last change, at an update()
    bool changed_ = true;    // since the last picture
    Pacing pacing_;
    Message message_;
};

} // namespace gnomon::app::view
