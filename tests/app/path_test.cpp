// SPDX-License-Identifier: Apache-2.0
// Where scripted paths lead, and what their files may say.
#include "app/scripted_path.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace gnomon::app {
namespace {

constexpr double kFps = 30.0;
constexpr double kHeight_px = 720.0;

/// Starts where the world `planes` may be looked at from.
ScriptedPath pathOf(PathKind kind)
{
    ScriptedPath path;
    path.kind = kind;
    path.start.position_ws = {6.0, 5.0, 8.0};
    path.start.target_ws = {0.0, 1.0, 0.0};
    path.start.fov_y_rad = 0.8;
    path.focus_m = glm::length(path.start.target_ws - path.start.position_ws);
    path.right_ws =
        glm::normalize(glm::cross(path.start.target_ws - path.start.position_ws, glm::dvec3(0.0, 1.0, 0.0)));
    path.sun_ws = glm::normalize(glm::dvec3(0.3, -1.0, 0.2));
    return path;
}

/// Pixels from the picture's middle.
glm::dvec2 placeOf(const host::Eye& eye, const glm::dvec3& point)
{
    const glm::dvec3 forward = glm::normalize(eye.target_ws - eye.position_ws);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, eye.up_ws));
    const glm::dvec3 up = glm::cross(right, forward);
    const glm::dvec3 ray = point - eye.position_ws;
    const double scale = kHeight_px / 2.0 / std::tan(eye.fov_y_rad / 2.0) / glm::dot(ray, forward);
    return {glm::dot(ray, right) * scale, glm::dot(ray, up) * scale};
}

constexpr PathKind kCameraPaths[] = {PathKind::pan, PathKind::orbit, PathKind::dolly, PathKind::zoom};

TEST(Path, StartsWhereTheCameraIs)
{
    for (const PathKind kind : kCameraPaths) {
        const ScriptedPath path = pathOf(kind);
        EXPECT_TRUE(path.movesCamera());
        EXPECT_FALSE(path.movesSun());
        const host::Eye eye = pathAt(path, 0.0).eye;
        EXPECT_LT(glm::length(eye.position_ws - path.start.position_ws), 1e-12);
        EXPECT_LT(glm::length(eye.target_ws - path.start.target_ws), 1e-12);
        EXPECT_NEAR(eye.fov_y_rad, path.start.fov_y_rad, 1e-15);
        EXPECT_EQ(pathAt(path, 7.0).sun_ws, path.sun_ws);
    }
}

TEST(Path, MovesByAFewPixelsAFrame)
{
    for (const PathKind kind : kCameraPaths) {
        const ScriptedPath path = pathOf(kind);
        double most = 0.0;
        for (int frame = 0; frame < 150; ++frame) {
            const host::Eye now = pathAt(path, frame / kFps).eye;
            const host::Eye next = pathAt(path, (frame + 1) / kFps).eye;
            // Points at the distance of the target, half way from the middle to the picture's rim.
            const glm::dvec3 middle = now.position_ws + glm::normalize(now.target_ws - now.position_ws) * path.focus_m;
            for (const double side : {-1.0, 0.0, 1.0}) {
                const glm::dvec3 point = middle + path.right_ws * (side * 0.25 * path.focus_m);
                most = std::max(most, glm::length(placeOf(next, point) - placeOf(now, point)));
            }
        }
        EXPECT_LT(most, 4.0) << static_cast<int>(kind);
        EXPECT_GT(most, 0.5) << static_cast<int>(kind);
    }
}

TEST(Path, IsAPureFunctionOfTheFrame)
{
    for (const PathKind kind : {PathKind::pan, PathKind::orbit, PathKind::dolly, PathKind::zoom, PathKind::day}) {
        const ScriptedPath path = pathOf(kind);
        const PathSpot late = pathAt(path, 3.7);
        (void)pathAt(path, 0.1);
        const PathSpot again = pathAt(path, 3.7);
        EXPECT_EQ(late.eye.position_ws, again.eye.position_ws);
        EXPECT_EQ(late.eye.fov_y_rad, again.eye.fov_y_rad);
        EXPECT_EQ(late.sun_ws, again.sun_ws);
    }
}

TEST(Path, PanKeepsItsDirectionAndSpeed)
{
    const ScriptedPath path = pathOf(PathKind::pan);
    const host::Eye later = pathAt(path, 8.0).eye; // a picture's height at the target's distance
    const glm::dvec3 moved = later.position_ws - path.start.position_ws;
    EXPECT_NEAR(glm::length(moved), 2.0 * path.focus_m * std::tan(0.4), 1e-12);
    EXPECT_NEAR(glm::dot(moved, path.start.target_ws - path.start.position_ws), 0.0, 1e-12);
    EXPECT_LT(glm::length(later.target_ws - path.start.target_ws - moved), 1e-12);
}

TEST(Path, OrbitKeepsItsDistanceAndComesBack)
{
    const ScriptedPath path = pathOf(PathKind::orbit);
    for (const double s : {1.0, 15.0, 44.0}) {
        const host::Eye eye = pathAt(path, s).eye;
        EXPECT_NEAR(glm::length(eye.target_ws - eye.position_ws), path.focus_m, 1e-12);
        EXPECT_NEAR(eye.position_ws.y, path.start.position_ws.y, 1e-12);
    }
    EXPECT_GT(glm::length(pathAt(path, 15.0).eye.position_ws - path.start.position_ws), 10.0); // opposite
    EXPECT_LT(glm::length(pathAt(path, 30.0).eye.position_ws - path.start.position_ws), 1e-12);
}

TEST(Path, DollyGoesForwardAndZoomNarrows)
{
    const ScriptedPath dolly = pathOf(PathKind::dolly);
    const glm::dvec3 moved = pathAt(dolly, 10.0).eye.position_ws - dolly.start.target_ws;
    EXPECT_LT(glm::length(moved), 1e-12); // at what was looked at, after ten seconds
    const ScriptedPath zoom = pathOf(PathKind::zoom);
    EXPECT_NEAR(std::tan(pathAt(zoom, 10.0).eye.fov_y_rad / 2.0), std::tan(0.4) / std::exp(1.0), 1e-12);
    EXPECT_NEAR(glm::degrees(pathAt(zoom, 1e6).eye.fov_y_rad), 0.1, 1e-12); // never less
}

TEST(Path, TheSunTakesItsCourse)
{
    for (const glm::dvec3& direction : {glm::dvec3(0.3, -1.0, 0.2), glm::dvec3(0.0, -1.0, 0.0)}) {
        ScriptedPath path = pathOf(PathKind::day);
        path.sun_ws = glm::normalize(direction);
        EXPECT_TRUE(path.movesSun());
        EXPECT_FALSE(path.movesCamera());
        EXPECT_LT(glm::length(pathAt(path, 0.0).sun_ws - path.sun_ws), 1e-15);
        for (int frame = 0; frame < 3600; frame += 7) {
            const glm::dvec3 now = pathAt(path, frame / kFps).sun_ws;
            const glm::dvec3 next = pathAt(path, (frame + 1) / kFps).sun_ws;
            EXPECT_NEAR(glm::length(now), 1.0, 1e-12);
            EXPECT_NEAR(glm::length(glm::cross(now, next)), std::sin(glm::radians(0.1)), 1e-12);
            EXPECT_GE(now.y, path.sun_ws.y - 1e-12); // highest at the first frame
        }
        EXPECT_NEAR(pathAt(path, 30.0).sun_ws.y, 0.0, 1e-12);
        EXPECT_NEAR(pathAt(path, 60.0).sun_ws.y, -path.sun_ws.y, 1e-12);
        EXPECT_LT(glm::length(pathAt(path, 120.0).sun_ws - path.sun_ws), 1e-12);
    }
}

TEST(Keys, PassThroughTheirValuesWithoutAKink)
{
    KeyTrack track;
    const double times[] = {0.0, 1.0, 1.5, 4.0, 6.0};
    const double values[] = {0.0, 2.0, 2.5, 2.5, -1.0};
    for (std::size_t i = 0; i < std::size(times); ++i) {
        track.add(times[i], {values[i], 0.0, 1.0});
    }
    for (std::size_t i = 0; i < std::size(times); ++i) {
        EXPECT_EQ(track.at(times[i]).x, values[i]);
        EXPECT_EQ(track.at(times[i]).z, 1.0);
    }
    for (std::size_t i = 1; i + 1 < std::size(times); ++i) {
        constexpr double kStep = 1e-6;
        const double before = (track.at(times[i]).x - track.at(times[i] - kStep).x) / kStep;
        const double after = (track.at(times[i] + kStep).x - track.at(times[i]).x) / kStep;
        EXPECT_NEAR(before, after, 1e-4) << i;
    }
    for (std::size_t i = 0; i + 1 < std::size(times); ++i) { // nothing overshoots
        for (double u = 0.0; u < 1.0; u += 0.05) {
            const double value = track.at(times[i] + u * (times[i + 1] - times[i])).x;
            EXPECT_GE(value, std::min(values[i], values[i + 1]));
            EXPECT_LE(value, std::max(values[i], values[i + 1]));
        }
    }
    EXPECT_EQ(track.at(-3.0).x, 0.0);
    EXPECT_EQ(track.at(99.0).x, -1.0);
}

TEST(Keys, TwoMakeAStraightLine)
{
    KeyTrack track;
    track.add(1.0, {0.0, 4.0, 1.0});
    track.add(3.0, {1.0, 0.0, 1.0});
    for (double s = 1.0; s <= 3.0; s += 0.1) {
        EXPECT_NEAR(track.at(s).x, (s - 1.0) / 2.0, 1e-12);
        EXPECT_NEAR(track.at(s).y, 4.0 - 2.0 * (s - 1.0), 1e-12);
    }
    KeyTrack one;
    one.add(2.0, glm::dvec3(7.0));
    EXPECT_EQ(one.at(0.0).x, 7.0);
    EXPECT_EQ(one.at(5.0).x, 7.0);
}

TEST(Keys, ReadFromAFile)
{
    const Keyframes frames = parseKeyframes(R"({"keys": [
        {"at": 0, "eye": [1, 2, 3], "fov": 50},
        {"at": 0.5, "sun": [0, -2, 0]},
        {"at": 2, "eye": [3, 2, 3], "time": 8}]})",
                                            "it");
    EXPECT_EQ(frames.eye_ws.at(1.0), glm::dvec3(2.0, 2.0, 3.0));
    EXPECT_EQ(frames.fov_deg.at(9.0).x, 50.0);
    EXPECT_EQ(frames.sun_ws.at(9.0).y, -2.0);
    EXPECT_EQ(frames.time_s.at(0.0).x, 8.0);
    EXPECT_TRUE(frames.target_ws.empty());
    ScriptedPath path = pathOf(PathKind::keys);
    path.keys = frames;
    const PathSpot spot = pathAt(path, 1.0);
    EXPECT_EQ(spot.eye.position_ws, glm::dvec3(2.0, 2.0, 3.0));
    EXPECT_EQ(spot.eye.target_ws, path.start.target_ws);
    EXPECT_NEAR(glm::degrees(spot.eye.fov_y_rad), 50.0, 1e-12);
    EXPECT_EQ(spot.sun_ws, glm::dvec3(0.0, -1.0, 0.0));
}

struct WrongFile {
    const char* name;
    std::string text;
    const char* says; // part of the line
};
void PrintTo(const WrongFile& wrong, std::ostream* out)
{
    *out << wrong.name;
}
class WrongKeys : public testing::TestWithParam<WrongFile> {};

TEST_P(WrongKeys, IsOneLineThatSaysWhere)
{
    try {
        (void)parseKeyframes(GetParam().text, "a.json");
        FAIL() << "it was taken";
    } catch (const Error& error) {
        const std::string line = error.what();
        EXPECT_NE(line.find(GetParam().says), std::string::npos) << line;
        EXPECT_NE(line.find("a.json"), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        EXPECT_LT(line.size(), 500U) << line;
    }
}

std::string nested(std::size_t depth)
{
    return R"({"keys": )" + std::string(depth, '[') + std::string(depth, ']') + "}";
}

const WrongFile kWrongFiles[] = {
    {"Empty", "", "invalid JSON"},
    {"NoJson", "{ not json", "invalid JSON"},
    {"Binary", std::string("\0\xff\xfe\x01\n\r", 6), "invalid JSON"},
    {"CutShort", R"({"keys": [{"at": 0)", "invalid JSON"},
    {"AnArray", "[1, 2]", "no JSON object"},
    {"Deep", nested(100000), "nested deeper"},
    {"NoKeys", "{}", "/keys: there is no list"},
    {"EmptyKeys", R"({"keys": []})", "/keys: there is no list"},
    {"KeysAreAnObject", R"({"keys": {"at": 0}})", "/keys: there is no list"},
    {"UnknownEntry", R"({"kesy": [], "keys": []})", "/kesy: there is no such entry (did you mean \"keys\"?)"},
    {"KeyIsANumber", R"({"keys": [3]})", "/keys/0: it is no object"},
    {"NoTime", R"({"keys": [{"eye": [0, 0, 0]}]})", "/keys/0: it has no \"at\""},
    {"OnlyTime", R"({"keys": [{"at": 0}]})", "/keys/0: it has neither"},
    {"UnknownInKey", R"({"keys": [{"at": 0, "fow": 3}]})",
     "/keys/0/fow: there is no such entry (did you mean \"fov\"?)"},
    {"TimeIsText", R"({"keys": [{"at": "0", "fov": 3}]})", "/keys/0/at: it is no number"},
    {"TimeIsNegative", R"({"keys": [{"at": -1, "fov": 3}]})", "/keys/0/at: -1 is not in the range"},
    {"TimeStandsStill", R"({"keys": [{"at": 1, "fov": 3}, {"at": 1, "fov": 4}]})", "/keys/1/at: 1 s is not after 1 s"},
    {"TimeRunsBackwards", R"({"keys": [{"at": 1, "fov": 3}, {"at": 0, "eye": [0,0,0]}]})",
     "/keys/1/at: 0 s is not after"},
    {"TwoNumbers", R"({"keys": [{"at": 0, "eye": [0, 1]}]})", "/keys/0/eye: it is no list of three numbers"},
    {"FourNumbers", R"({"keys": [{"at": 0, "eye": [0, 1, 2, 3]}]})", "/keys/0/eye: it is no list of three numbers"},
    {"NullInVector", R"({"keys": [{"at": 0, "target": [0, null, 2]}]})", "/keys/0/target/1: it is no number"},
    {"TooFar", R"({"keys": [{"at": 0, "eye": [0, 2e9, 0]}]})", "/keys/0/eye/1: 2000000000 is not in the range"},
    {"NumberOverflows", R"({"keys": [{"at": 0, "eye": [0, 1e999, 0]}]})", "/keys/0/eye/1: a number is out of range"},
    {"FovTooWide", R"({"keys": [{"at": 0, "fov": 180}]})", "/keys/0/fov: 180 is not in the range 0.1 to 179"},
    {"FovZero", R"({"keys": [{"at": 0, "fov": 0}]})", "/keys/0/fov: 0 is not in the range"},
    {"SunZero", R"({"keys": [{"at": 0, "sun": [0, 0, 0]}]})", "/keys/0/sun: the direction is zero"},
    {"Twice", R"({"keys": [{"at": 0, "fov": 3, "fov": 4}]})", "/keys/0: an object has the same key twice: 'fov'"},
};
INSTANTIATE_TEST_SUITE_P(Keys, WrongKeys, testing::ValuesIn(kWrongFiles),
                         [](const auto& wrong) { return wrong.param.name; });

} // namespace
} // namespace gnomon::app
