// SPDX-License-Identifier: Apache-2.0
// Calls that nobody means: each is refused with a message, or planned; none is undefined, throws or leaks.
#include "allocation_count.h"
#include "structs.h"
#include "sweep.h"

#include <gnomon/option_table.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

namespace gnomon::test {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// A frame under one sun, seen from (0, 2, 10) along -z.
void describe(GnomonFrame& frame, GnomonLight& sun, const GnomonObjects* objects)
{
    constexpr std::array<double, 16> kClipFromWorld{1.0, 0.0, 0.0, 0.0,  0.0, -1.0, 0.0, 0.0,
                                                    0.0, 0.0, 0.0, -1.0, 0.0, 2.0,  0.1, 10.0};
    gnomonInitLight(&sun, sizeof(sun));
    gnomonInitFrame(&frame, sizeof(frame));
    std::memcpy(frame.camera.clip_from_world, kClipFromWorld.data(), sizeof(kClipFromWorld));
    frame.camera.eye_ws[1] = 2.0;
    frame.camera.eye_ws[2] = 10.0;
    frame.objects = objects;
    frame.lights = &sun;
    frame.light_count = 1;
}

/// A scene of two boxes under a sun.
struct Host {
    GnomonObjects* objects = gnomonMakeObjects(GNOMON_INTERFACE);
    GnomonPlanner* planner = gnomonMakePlanner(GNOMON_INTERFACE);
    GnomonObjectId ground{};
    GnomonObjectId box{};
    GnomonLight sun{};
    GnomonFrame frame{};

    Host()
    {
        const GnomonBounds level{{-20.0F, -0.1F, -20.0F}, {20.0F, 0.0F, 20.0F}};
        const GnomonBounds cube{{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}};
        EXPECT_EQ(gnomonAddObject(objects, &level, nullptr, &ground), GNOMON_OK);
        EXPECT_EQ(gnomonAddObject(objects, &cube, nullptr, &box), GNOMON_OK);
        EXPECT_EQ(gnomonSetOption(planner, 0, "map-size", "64"), GNOMON_OK);
        describe(frame, sun, objects);
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    ~Host()
    {
        gnomonFreePlanner(planner);
        gnomonFreeObjects(objects);
    }

    const GnomonPlan* plan() { return gnomonPlan(planner, &frame); }
};

/// The call was refused, and the message has these words.
void expectRefused(GnomonStatus status, std::string_view words)
{
    EXPECT_EQ(status, GNOMON_REFUSED);
    EXPECT_NE(std::string_view(gnomonLastError()->message).find(words), std::string_view::npos)
        << gnomonLastError()->message;
    EXPECT_EQ(gnomonLastError()->status, GNOMON_REFUSED);
    EXPECT_STRNE(gnomonLastError()->tried, "");
    EXPECT_STRNE(gnomonLastError()->found, "");
}
void expectRefused(const void* result, std::string_view words)
{
    EXPECT_EQ(result, nullptr);
    expectRefused(result == nullptr ? GNOMON_REFUSED : GNOMON_OK, words);
}

TEST(CHostile, NullPointersAreRefused)
{
    Host host;
    const GnomonBounds bounds{};
    GnomonObjectId id{};
    std::size_t bytes = 0;
    float rows[40] = {};
    gnomonFreePlanner(nullptr);
    gnomonFreeObjects(nullptr);
    expectRefused(gnomonAddObject(nullptr, &bounds, nullptr, &id), "objects is null");
    expectRefused(gnomonAddObject(host.objects, nullptr, nullptr, &id), "bounds is null");
    expectRefused(gnomonAddObject(host.objects, &bounds, nullptr, nullptr), "id is null");
    expectRefused(gnomonMoveObjects(host.objects, nullptr, &bounds, 1), "ids is null");
    expectRefused(gnomonMoveObjects(host.objects, &host.box, nullptr, 1), "bounds is null");
    expectRefused(gnomonMoveObjects(nullptr, &host.box, &bounds, 1), "objects is null");
    EXPECT_EQ(gnomonMoveObjects(host.objects, nullptr, nullptr, 0), GNOMON_OK);
    expectRefused(gnomonTouchObject(nullptr, host.box), "objects is null");
    expectRefused(gnomonRemoveObject(nullptr, host.box), "objects is null");
    expectRefused(gnomonSetObjectFlags(host.objects, host.box, nullptr), "flags is null");
    expectRefused(gnomonInitLight(nullptr, sizeof(GnomonLight)), "GnomonLight is null");
    expectRefused(gnomonInitFrame(nullptr, sizeof(GnomonFrame)), "GnomonFrame is null");
    expectRefused(gnomonSetOption(nullptr, 0, "filter", "pcf"), "planner is null");
    expectRefused(gnomonSetOption(host.planner, 0, nullptr, "pcf"), "key is null");
    expectRefused(gnomonSetOption(host.planner, 0, "filter", nullptr), "value is null");
    expectRefused(gnomonGetOption(host.planner, 0, nullptr), "key is null");
    expectRefused(gnomonGetOption(nullptr, 0, "filter"), "planner is null");
    expectRefused(gnomonCheckOptions(nullptr, 0, 0), "planner is null");
    expectRefused(gnomonPlan(nullptr, &host.frame), "planner is null");
    expectRefused(gnomonPlan(host.planner, nullptr), "frame is null");
    expectRefused(gnomonLightAt(nullptr, 0), "planner is null");
    expectRefused(gnomonPlanJson(nullptr), "planner is null");
    expectRefused(gnomonLoseMap(nullptr, 0, 0), "planner is null");
    expectRefused(gnomonLoseAllMaps(nullptr), "planner is null");
    ASSERT_NE(host.plan(), nullptr);
    expectRefused(gnomonBufferBytes(host.planner, 0, nullptr), "bytes is null");
    EXPECT_EQ(gnomonBufferBytes(host.planner, 0, &bytes), GNOMON_OK);
    expectRefused(gnomonFillBuffer(host.planner, 0, 0, nullptr, nullptr, bytes), "out is null");
    expectRefused(gnomonWriteCasterRows(host.planner, 0, nullptr, 1, 0.0, rows, 40), "world_from_object is null");
    const std::array<float, 12> identity{1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
    expectRefused(gnomonWriteCasterRows(host.planner, 0, identity.data(), 1, 0.0, nullptr, 40), "out is null");
}

TEST(CHostile, ArraysThatAreMissingAreRefused)
{
    Host host;
    host.frame.lights = nullptr;
    expectRefused(host.plan(), "lights (GnomonLight) is null");
    host.frame.light_count = 0;
    EXPECT_NE(host.plan(), nullptr);
    host.frame.request_count = 2;
    expectRefused(host.plan(), "requests (GnomonPageRequests) is null");
    GnomonPageRequests requests;
    gnomonInitPageRequests(&requests, sizeof(requests));
    requests.cell_count = 3;
    host.frame.requests = &requests;
    host.frame.request_count = 1;
    expectRefused(host.plan(), "cells is null");
    host.frame.request_count = 0;
    host.frame.layer_count = 1;
    expectRefused(host.plan(), "layers is null");
}

TEST(CHostile, OtherInterfacesAreRefused)
{
    for (const std::uint32_t number : {0U, GNOMON_INTERFACE + 1, 0xFFFFFFFFU}) {
        expectRefused(gnomonMakePlanner(number), "the program has interface");
        expectRefused(gnomonMakeObjects(number), "the program has interface");
    }
}

TEST(CHostile, StructsOfOtherSizesAreRefused)
{
    Host host;
    const std::uint32_t right = sizeof(GnomonLight);
    for (const std::uint32_t size : {0U, 4U, right - 4, right - 1, right + 1, right + 8, 0xFFFFFFFFU}) {
        GnomonLight light = host.sun;
        expectRefused(gnomonInitLight(&light, size), "the size of GnomonLight is");
        EXPECT_EQ(std::memcmp(&light, &host.sun, sizeof(light)), 0);
        light.size = size;
        host.frame.lights = &light;
        expectRefused(host.plan(), "the size of the lights (GnomonLight) is");
    }
    host.frame.lights = &host.sun;
    host.frame.size = 16;
    expectRefused(host.plan(), "the size of GnomonFrame is 16 bytes");
    const GnomonObjectFlags flags{};
    expectRefused(gnomonSetObjectFlags(host.objects, host.box, &flags), "the size of GnomonObjectFlags is 0 bytes");
    host.frame.size = sizeof(GnomonFrame);
    ASSERT_NE(host.plan(), nullptr);
    const GnomonPrecision precision{};
    std::array<unsigned char, 4096> out{};
    expectRefused(gnomonFillBuffer(host.planner, GNOMON_BUFFER_CONSTANTS, 0, &precision, out.data(), out.size()),
                  "the size of GnomonPrecision is 0 bytes");
}

/// A program that was compiled with an earlier header: what its structs lack has the defaults.
TEST(CHostile, OlderStructsAreRead)
{
    constexpr std::size_t kFirst = offsetof(GnomonLight, options); // as if options, map_size and groups had come later
    GnomonLight light;
    gnomonInitLight(&light, sizeof(light));
    light.key = 9;
    light.map_size = 128;
    light.groups = 5;
    light.size = offsetof(GnomonLight, groups);
    const auto read = c::readStruct<GnomonLight, Light>(&light, "light", kFirst);
    EXPECT_EQ(read.key, 9U);
    EXPECT_EQ(read.map_size, 128U);
    EXPECT_EQ(read.groups, kAllGroups);
    light.size = kFirst - 4;
    EXPECT_THROW((c::readStruct<GnomonLight, Light>(&light, "light", kFirst)), c::WrongCall);
}

TEST(CHostile, EnumsAndReservedMembersAreRefused)
{
    Host host;
    host.sun.type = 3;
    expectRefused(host.plan(), "GnomonLight::type is 3, and there are 3");
    host.sun.type = 0;
    host.sun.reserved = 1;
    expectRefused(host.plan(), "GnomonLight::reserved is 1");
    host.sun.reserved = 0;
    host.frame.camera.clip_depth = 7;
    expectRefused(host.plan(), "clip_depth is 7");
    host.frame.camera.clip_depth = 0;
    host.frame.rates.source = 9;
    expectRefused(host.plan(), "source is 9");
    host.frame.rates.source = 0;
    host.frame.rates.ray_ns = kNotANumber;
    expectRefused(host.plan(), "a time of GnomonFrame::rates");
    host.frame.rates.ray_ns = 0.0;
    GnomonObjectFlags flags;
    gnomonInitObjectFlags(&flags, sizeof(flags));
    flags.pieces = 4097;
    expectRefused(gnomonSetObjectFlags(host.objects, host.box, &flags), "pieces is 4097");
    EXPECT_NE(host.plan(), nullptr);
}

TEST(CHostile, IndicesBeyondTheEndAreRefused)
{
    Host host;
    expectRefused(gnomonViewAt(host.planner, 0), "the planner has no plan; call gnomonPlan() first");
    const GnomonPlan* plan = host.plan();
    ASSERT_NE(plan, nullptr);
    expectRefused(gnomonLightAt(host.planner, 1), "light is 1, and there are 1");
    expectRefused(gnomonViewAt(host.planner, plan->view_count), "view is");
    expectRefused(gnomonPagesAt(host.planner, 1), "options is 1");
    expectRefused(gnomonPassAt(host.planner, 0xFFFFFFFFU), "pass is");
    expectRefused(gnomonOptionAt(gnomonOptionCount()), "index is");
    std::size_t bytes = 0;
    expectRefused(gnomonBufferBytes(host.planner, 5, &bytes), "buffer is 5");
    std::array<unsigned char, 8192> out{};
    expectRefused(gnomonFillBuffer(host.planner, 9, 0, nullptr, out.data(), out.size()), "buffer is 9");
    expectRefused(gnomonFillBuffer(host.planner, 0, 1, nullptr, out.data(), out.size()), "options is 1");
    expectRefused(gnomonFillBuffer(host.planner, 0, 0, nullptr, out.data(), 767), "out has room for 767 bytes");
    const std::array<float, 12> identity{1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
    std::array<float, 20> rows{};
    expectRefused(gnomonWriteCasterRows(host.planner, 99, identity.data(), 1, 0.0, rows.data(), 20), "view is 99");
    expectRefused(gnomonWriteCasterRows(host.planner, 0, identity.data(), 1, 0.0, rows.data(), 11),
                  "room for 11 floats");
    host.sun.options = 7; // of no options: the light says so
    ASSERT_NE(host.plan(), nullptr);
    EXPECT_EQ(gnomonLightAt(host.planner, 0)->outcome, std::uint32_t{GNOMON_OPTIONS_REFUSED});
    EXPECT_STRNE(gnomonLightAt(host.planner, 0)->reason, "");
}

TEST(CHostile, NamesOfObjectsThatAreGoneAreRefused)
{
    Host host;
    const GnomonBounds bounds{{0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}};
    EXPECT_EQ(gnomonRemoveObject(host.objects, host.box), GNOMON_OK);
    expectRefused(gnomonRemoveObject(host.objects, host.box), "no object of the name");
    expectRefused(gnomonTouchObject(host.objects, {}), "no object of the name");
    const std::array ids{host.ground, host.box};
    const std::array both{bounds, bounds};
    expectRefused(gnomonMoveObjects(host.objects, ids.data(), both.data(), 2), "no object of the name");
    // The first has not moved either: the camera sees as much ground as before.
    ASSERT_NE(host.plan(), nullptr);
    EXPECT_EQ(host.plan()->receiver_count, 1U);
}

TEST(CHostile, OptionsThatThereAreNotAreRefused)
{
    Host host;
    expectRefused(gnomonSetOption(host.planner, 0, "filtre", "pcf"), "there is no option \"filtre\"");
    expectRefused(gnomonSetOption(host.planner, 0, std::string(5000, 'x').c_str(), "pcf"), "xxx...");
    EXPECT_LT(std::strlen(gnomonLastError()->message), 400U);
    expectRefused(gnomonSetOption(host.planner, 0, "filter", "pfc\n"), "filter: \"pfc \" is not");
    expectRefused(gnomonSetOption(host.planner, 0, "pcf.taps", "65"), "is not in the range 4 to 64");
    expectRefused(gnomonSetOption(host.planner, 0, "pcf.taps", "6.5"), "a whole number in the range 4 to 64");
    expectRefused(gnomonSetOption(host.planner, 0, "pcf.radius", "nan"), "a finite number in the range");
    expectRefused(gnomonSetOption(host.planner, 0, "level-depth", "perhaps"), "is not 0 or 1");
    expectRefused(gnomonSetOption(host.planner, 0, "cascades.ends", "1/2/x"), "finite numbers with / between");
    expectRefused(gnomonSetOption(host.planner, 2, "filter", "pcf"), "options is 2, and there are 2");
    expectRefused(gnomonGetOption(host.planner, 1, "filter"), "options is 1, and there are 1");
    expectRefused(gnomonCheckOptions(host.planner, 0, 3), "light_type is 3");
    EXPECT_STREQ(gnomonGetOption(host.planner, 0, "pcf.taps"), "16");
    for (std::uint32_t i = 1; i < 256; ++i) {
        ASSERT_EQ(gnomonSetOption(host.planner, i, "filter", "pcf"), GNOMON_OK);
    }
    expectRefused(gnomonSetOption(host.planner, 256, "filter", "pcf"), "options is 256, and there are 256");
}

TEST(CHostile, CombinationsThatCannotBeHadAreRefusedInWords)
{
    Host host;
    EXPECT_EQ(gnomonCheckOptions(host.planner, 0, GNOMON_POINT), GNOMON_OK);
    EXPECT_EQ(gnomonSetOption(host.planner, 0, "partition", "cascades"), GNOMON_OK);
    EXPECT_EQ(gnomonCheckOptions(host.planner, 0, GNOMON_DIRECTIONAL), GNOMON_OK);
    expectRefused(gnomonCheckOptions(host.planner, 0, GNOMON_POINT), "checking options: ");
    EXPECT_EQ(gnomonSetOption(host.planner, 0, "partition", "sdsm"), GNOMON_OK);
    EXPECT_EQ(gnomonSetOption(host.planner, 0, "motion", "snap"), GNOMON_OK);
    expectRefused(gnomonCheckOptions(host.planner, 0, GNOMON_DIRECTIONAL), "checking options: ");
    ASSERT_NE(host.plan(), nullptr);
    const GnomonLightPlan* light = gnomonLightAt(host.planner, 0);
    EXPECT_EQ(light->outcome, std::uint32_t{GNOMON_OPTIONS_REFUSED});
    EXPECT_STREQ(light->outcome_name, "refused");
}

/// Every number of a frame, one after the other: a plan whose outcome says why there is no map, or a sound one.
TEST(CHostile, NumbersOfFramesMayBeAny)
{
    for (const double value :
         {kNotANumber, std::numeric_limits<double>::infinity(), -1e300, 1e300, 1e-320, 0.0, -1.0}) {
        for (std::size_t at = offsetof(GnomonFrame, camera); at < offsetof(GnomonFrame, width_px);
             at += sizeof(double)) {
            Host host;
            if (at == offsetof(GnomonFrame, camera) + offsetof(GnomonCamera, reversed_z)) {
                continue; // these two are whole numbers
            }
            std::memcpy(reinterpret_cast<unsigned char*>(&host.frame) + at, &value, sizeof(value));
            ASSERT_NE(host.plan(), nullptr) << at << ": " << gnomonLastError()->message;
            ASSERT_NE(gnomonLightAt(host.planner, 0), nullptr);
        }
        for (std::size_t at = offsetof(GnomonLight, position_ws); at < offsetof(GnomonLight, options);
             at += sizeof(double)) {
            for (const std::uint32_t type : {GNOMON_DIRECTIONAL, GNOMON_SPOT, GNOMON_POINT}) {
                Host host;
                host.sun.type = type;
                std::memcpy(reinterpret_cast<unsigned char*>(&host.sun) + at, &value, sizeof(value));
                ASSERT_NE(host.plan(), nullptr) << at << ": " << gnomonLastError()->message;
            }
        }
        Host host;
        const auto bound = static_cast<float>(std::min(value, 3e38));
        const GnomonBounds bounds{{bound, bound, bound}, {bound, bound, bound}};
        EXPECT_EQ(gnomonMoveObjects(host.objects, &host.box, &bounds, 1), GNOMON_OK);
        host.frame.time_s = value;
        host.frame.draw_ms_per_texel = value;
        host.frame.width_px = 0;
        ASSERT_NE(host.plan(), nullptr);
        std::array<float, 12> transform{};
        transform[3] = static_cast<float>(kNotANumber);
        std::array<float, 20> rows{};
        if (host.plan()->view_count > 0) {
            expectRefused(gnomonWriteCasterRows(host.planner, 0, transform.data(), 1, 0.0, rows.data(), 20),
                          "not finite");
            expectRefused(gnomonWriteCasterRows(host.planner, 0, rows.data(), 1, kNotANumber, rows.data(), 20),
                          "bias_m");
        }
    }
}

TEST(CHostile, ErrorsBelongToTheirThread)
{
    expectRefused(gnomonMakePlanner(0), "interface 0");
    std::thread([] {
        EXPECT_EQ(gnomonLastError()->status, GNOMON_OK);
        expectRefused(gnomonMakePlanner(77), "interface 77");
    }).join();
    EXPECT_NE(std::string_view(gnomonLastError()->message).find("interface 0"), std::string_view::npos);
}

/// Any allocation may fail: the call says so, and what comes after it goes well.
TEST(CHostile, MemoryMayRunOutAnywhere)
{
    const auto run = [] {
        GnomonObjects* objects = gnomonMakeObjects(GNOMON_INTERFACE);
        GnomonPlanner* planner = gnomonMakePlanner(GNOMON_INTERFACE);
        const GnomonBounds bounds{{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}};
        GnomonObjectId id{};
        gnomonAddObject(objects, &bounds, nullptr, &id);
        gnomonSetOption(planner, 0, "map-size", "64");
        gnomonSetOption(planner, 1, "filter", "evsm");
        gnomonSetOption(planner, 1, "filter", "no such filter, and a text that no small string has room for");
        gnomonGetOption(planner, 0, "cascades.ends");
        GnomonLight sun;
        GnomonFrame frame;
        describe(frame, sun, objects);
        gnomonPlan(planner, &frame);
        gnomonPlanJson(planner);
        std::size_t bytes = 0;
        std::array<unsigned char, 8192> out{};
        gnomonBufferBytes(planner, GNOMON_BUFFER_VIEWS, &bytes);
        gnomonFillBuffer(planner, GNOMON_BUFFER_VIEWS, 0, nullptr, out.data(), out.size());
        gnomonFreePlanner(planner);
        gnomonFreeObjects(objects);
    };
    run(); // tables that are made once
    std::uint64_t count = 0;
    {
        const FailingAllocation none(std::numeric_limits<std::uint64_t>::max());
        run();
        count = none.asked();
    }
    EXPECT_GT(count, 100U);
    const std::ptrdiff_t held = heapHeld();
    for (const std::uint64_t point : sweepPoints("c interface", count, 400)) {
        const FailingAllocation failing(point);
        run();
        EXPECT_TRUE(FailingAllocation::failed()) << point;
    }
    EXPECT_LE(std::abs(heapHeld() - held), 4096) << "texts of the last error alone may stay";
    run();
}

} // namespace
} // namespace gnomon::test
