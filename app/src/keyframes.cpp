// SPDX-License-Identifier: Apache-2.0
// Based on: F. N. Fritsch, J. Butland, "A Method for Constructing Local Monotone Piecewise Cubic Interpolants", 1984:
// the slope at a key between two others is a weighted harmonic mean of the slopes beside it, and 0 where these differ
// in sign. Departure: the first and the last key have the slope of the straight line to their neighbour, so that two
// keys make a constant speed.
// Compiled alone: others have variables by the name of its json.
#include "app/keyframes.h"

#include "app/settings.h"
#include "scene/json.h"
#include "setting_rows.h"

#include "files/files.h"

#include <gnomon/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace gnomon::app {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{1} << 24U;
constexpr double kLeastStep_s = 1e-6; // between two keys
constexpr double kLongest_s = 1e9;
constexpr double kFarthestTime_s = 1e6; // as --time
constexpr double kLeastFov_deg = 0.1;   // as --fov
constexpr double kLargestFov_deg = 179.0;
constexpr double kShortest = 1e-12; // a direction's length must be told from rounding noise

/// A text from the file made short and printable on one line.
std::string shown(std::string text)
{
    constexpr std::size_t kLongest = 200;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20U || c >= 0x7FU; }, '?');
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

class PathOwner final : public scene::JsonOwner {
public:
    explicit PathOwner(std::string_view name) : name_(name) {}
    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& found,
                           const std::string& todo) const override
    {
        constexpr std::size_t kLongest =
            80; // the place of what is nested deep is long, and what is wrong comes after it
        const std::string place = pointer.size() <= kLongest ? pointer : pointer.substr(0, kLongest) + "...";
        throw Error(
            fmt::format("reading path {}", name_),
            shown(fmt::format("{}{}{}{}{}", place, place.empty() ? "" : ": ", what, found.empty() ? "" : ": ", found)),
            todo);
    }

private:
    std::string_view name_;
};

class Reader {
public:
    explicit Reader(std::string_view name) : name_(name) {}

    [[nodiscard]] Keyframes read(std::string_view text) const
    {
        PathOwner owner(name_);
        const scene::JsonTree<json> tree = scene::readJson<json>(text, owner);
        const json& file = tree.root();
        if (!file.is_object()) {
            fail("", "it is no JSON object");
        }
        requireKnown(file, "", {"keys"});
        if (!file.contains("keys") || !file["keys"].is_array() || file["keys"].empty()) {
            fail("/keys", "there is no list of keys");
        }
        Keyframes frames;
        double last_s = -kLongest_s;
        for (std::size_t i = 0; i < file["keys"].size(); ++i) {
            last_s = addKey(frames, file["keys"][i], fmt::format("/keys/{}", i), last_s);
        }
        return frames;
    }

private:
    [[noreturn]] void fail(std::string_view pointer, const std::string& found) const
    {
        throw Error(fmt::format("reading path {}", name_),
                    pointer.empty() ? found : fmt::format("{}: {}", pointer, found));
    }

    void requireKnown(const json& object, std::string_view pointer, const std::vector<std::string_view>& known) const
    {
        for (const auto& [key, value] : object.items()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                fail(
                    fmt::format("{}/{}", pointer, shown(key)),
                    fmt::format("there is no such entry{}; it takes {}", suggestion(shown(key), known), listed(known)));
            }
        }
    }

    [[nodiscard]] double number(const json& value, const std::string& pointer, double least, double most) const
    {
        if (!value.is_number()) {
            fail(pointer, "it is no number");
        }
        const double number = value.get<double>();
        if (!(number >= least && number <= most)) {
            fail(pointer, fmt::format("{} is not in the range {} to {}", number, least, most));
        }
        return number;
    }

    [[nodiscard]] glm::dvec3 vector(const json& value, const std::string& pointer) const
    {
        if (!value.is_array() || value.size() != 3) {
            fail(pointer, "it is no list of three numbers");
        }
        glm::dvec3 out{0.0};
        for (int i = 0; i < 3; ++i) {
            out[i] =
                number(value[static_cast<std::size_t>(i)], fmt::format("{}/{}", pointer, i), -kFarthest, kFarthest);
        }
        return out;
    }

    /// Returns when the key is.
    [[nodiscard]] double addKey(Keyframes& frames, const json& key, const std::string& pointer, double last_s) const
    {
        if (!key.is_object()) {
            fail(pointer, "it is no object");
        }
        requireKnown(key, pointer, {"at", "eye", "target", "fov", "sun", "time"});
        if (!key.contains("at")) {
            fail(pointer, "it has no \"at\", the seconds since the first frame");
        }
        if (key.size() == 1) {
            fail(pointer, "it has neither eye, target, fov, sun nor time");
        }
        const double at_s = number(key["at"], pointer + "/at", 0.0, kLongest_s);
        if (at_s < last_s + kLeastStep_s) {
            fail(pointer + "/at", fmt::format("{} s is not after {} s, where the key before it is", at_s, last_s));
        }
        const auto addVector = [&](const char* name, KeyTrack& track) {
            if (key.contains(name)) {
                track.add(at_s, vector(key[name], fmt::format("{}/{}", pointer, name)));
            }
        };
        const auto addNumber = [&](const char* name, KeyTrack& track, double least, double most) {
            if (key.contains(name)) {
                track.add(at_s, {number(key[name], fmt::format("{}/{}", pointer, name), least, most), 0.0, 0.0});
            }
        };
        addVector("eye", frames.eye_ws);
        addVector("target", frames.target_ws);
        addNumber("fov", frames.fov_deg, kLeastFov_deg, kLargestFov_deg);
        addNumber("time", frames.time_s, -kFarthestTime_s, kFarthestTime_s);
        addVector("sun", frames.sun_ws);
        if (key.contains("sun") && !(glm::length(frames.sun_ws.at(at_s)) > kShortest)) {
            fail(pointer + "/sun", "the direction is zero");
        }
        return at_s;
    }

    std::string_view name_;
};

} // namespace

void KeyTrack::add(double at_s, const glm::dvec3& value)
{
    assert(keys_.empty() || at_s > keys_.back().at_s);
    keys_.push_back({at_s, value});
}

double KeyTrack::slope(std::size_t key, int component) const
{
    const auto secant = [&](std::size_t from) {
        return (keys_[from + 1].value[component] - keys_[from].value[component]) /
               (keys_[from + 1].at_s - keys_[from].at_s);
    };
    if (key == 0 || key + 1 == keys_.size()) {
        return secant(key == 0 ? 0 : key - 1);
    }
    const double before = secant(key - 1);
    const double after = secant(key);
    if (!(before * after > 0.0)) {
        return 0.0; // a turning point: another slope would overshoot
    }
    const double h_before = keys_[key].at_s - keys_[key - 1].at_s;
    const double h_after = keys_[key + 1].at_s - keys_[key].at_s;
    const double alpha = (1.0 + h_after / (h_before + h_after)) / 3.0;
    return before * after / (alpha * after + (1.0 - alpha) * before);
}

glm::dvec3 KeyTrack::at(double s) const
{
    assert(!keys_.empty());
    const auto next =
        std::upper_bound(keys_.begin(), keys_.end(), s, [](double time, const Key& key) { return time < key.at_s; });
    if (next == keys_.begin()) {
        return keys_.front().value;
    }
    if (next == keys_.end()) {
        return keys_.back().value;
    }
    const auto i = static_cast<std::size_t>(next - keys_.begin()) - 1;
    const double h = keys_[i + 1].at_s - keys_[i].at_s;
    const double u = (s - keys_[i].at_s) / h;
    glm::dvec3 out{0.0};
    for (int c = 0; c < 3; ++c) { // the cubic with these values and slopes at both ends (Hermite)
        const double from = keys_[i].value[c];
        const double to = keys_[i + 1].value[c];
        const double rise = u * u * (3.0 - 2.0 * u);
        out[c] = from + (to - from) * rise + h * u * (1.0 - u) * ((1.0 - u) * slope(i, c) - u * slope(i + 1, c));
        out[c] = std::clamp(out[c], std::min(from, to), std::max(from, to)); // rounding
    }
    return out;
}

Keyframes parseKeyframes(std::string_view text, std::string_view name)
{
    return Reader(name).read(text);
}

Keyframes readKeyframes(const std::filesystem::path& file)
{
    return parseKeyframes(readWholeFile(file, kMaxBytes, "path"), file.string());
}

} // namespace gnomon::app
