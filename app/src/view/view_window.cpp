// SPDX-License-Identifier: Apache-2.0
#include "view/view_window.h"

#include "app/visual.h"
#include "interrupt.h"
#include "view/overlays.h"

#include <gnomon/error.h>

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace gnomon::app::view {
namespace {

// A widget needs a few turns to follow what was done; after them the window waits for more.
constexpr int kQuietTurns = 4;
constexpr double kNap_s = 0.1; // between two looks for an interrupt
constexpr int kNaps = 10;      // and then a turn all the same: a word that has stood long enough goes

/// Before there are letters to measure by.
constexpr std::uint32_t kPanel_px = 390;

glm::uvec2 windowSize(const Settings& settings)
{
    constexpr std::uint32_t kMost = 16384;
    return {std::min(settings.size_px.x, kMost) + kPanel_px, std::min(settings.size_px.y, kMost)};
}

/// A processor that draws takes its time for each pixel; whoever asks for a size has it whole.
bool startsAtHalfSize(const Settings& settings, const host::Gpu& gpu)
{
    return gpu.software() && !settings.given.contains("size");
}

Settings atHalfSize(Settings settings)
{
    const glm::uvec2 half = glm::max(settings.size_px / 2U, glm::uvec2(1));
    applySetting(settings, "size", fmt::format("{}x{}", half.x, half.y));
    return settings;
}

} // namespace

ViewWindow::ViewWindow(const Settings& settings, const std::optional<ShaderBuild>& shaders)
    : window_({.title = "gnomon", .size = windowSize(settings)}),
      shaders_(shaders ? std::make_unique<ShaderReload>(*shaders) : nullptr),
      gpu_(openGpu(settings, &window_, shaders_ ? shaders_->hook() : vulkan::ShaderHook{})),
      interface_(std::make_unique<host::Interface>(window_, *gpu_)), validates_(settings.validate)
{
    shown_.half_size = startsAtHalfSize(settings, *gpu_);
    viewer_ = std::make_unique<Viewer>(*gpu_, shown_.half_size ? atHalfSize(settings) : settings);
    typed_.technique_beside = viewer_->techniqueBeside();
}

ViewWindow::~ViewWindow() = default;

Settings ViewWindow::settingsOfWindow() const
{
    Settings settings = viewer_->settings();
    settings.subcommand = kView;
    // What windowSize() makes of it is this window's own size, whether its panel is shown or not.
    const glm::dvec2 inside = glm::dvec2(size_px()) / window_.contentScale();
    if (inside.y >= 1.0) { // else it is minimised
        applySetting(settings, "size",
                     fmt::format("{:.0f}x{:.0f}", std::max(inside.x - kPanel_px, 1.0), std::max(inside.y, 1.0)));
    }
    return settings;
}

glm::ivec2 ViewWindow::pictureAt() const
{
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    return {static_cast<int>(std::lround(area_.least.x * static_cast<double>(scale.x))),
            static_cast<int>(std::lround(area_.least.y * static_cast<double>(scale.y)))};
}

/// The picture fills what the panel leaves.
void ViewWindow::fitPicture()
{
    const ImGuiIO& io = ImGui::GetIO();
    const float left = shown_.panel ? std::min(panelWidth(), io.DisplaySize.x - 1.0F) : 0.0F;
    area_.least = {std::floor(left), 0.0};
    area_.size = {std::max(io.DisplaySize.x - std::floor(left), 1.0F), std::max(io.DisplaySize.y, 1.0F)};
    const double part = shown_.half_size ? 0.5 : 1.0;
    const glm::dvec2 size_px =
        area_.size * glm::dvec2(io.DisplayFramebufferScale.x, io.DisplayFramebufferScale.y) * part;
    const glm::uvec2 wanted(std::max(1.0, std::floor(size_px.x)), std::max(1.0, std::floor(size_px.y)));
    if (wanted != viewer_->settings().size_px) {
        viewer_->change({{"size", fmt::format("{}x{}", wanted.x, wanted.y)}});
    }
}

void ViewWindow::panel()
{
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize({static_cast<float>(area_.least.x), io.DisplaySize.y});
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                        ImGuiWindowFlags_NoSavedSettings;
    if (ImGui::Begin("panel", nullptr, kFlags)) {
        constexpr float kLabels = 0.45F; // of the width
        ImGui::PushItemWidth(-ImGui::GetContentRegionAvail().x * kLabels);
        PanelState state{shown_, typed_, widgets_, [this](const std::string& text) {
                             window_.toClipboard(text);
                         }};
        techniquePanel(*viewer_, state);
        comparePanel(*viewer_, state);
        timesPanel(*viewer_, state);
        scenePanel(*viewer_, state);
        lightPanel(*viewer_, state);
        picturePanel(*viewer_, state);
        filesPanel(*viewer_, state);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

/// The last word about what was done, over the picture's lower edge.
void ViewWindow::status()
{
    constexpr std::chrono::seconds kRead{15}; // then it has been read
    const Clock::time_point now = Clock::now();
    if (viewer_->message().text != said_) {
        said_ = viewer_->message().text;
        said_at_ = now;
    }
    const Message message = now - said_at_ < kRead ? viewer_->message() : Message{};
    if (message.text.empty() && !shown_.hint) {
        return;
    }
    const std::string text =
        message.text.empty() ? "drag: orbit   shift+drag: pan   right drag: look   wheel: nearer   W A S D Q E: fly   "
                               "F: frame all   T: truth   P: play   H: panel"
                             : message.text;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float margin = ImGui::GetFontSize() * 0.5F;
    const float width = static_cast<float>(area_.size.x) - 4.0F * margin;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
    const ImVec2 least{static_cast<float>(area_.least.x) + margin,
                       static_cast<float>(area_.least.y + area_.size.y) - size.y - 3.0F * margin};
    list.AddRectFilled(least, {least.x + size.x + 2.0F * margin, least.y + size.y + 2.0F * margin},
                       IM_COL32(0, 0, 0, 150), 4.0F);
    list.AddText(nullptr, 0.0F, {least.x + margin, least.y + margin},
                 message.is_refusal ? IM_COL32(255, 170, 120, 255) : IM_COL32(230, 230, 230, 255), text.c_str(),
                 nullptr, width);
}

/// What the compiler of shaders said, over the picture until they compile.
void ViewWindow::shaderFaults()
{
    if (!shaders_ || shaders_->faults().empty()) {
        return;
    }
    const float margin = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({static_cast<float>(area_.least.x) + margin, margin});
    ImGui::SetNextWindowSize({static_cast<float>(area_.size.x) - 2.0F * margin, 0.0F});
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("shaders do not compile", nullptr, kFlags)) {
        ImGui::PushTextWrapPos(0.0F);
        ImGui::TextUnformatted(shaders_->faults().c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

/// Draws with the new ones, or with the old ones where that cannot be.
void ViewWindow::takeShaders()
{
    if (viewer_->remake()) {
        viewer_->say({fmt::format("shaders as their sources are: {} modules are new", shaders_->count()), false});
        return;
    }
    const Message why = viewer_->message();
    shaders_->goBack();
    if (!viewer_->remake()) {
        throw Error("going back to the last shaders", viewer_->message().text);
    }
    viewer_->say(why);
}

void ViewWindow::followShaders(double now_s)
{
    switch (shaders_ ? shaders_->turn(now_s) : ShaderNews::none) {
    case ShaderNews::none:
        return;
    case ShaderNews::compiling:
        viewer_->say({"compiling shaders", false});
        break;
    case ShaderNews::unchanged:
        viewer_->say({"the shaders are what they were", false});
        break;
    case ShaderNews::failed:
        viewer_->say({"shaders do not compile; the picture has the last ones that did", true});
        break;
    case ShaderNews::compiled:
        takeShaders();
        break;
    }
    quiet_turns_ = 0;
}

void ViewWindow::build(double elapsed_s)
{
    widgets_.begin();
    fitPicture();
    if (shown_.panel) {
        panel();
    }
    shaderFaults();
    pointer_.turn(*viewer_, shown_, area_, window_.takeLetters(), elapsed_s);
    status();
}

void ViewWindow::retitle()
{
    std::string title =
        fmt::format("gnomon: {}, {}", viewer_->settings().scene, describeTechnique(viewer_->settings()));
    if (viewer_->rmse()) {
        title += fmt::format(", rmse {:.4f} ({} rays{})", *viewer_->rmse(), viewer_->truthRays(),
                             viewer_->isTruthDone() ? "" : " so far");
    }
    if (title != title_) {
        window_.setTitle(title);
        title_ = std::move(title);
    }
}

std::vector<host::PicturePlace> ViewWindow::places() const
{
    std::vector<host::PicturePlace> places;
    const host::Canvas& canvas = viewer_->canvas();
    if (canvas.isEmpty()) {
        return places;
    }
    const glm::ivec2 at = pictureAt();
    const glm::ivec2 room = glm::ivec2(interface_->size_px()) - at;
    const int enlarged = shown_.half_size ? 2 : 1;
    const glm::ivec2 whole(canvas.size_px());
    if (whole.x * enlarged > room.x ||
        whole.y * enlarged > room.y) { // a debug view with its legend: all of it, smaller
        const double share = std::min(static_cast<double>(room.x) / whole.x, static_cast<double>(room.y) / whole.y);
        const glm::ivec2 size = glm::max(glm::ivec2(glm::dvec2(whole) * share), glm::ivec2(1));
        places.push_back({&canvas, {0, 0}, whole, at + (room - size) / 2, size});
    } else {
        addPictures(places, canvas, at);
    }
    if (inset_ && !inset_->isEmpty()) {
        places.push_back(insetPlace());
    }
    return places;
}

/// One picture, or both with the divider between them.
void ViewWindow::addPictures(std::vector<host::PicturePlace>& places, const host::Canvas& canvas,
                             const glm::ivec2& at) const
{
    const int enlarged = shown_.half_size ? 2 : 1;
    const glm::ivec2 whole(canvas.size_px());
    const host::Canvas* const beside = viewer_->held() == Held::split ? viewer_->canvasBeside() : nullptr;
    const int cut =
        beside == nullptr ? whole.x : static_cast<int>(std::lround(static_cast<float>(whole.x) * shown_.divider));
    places.push_back({&canvas, {0, 0}, {cut, whole.y}, at, glm::ivec2(cut, whole.y) * enlarged});
    if (beside != nullptr) {
        const glm::ivec2 rest = glm::min(glm::ivec2(beside->size_px()), whole) - glm::ivec2(cut, 0);
        places.push_back({beside, {cut, 0}, rest, at + glm::ivec2(cut * enlarged, 0), rest * enlarged});
    }
}

void ViewWindow::nap()
{
    if (is_hidden_ || (quiet_turns_ > kQuietTurns && !viewer_->isBusy())) {
        for (int i = 0; i < kNaps && !window_.listen(kNap_s); ++i) {
            requireNotInterrupted();
        }
    }
}

/// In the lower right corner, above the last word; smaller where the picture is small.
host::PicturePlace ViewWindow::insetPlace() const
{
    constexpr int kMargin_px = 12;
    constexpr double kMost = 0.7; // of the picture
    const glm::dvec2 whole(inset_->canvas().size_px());
    const glm::dvec2 room = glm::dvec2(interface_->size_px()) - glm::dvec2(pictureAt());
    const double share = std::min({1.0, kMost * room.x / whole.x, kMost * room.y / whole.y});
    const glm::ivec2 size = glm::max(glm::ivec2(whole * share), glm::ivec2(1));
    const int word_px = static_cast<int>(ImGui::GetFontSize() * ImGui::GetIO().DisplayFramebufferScale.y * 3.0F);
    const glm::ivec2 at = glm::ivec2(interface_->size_px()) - size - glm::ivec2(kMargin_px, kMargin_px + word_px);
    return {&inset_->canvas(), {0, 0}, glm::ivec2(whole), glm::max(at, pictureAt()), size};
}

/// After the picture was drawn, from what it was drawn with.
void ViewWindow::overlays(bool drew)
{
    if (shown_.frusta) {
        drawFrusta(*viewer_, area_);
    }
    if (!shown_.maps) {
        inset_.reset();
        return;
    }
    if (drew || !inset_) {
        inset_ ? void() : static_cast<void>(inset_.emplace(*gpu_));
        inset_->paint(*viewer_);
        if (!inset_->why().empty()) {
            viewer_->say({inset_->why(), true});
        }
    }
    if (!inset_->isEmpty()) {
        const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
        const glm::dvec2 px(scale.x, scale.y);
        drawSquares(*inset_, glm::dvec2(insetPlace().to_px) / px, glm::dvec2(insetPlace().to_size_px) / px);
    }
}

/// Up to where widgets can be made; false where there is nothing to draw in.
bool ViewWindow::prepare()
{
    window_.listen();
    requireNotInterrupted();
    for (const std::string& file : window_.takeDropped()) {
        viewer_->open(file);
        typed_.scene = file;
    }
    followShaders(std::chrono::duration<double>(Clock::now() - start_).count());
    is_hidden_ = !interface_->begin();
    if (is_hidden_) {
        return false;
    }
    const Clock::time_point now = Clock::now();
    const double elapsed_s = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    constexpr double kLongest_s = 0.25; // after a pause nothing leaps
    build(std::min(elapsed_s, kLongest_s));
    const bool drew = viewer_->update(std::chrono::duration<double>(now - start_).count());
    overlays(drew);
    quiet_turns_ = drew || window_.takeExposed() || ImGui::IsAnyItemActive() ? 0 : quiet_turns_ + 1;
    retitle();
    return true;
}

bool ViewWindow::turn()
{
    if (prepare()) {
        interface_->end(places());
        turn_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - last_).count();
        if (validates_) {
            requireSilence(*gpu_);
        }
    }
    return !window_.isClosing();
}

Image8 ViewWindow::turnAndRead()
{
    Image8 shown;
    if (prepare()) {
        shown = interface_->endAndRead(places());
    }
    return shown;
}

} // namespace gnomon::app::view
