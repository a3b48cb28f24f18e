// SPDX-License-Identifier: Apache-2.0
// Packets of rays come to an end, and say what single rays say.
#include "support.h"

#include "scene_geometry.h"
#include "shadow_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <sys/resource.h>

namespace gnomon::truth::test {
namespace {

constexpr int kAsItShould = 42;
constexpr rlim_t kPatience_s = 20; // of processor time, for what takes milliseconds

/// Sixteen leaves and sixteen panes over a ground, each kind one mesh. Every other texel of a leaf is a hole.
scene::Scene leavesAndPanes()
{
    scene::Scene scene;
    scene::Image holes{.name = "holes", .width = 2, .height = 2};
    for (const std::uint8_t alpha : std::initializer_list<std::uint8_t>{255, 0, 0, 255}) {
        holes.rgba.insert(holes.rgba.end(), {255, 255, 255, alpha});
    }
    scene.images.push_back(holes);
    scene.textures.push_back({0, scene::Wrap::repeat, scene::Wrap::repeat, false});
    scene.materials.resize(2);
    scene.materials[0].alpha_mode = scene::AlphaMode::mask;
    scene.materials[0].base_colour_texture = {0};
    scene.materials[1].alpha_mode = scene::AlphaMode::blend;
    scene.materials[1].base_colour = {0.25F, 0.5F, 1.0F, 0.5F};
    place(scene, addQuad(scene, level(0.0F, 8.0F)));
    for (const std::uint32_t material : {0U, 1U}) {
        scene::Node& node = place(scene, addQuad(scene, ceiling(1.0F, -0.7F, 0.7F, 0.7F), material));
        for (int i = 0; i < 16; ++i) {
            const glm::vec3 to(2.0F * static_cast<float>(i % 4) - 3.0F, 0.1F * static_cast<float>(i % 3 + material),
                               2.0F * static_cast<float>(i / 4) - 3.0F);
            node.instances.push_back(glm::rotate(glm::translate(glm::mat4(1.0F), to), 0.3F * static_cast<float>(i),
                                                 glm::vec3(0.0F, 1.0F, 0.2F)));
        }
    }
    scene::finishScene(scene);
    return scene;
}

/// Leaves `value` in the part of the stack that the next calls get.
[[gnu::noinline]] void fillTheStack(int value)
{
    std::array<char, std::size_t{192} * 1024> room;
    std::memset(room.data(), value, room.size());
    asm volatile("" : : "r"(room.data()) : "memory"); // so that it is done, though nothing reads it
}

/// Ends the process; the system does where the rays do not come to an end.
[[noreturn]] void traceOverAFullStack()
{
    const rlimit patience{kPatience_s, kPatience_s};
    ::setrlimit(RLIMIT_CPU, &patience);
    const scene::Scene scene = leavesAndPanes();
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneGeometry geometry(scene, state, 0);
    const ShadowRays rays(geometry, sun({0.2, -1.0, 0.1}, 0.2), area(64));
    bool equal = geometry.part(1).instanced && geometry.part(17).instanced;
    for (std::uint32_t i = 0; i < 64; ++i) {
        Receiver receiver{.pixel = i};
        receiver.rel = glm::dvec3(i % 8 - 3.6, 1e-4, i / 8 - 3.6) - geometry.originWs();
        fillTheStack(0);
        const double over_nothing = rays.trace(receiver).visibility;
        fillTheStack(0x55);
        equal = equal && rays.trace(receiver).visibility == over_nothing;
    }
    std::_Exit(equal ? kAsItShould : 1);
}

TEST(PacketsDeathTest, EndWhateverTheStackHeldBefore)
{
    EXPECT_EXIT(traceOverAFullStack(), testing::ExitedWithCode(kAsItShould), "");
}

/// Eight rays from near the ground to all sides of up; every fifth is not valid.
struct Rays {
    RTCRay8 rays{};
    alignas(64) std::array<int, kLanes> valid{};

    explicit Rays(std::mt19937& random)
    {
        std::uniform_real_distribution<float> any(-1.0F, 1.0F);
        for (std::uint32_t k = 0; k < kLanes; ++k) {
            rays.org_x[k] = 5.0F * any(random);
            rays.org_y[k] = -0.4F;
            rays.org_z[k] = 5.0F * any(random);
            rays.dir_x[k] = any(random);
            rays.dir_y[k] = 1.0F;
            rays.dir_z[k] = any(random);
            rays.tfar[k] = std::numeric_limits<float>::infinity();
            rays.mask[k] = 0xFFFFFFFFU;
            rays.id[k] = k;
            valid[k] = random() % 5 != 0 ? -1 : 0;
        }
    }
    [[nodiscard]] RTCRay one(std::uint32_t k) const
    {
        RTCRay ray{};
        ray.org_x = rays.org_x[k];
        ray.org_y = rays.org_y[k];
        ray.org_z = rays.org_z[k];
        ray.dir_x = rays.dir_x[k];
        ray.dir_y = rays.dir_y[k];
        ray.dir_z = rays.dir_z[k];
        ray.tfar = rays.tfar[k];
        ray.mask = rays.mask[k];
        ray.id = k;
        return ray;
    }
};

/// The red, green and blue light that arrives along a ray.
glm::vec3 arrives(float tfar, const Tint& tint)
{
    return tfar >= 0.0F ? tint.through : glm::vec3(0.0F);
}

TEST(Packets, SayWhatSingleRaysSay)
{
    const scene::Scene scene = leavesAndPanes();
    const scene::State state = scene::evaluate(scene, 0.0);
    for (const std::uint64_t flat_triangles : {std::uint64_t{0}, std::uint64_t{1000}}) {
        const SceneGeometry geometry(scene, state, flat_triangles);
        std::mt19937 random(1);
        std::uint32_t blocked = 0;
        std::uint32_t tinted = 0;
        for (int i = 0; i < 2000; ++i) {
            const Rays asked(random);
            for (const auto flag : {RTC_INTERSECT_CONTEXT_FLAG_COHERENT, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT}) {
                Rays packet = asked;
                RayContext together;
                together.base.flags = flag;
                rtcOccluded8(packet.valid.data(), geometry.casters(), &together.base, &packet.rays);
                RayContext alone;
                for (std::uint32_t k = 0; k < kLanes; ++k) {
                    if (packet.valid[k] == 0) {
                        EXPECT_EQ(packet.rays.tfar[k], asked.rays.tfar[k]);
                        continue;
                    }
                    RTCRay ray = asked.one(k);
                    rtcOccluded1(geometry.casters(), &alone.base, &ray);
                    const glm::vec3 light = arrives(ray.tfar, alone.tints[k]);
                    ASSERT_EQ(arrives(packet.rays.tfar[k], together.tints[k]), light) << i << ' ' << k;
                    blocked += light == glm::vec3(0.0F) ? 1 : 0;
                    tinted += light.x > 0.0F && light.x < 1.0F ? 1 : 0;
                }
            }
        }
        EXPECT_GT(blocked, 2000U);
        EXPECT_GT(tinted, 2000U);
    }
}

} // namespace
} // namespace gnomon::truth::test
