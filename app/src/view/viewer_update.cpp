// SPDX-License-Identifier: Apache-2.0
// What a viewer draws, and when: at once while something moves, as `render` draws once nothing does, and more rays for
// as long as it rests.
#include "app/scripted_path.h"
#include "lab/compare.h"
#include "streams.h"
#include "view/viewer.h"

#include <gnomon/error.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gnomon::app::view {
namespace {

constexpr double kRest_s = 0.12;             // after which a picture that nobody moves is drawn as `render` draws it
constexpr std::uint32_t kMostAveraged = 256; // frames at rest of soften converge, and more change nothing that is seen
constexpr double kTick_s = 0.001;            // the scene's time goes in whole ones, so that it can be written down

/// How far the first is from the second in each channel, enlarged so that a small difference is seen: black is none.
Image8 differenceOf(const Image8& first, const Image8& second)
{
    constexpr int kGain = 4;
    Image8 difference(first.width, first.height, 3);
    std::transform(first.values.begin(), first.values.end(), second.values.begin(), difference.values.begin(),
                   [](std::uint8_t a, std::uint8_t b) {
                       return static_cast<std::uint8_t>(std::min(255, kGain * std::abs(int{a} - int{b})));
                   });
    return difference;
}

} // namespace

/// Will more frames at rest make the picture smoother?
bool Viewer::averages() const
{
    return settings_.shadow.technique.soften == Soften::converge && settings_.converge < kMostAveraged &&
           settings_.debug == "none";
}

bool Viewer::restsBeside() const
{
    switch (beside_) {
    case Beside::technique:
        return drawing_beside_ && drawing_beside_->isStill();
    case Beside::truth:
        return truth_done_;
    case Beside::nothing:
        break;
    }
    return true;
}

bool Viewer::isAtRest() const
{
    return !changed_ && drawing_->isStill() && restsBeside() && !averages();
}

void Viewer::passTime(double elapsed_s)
{
    const double time_s = std::round((settings_.time_s + elapsed_s) / kTick_s) * kTick_s;
    const bool wraps = !(time_s < findSetting("time")->max);
    if (!change({{"time", wraps ? "0" : fmt::format("{}", time_s)}})) {
        plays_ = false;
    }
}

void Viewer::passSun(double elapsed_s)
{
    const host::ShadedLight* const sun = sunOf(shot());
    if (sun == nullptr) {
        moveSun(false);
        (void)refuse("there is no sun that could move");
        return;
    }
    const auto set = settings_.values.find("sun");
    if (course_->at.empty() || set == settings_.values.end() || course_->at != set->second) {
        course_ = SunCourse{glm::normalize(sun->caster.direction_ws), 0.0, ""};
    }
    course_->angle_rad += glm::radians(kSunDeg) * elapsed_s;
    course_->at = textOf(sunAt(course_->noon_ws, course_->angle_rad));
    if (!change({{"sun", course_->at}})) {
        moveSun(false);
    }
}

void Viewer::drawBoth(bool still)
{
    const auto draw = [still](Drawing& drawing) {
        still ? drawing.drawStill() : drawing.draw();
    };
    draw(*drawing_);
    if (drawing_beside_ && beside_ == Beside::technique) {
        draw(*drawing_beside_);
        paintDifference();
    }
    pacing_.push(drawing_->times().frame_ms);
}

void Viewer::paintDifference()
{
    if (held_ != Held::difference || !drawing_beside_) {
        return;
    }
    const Image8 first = drawing_->picture();
    const Image8 second = drawing_beside_->picture();
    if (first.width == second.width && first.height == second.height) {
        if (!difference_) {
            difference_.emplace(gpu_);
        }
        difference_->paint(differenceOf(first, second));
    }
}

void Viewer::judge(const BackgroundTruth::Level& level)
{
    rmse_.reset();
    if (!level.judged) {
        return;
    }
    const std::size_t light = lightIndex(shot(), settings_);
    const lab::Subject subject{&shot().scene, &shot().state, shot().eye, shot().lights,
                               static_cast<std::uint32_t>(light)};
    const lab::Score score = lab::scoreTechnique(scenery_->on_gpu, subject, *level.judged, renderOptions(settings_),
                                                 false, settings_.converge);
    if (score.error) {
        rmse_ = score.error->rmse;
    }
}

/// Begins to trace once the picture rests, and shows what has come of it.
bool Viewer::followTruth()
{
    if (truth_wanted_) {
        truth_wanted_ = false;
        truth_->begin(shot(), drawing_beside_->settings(), lightIndex(shot(), settings_));
        return false;
    }
    if (const std::string fault = truth_->fault(); !fault.empty()) {
        truth_->stop();
        truth_done_ = true;
        message_ = {fault, true};
    }
    const std::optional<BackgroundTruth::Level> level = truth_->take();
    if (!level) {
        return false;
    }
    drawing_beside_->drawWith(level->masks);
    truth_shown_ = true;
    truth_rays_ = level->rays;
    truth_done_ = level->is_last;
    judge(*level);
    paintDifference();
    return true;
}

/// Everything moved: what was traced is of another picture.
void Viewer::forgetTruth()
{
    if (beside_ == Beside::truth) {
        truth_->stop();
        truth_shown_ = false;
        truth_done_ = false;
        truth_rays_ = 0;
        truth_wanted_ = true;
        rmse_.reset();
    }
}

bool Viewer::drawDue(double now_s)
{
    if (changed_) {
        changed_ = false;
        changed_s_ = now_s;
        forgetTruth();
        drawBoth(false);
        drawn_ = settings_;
        return true;
    }
    if (now_s - changed_s_ < kRest_s) {
        return false;
    }
    if (!drawing_->isStill() || (beside_ == Beside::technique && !restsBeside())) {
        drawBoth(true);
        return true;
    }
    if (averages()) {
        drawing_->drawOnce();
        applySetting(settings_, "converge", fmt::format("{}", settings_.converge + 1));
        pacing_.push(drawing_->times().frame_ms);
        paintDifference();
        return true;
    }
    return beside_ == Beside::truth && !truth_done_ && followTruth();
}

bool Viewer::update(double now_s)
{
    const NoNotices quiet; // a window says what it has to say itself
    const double elapsed_s = std::clamp(now_s - last_s_, 0.0, 0.25);
    last_s_ = now_s;
    if (plays_) {
        passTime(elapsed_s);
    }
    if (course_) {
        passSun(elapsed_s);
    }
    try {
        return drawDue(now_s);
    } catch (const UsageError& error) {
        return refuseAndGoBack(error.what());
    } catch (const Error& error) {
        (void)refuseUnlessLost(error);
        return refuseAndGoBack(error.what());
    }
}

/// What cannot be drawn is not kept: the settings of the last picture are taken again, if it was drawn by others.
bool Viewer::refuseAndGoBack(const std::string& why)
{
    const bool has_drawn_others = drawn_.values != settings_.values || drawn_.scene != settings_.scene;
    if (!drawn_.values.empty() && has_drawn_others) {
        const Settings last = drawn_;
        return goBack(last, why);
    }
    return refuse(why);
}

} // namespace gnomon::app::view
