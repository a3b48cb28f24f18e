// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include "app/preset.h"
#include "command_text.h"
#include "result_json.h"
#include "shot_parts.h"

#include "files/files.h"
#include "image/image_io.h"

#include <gnomon/error.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::app::view {
namespace {

/// A window asks for one picture; what others ask for beside it does not come along.
Settings withoutTruth(Settings settings)
{
    settings.truth.reset();
    settings.values.erase("truth");
    return settings;
}

} // namespace

Viewer::Viewer(host::Gpu& gpu, const Settings& settings) : gpu_(gpu), settings_(withoutTruth(asRender(settings)))
{
    makeScenery(settings_);
    if (settings.truth) {
        beside_ = Beside::truth;
        truth_kind_ = *settings.truth;
        makeBeside();
    }
}

/// Precondition: nothing is drawn of an earlier one. A camera that was fitted to the picture's shape becomes one that
/// stays where it is when the window's shape changes.
void Viewer::makeScenery(const Settings& next)
{
    scenery_ = std::make_unique<Scenery>(gpu_, next);
    noteNotices();
    truth_ = std::make_unique<BackgroundTruth>(scenery_->shot.scene);
    settings_ = next;
    if (scenery_->shot.camera == "fitted") {
        if (Edited fixed = edited(settings_, changesTo(scenery_->shot.eye)); fixed.settings) {
            settings_ = std::move(*fixed.settings);
            scenery_->move(settings_);
        }
    }
    drawing_ = std::make_unique<Drawing>(gpu_, *scenery_, settings_);
    changed_ = true;
}

void Viewer::dropScenery()
{
    truth_.reset();
    drawing_beside_.reset();
    drawing_.reset();
    scenery_.reset();
}

bool Viewer::refuse(const std::string& why)
{
    message_ = {why, true};
    return false;
}

/// A lost device is not the viewer's to mend: it goes on to whoever has the window.
bool Viewer::refuseUnlessLost(const Error& error)
{
    if (error.kind() == ErrorKind::device_lost) {
        throw error;
    }
    return refuse(error.what());
}

Camera Viewer::camera() const
{
    return host::cameraOf(shot().eye, settings_.size_px.x, settings_.size_px.y, shot().state.bounds_ws);
}

host::Eye Viewer::aimed() const
{
    host::Eye eye = shot().eye;
    if (!shot().has_target) {
        eye.target_ws = eye.position_ws + glm::normalize(eye.target_ws - eye.position_ws) * focusOf(shot());
    }
    return eye;
}

/// Of what stands beside a picture of these settings, if anything does. Throws UsageError where the technique there
/// cannot be had with them.
std::optional<Settings> Viewer::besideOf(const Settings& settings) const
{
    if (beside_ == Beside::nothing) {
        return std::nullopt;
    }
    if (beside_ == Beside::truth) {
        Settings truth = settings;
        truth.truth = truth_kind_;
        truth.debug = "none";
        return truth;
    }
    Edited other = withTechnique(settings, technique_beside_);
    if (!other.settings) {
        throw UsageError("the technique beside: " + other.refusal);
    }
    return std::move(other.settings);
}

/// What people should know before they look, as `render` says it.
void Viewer::noteNotices()
{
    for (const std::string& text : scenery_->shot.notices) {
        message_ = {text, false};
    }
}

void Viewer::makeBeside()
{
    drawing_beside_.reset();
    truth_->stop();
    truth_shown_ = false;
    rmse_.reset();
    truth_rays_ = 0;
    if (const std::optional<Settings> beside = besideOf(settings_)) {
        drawing_beside_ = std::make_unique<Drawing>(gpu_, *scenery_, *beside);
    }
    changed_ = true;
}

/// What the settings ask for of the world: may throw after it has begun.
void Viewer::adopt(const Settings& next)
{
    if (changesScene(settings_, next)) {
        dropScenery();
        makeScenery(next);
        makeBeside();
        return;
    }
    const std::optional<Settings> beside = besideOf(next);
    scenery_->move(next);
    if (changesRenderer(settings_, next)) {
        scenery_->shot.notices.clear();
        askOfTechnique(scenery_->shot, next);
        noteNotices();
    }
    settings_ = next;
    drawing_->take(settings_);
    if (drawing_beside_ && beside_ == Beside::technique) {
        drawing_beside_->take(*beside);
    } else if (drawing_beside_) {
        makeBeside();
    }
}

bool Viewer::take(const Settings& next)
{
    const Settings before = settings_;
    try {
        adopt(next);
    } catch (const UsageError& error) {
        return goBack(before, error.what());
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::device_lost) {
            throw;
        }
        return goBack(before, error.what());
    }
    changed_ = true;
    return true;
}

/// After a change that could not be: all as it was. Throws where that cannot be either.
bool Viewer::goBack(const Settings& before, const std::string& why)
{
    drawn_ = before;
    const bool whole = scenery_ && drawing_ && !changesScene(settings_, before);
    if (whole) {
        scenery_->move(before);
        settings_ = before;
        drawing_->take(settings_);
    } else {
        dropScenery();
        makeScenery(before);
    }
    makeBeside();
    return refuse(why);
}

bool Viewer::change(const Changes& changes)
{
    Edited next = edited(settings_, changes);
    if (!next.settings) {
        return refuse(next.refusal);
    }
    if (next.settings->converge != 1) { // averaging begins again
        applySetting(*next.settings, "converge", "1");
    }
    return take(*next.settings);
}

bool Viewer::frameAll()
{
    const glm::dvec2 size(settings_.size_px);
    host::Eye eye = framedEye(shot(), shot().eye.fov_y_rad, size.x / size.y);
    if (shot().eye.height_m > 0.0) {
        eye.height_m = host::pictureHeight(eye, glm::distance(eye.position_ws, eye.target_ws));
        eye = standingBack(eye, shot().state.bounds_ws);
    }
    return look(eye);
}

bool Viewer::open(const std::string& scene)
{
    Settings next = settings_;
    next.scene = scene;
    next.scene_hash.clear();
    Edited plain = edited(next, {{"camera", ""},
                                 {"eye", ""},
                                 {"target", ""},
                                 {"up", ""},
                                 {"fov", ""},
                                 {"ortho", ""},
                                 {"sun", ""},
                                 {"spot", ""},
                                 {"point", ""},
                                 {"time", ""},
                                 {"animation", ""},
                                 {"light", ""}});
    if (!plain.settings) {
        return refuse(plain.refusal);
    }
    plain.settings->scene = scene;
    if (!take(*plain.settings)) {
        return false;
    }
    message_ = {fmt::format("{}: {} objects, camera {}", scene, shot().state.objects.size(), shot().camera), false};
    return true;
}

bool Viewer::remake()
{
    const Settings same = settings_;
    try {
        dropScenery();
        makeScenery(same);
        makeBeside();
    } catch (const UsageError& error) {
        return refuse(error.what());
    } catch (const Error& error) {
        return refuseUnlessLost(error);
    }
    return true;
}

bool Viewer::loadPreset(const std::string& name_or_file)
{
    try {
        // One that names a scene is a picture of its own; another one is a technique for this picture.
        Settings whole = defaultSettings();
        whole.subcommand = kRender;
        whole.scene.clear();
        applyPreset(whole, name_or_file, kRender);
        Settings next = whole;
        if (whole.scene.empty()) {
            next = withoutTechnique(settings_);
            applyPreset(next, name_or_file, kRender);
        }
        next = withoutTruth(next);
        applySetting(next, "size", settings_.values.at("size")); // the window's
        completeTechnique(next);
        const Edited possible = checked(next);
        if (!possible.settings) {
            return refuse(possible.refusal);
        }
        if (!take(*possible.settings)) {
            return false;
        }
    } catch (const UsageError& error) {
        return refuse(error.what());
    } catch (const Error& error) {
        return refuseUnlessLost(error);
    }
    message_ = {fmt::format("preset {}", name_or_file), false};
    return true;
}

bool Viewer::savePreset(const std::filesystem::path& file)
{
    Json json;
    json["scene"] = settings_.scene;
    const Json all = settingsJson(settings_, kRender);
    for (const auto& [key, value] : all.items()) {
        if (isUsed(*findSetting(key), settings_) && !isNotedOnly(settings_, key)) {
            json[key] = value;
        }
    }
    try {
        writeFile(file, jsonText(json));
    } catch (const Error& error) {
        return refuse(error.what());
    }
    message_ = {fmt::format("wrote {}", file.string()), false};
    return true;
}

bool Viewer::saveScreenshot(const std::filesystem::path& file)
{
    try {
        writePng(file, picture());
    } catch (const Error& error) {
        return refuseUnlessLost(error);
    }
    message_ = {fmt::format("wrote {}", file.string()), false};
    return true;
}

bool Viewer::holdAgainst(Beside beside)
{
    if (beside == beside_) {
        return true;
    }
    beside_ = beside;
    try {
        makeBeside();
    } catch (const UsageError& error) {
        beside_ = Beside::nothing;
        makeBeside();
        return refuse(error.what());
    } catch (const Error& error) {
        beside_ = Beside::nothing;
        (void)refuseUnlessLost(error);
        makeBeside();
        return false;
    }
    return true;
}

bool Viewer::setTechniqueBeside(const std::string& technique)
{
    const Edited other = withTechnique(settings_, technique);
    if (!other.settings) {
        return refuse(other.refusal);
    }
    technique_beside_ = technique;
    if (beside_ != Beside::technique) {
        return true;
    }
    beside_ = Beside::nothing; // and made anew
    return holdAgainst(Beside::technique);
}

void Viewer::setHeld(Held held)
{
    held_ = held;
    paintDifference();
}

Holding Viewer::holding() const
{
    return {beside_, held_, technique_beside_, truth_kind_};
}

void Viewer::hold(const Holding& holding)
{
    held_ = holding.held;
    technique_beside_ = holding.technique;
    truth_kind_ = holding.truth_kind;
    (void)holdAgainst(holding.beside);
}

void Viewer::setTruthKind(truth::Kind kind)
{
    if (kind != truth_kind_) {
        truth_kind_ = kind;
        if (beside_ == Beside::truth) {
            makeBeside();
        }
    }
}

std::string Viewer::command() const
{
    std::vector<std::string> words = commandWords(settings_, kRender, describeTechnique(settings_));
    words.insert(words.end(), {"-o", "picture.png"});
    return shellText(words);
}

const host::Canvas& Viewer::canvas() const
{
    const bool is_difference = held_ == Held::difference && canvasBeside() != nullptr && difference_;
    return is_difference ? *difference_ : drawing_->canvas();
}

const host::Canvas* Viewer::canvasBeside() const
{
    const bool is_there =
        drawing_beside_ && !drawing_beside_->canvas().isEmpty() && (beside_ != Beside::truth || truth_shown_);
    return is_there ? &drawing_beside_->canvas() : nullptr;
}

const host::FrameTimes* Viewer::timesBeside() const
{
    return drawing_beside_ && beside_ == Beside::technique ? &drawing_beside_->times() : nullptr;
}

} // namespace gnomon::app::view
