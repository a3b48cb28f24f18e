// SPDX-License-Identifier: Apache-2.0
#include "user.h"

#include "app/command_line.h"
#include "image/image_io.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

namespace gnomon::test {
namespace {

/// What a POSIX shell makes of a line that shellText() made.
std::vector<std::string> wordsOf(std::string_view line)
{
    std::vector<std::string> words{""};
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '\'') {
            quoted = !quoted;
        } else if (line[i] == '\\' && !quoted) {
            words.back() += line[++i];
        } else if (line[i] == ' ' && !quoted) {
            words.emplace_back();
        } else {
            words.back() += line[i];
        }
    }
    return words;
}

std::string keyOf(char letter)
{
    switch (letter) {
    case '.':
        return "period";
    case '-':
        return "minus";
    case '/':
        return "slash";
    case ',':
        return "comma";
    case '=':
        return "equal";
    default:
        return std::string(1, letter);
    }
}

} // namespace

app::Settings settingsOf(const std::vector<std::string>& arguments)
{
    std::vector<std::string> words{"view"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return app::parseCommandLine(words).settings;
}

Image8 readPixels(const std::filesystem::path& file)
{
    const ImageF read = readImage(file);
    Image8 image(read.width, read.height, read.channels);
    std::transform(read.values.begin(), read.values.end(), image.values.begin(),
                   [](float value) { return static_cast<std::uint8_t>(std::lround(value * 255.0F)); });
    return image;
}

Image8 drawnBy(const std::string& command)
{
    std::vector<std::string> words = wordsOf(command);
    words.erase(words.begin()); // the program
    const auto file = std::filesystem::temp_directory_path() / fmt::format("gnomon_view_{}.png", getpid());
    words.back() = file.string();
    if (app::runProgram(words) != 0) {
        throw std::runtime_error("does not draw: " + command);
    }
    Image8 image = readPixels(file);
    std::filesystem::remove(file);
    return image;
}

User::User(Desktop& desktop, const std::vector<std::string>& arguments,
           const std::optional<app::view::ShaderBuild>& shaders)
    : desktop_(desktop), window_(settingsOf(arguments), shaders)
{
    glfwFocusWindow(window_.window().handle());
    wait();
}

void User::wait(int turns)
{
    for (int i = 0; i < turns; ++i) {
        (void)window_.turn();
    }
}

bool User::rest()
{
    constexpr int kMost = 3000;
    for (int i = 0; i < kMost; ++i) {
        (void)window_.turn();
        if (viewer().isAtRest()) {
            wait();
            return true;
        }
    }
    return false;
}

glm::dvec2 User::find(std::string_view label)
{
    constexpr int kMost = 6; // turns until a panel that scrolls has brought it
    for (int i = 0; i < kMost; ++i) {
        if (const glm::dvec2* const place = window_.widgets().placeOf(label); place != nullptr && i > 0) {
            return *place;
        }
        window_.widgets().reveal(std::string(label));
        wait(2);
    }
    throw std::runtime_error("there is no widget " + std::string(label));
}

void User::click(std::string_view label)
{
    desktop_.point(find(label));
    wait(2);
    desktop_.press(1);
    wait(1);
    desktop_.release(1);
    wait(2);
}

void User::pick(std::string_view label, std::string_view item)
{
    click(label);
    click(fmt::format("{}/{}", label, item));
}

void User::press(std::string_view key)
{
    desktop_.key(key, true);
    wait(1);
    desktop_.key(key, false);
    wait(1);
}

void User::type(std::string_view label, std::string_view text)
{
    click(label);
    desktop_.key("Control_L", true);
    press("a");
    desktop_.key("Control_L", false);
    press("BackSpace");
    for (const char letter : text) {
        const bool shifts = std::isupper(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '+';
        const std::string key = letter == '_' ? "minus" : letter == '+' ? "equal" : keyOf(letter);
        if (shifts) {
            desktop_.key("Shift_L", true);
        }
        press(key);
        if (shifts) {
            desktop_.key("Shift_L", false);
        }
    }
    press("Return");
    wait();
}

void User::drag(const glm::dvec2& from, const glm::dvec2& to, int button)
{
    desktop_.point(from);
    wait(2);
    desktop_.press(button);
    wait(1);
    constexpr int kSteps = 4;
    for (int i = 1; i <= kSteps; ++i) {
        desktop_.point(glm::mix(from, to, static_cast<double>(i) / kSteps));
        wait(1);
    }
    desktop_.release(button);
    wait(2);
}

void User::drop(const std::string& file)
{
    GLFWwindow* const handle = window_.window().handle();
    const GLFWdropfun heard = glfwSetDropCallback(handle, nullptr);
    glfwSetDropCallback(handle, heard);
    const char* path = file.c_str();
    heard(handle, 1, &path);
    wait();
}

void User::wheel(const glm::dvec2& at, int clicks)
{
    desktop_.point(at);
    wait(2);
    for (int i = 0; i < std::abs(clicks); ++i) {
        desktop_.press(clicks > 0 ? 4 : 5);
        desktop_.release(clicks > 0 ? 4 : 5);
        wait(1);
    }
}

glm::dvec2 User::inPicture(double x, double y) const
{
    const glm::dvec2 at(window_.pictureAt());
    const glm::dvec2 size = glm::dvec2(window_.size_px()) - at;
    return at + glm::dvec2(x, y) * size;
}

Image8 User::shownPicture()
{
    const Image8 whole = window_.turnAndRead();
    const glm::ivec2 at = window_.pictureAt();
    const Image8& drawn = viewer().picture();
    Image8 part(drawn.width, drawn.height, 3);
    for (std::uint32_t y = 0; y < part.height; ++y) {
        for (std::uint32_t x = 0; x < part.width; ++x) {
            std::copy_n(whole.pixel(x + static_cast<std::uint32_t>(at.x), y + static_cast<std::uint32_t>(at.y)), 3,
                        part.pixel(x, y));
        }
    }
    return part;
}

} // namespace gnomon::test
