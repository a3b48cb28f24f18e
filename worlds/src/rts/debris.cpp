// SPDX-License-Identifier: Apache-2.0
#include "../mesh_maker.h"
#include "../rng.h"
#include "../scene_maker.h"
#include "crowds.h"

#include <array>
#include <cmath>

namespace gnomon::worlds {

namespace {

struct Swarm {
    glm::vec3 centre; // metres
    float radius_m;
    float drift_m;
    float drift_hz;
};
// Over the camp's rim and the map; none where the usual view looks through it at arm's length.
constexpr std::array<Swarm, 10> kSwarms{{{{-26, 34, -34}, 30, 8, 0.013F},
                                         {{52, 32, -24}, 26, 9, 0.011F},
                                         {{-70, 34, 30}, 28, 10, 0.009F},
                                         {{-120, 46, -90}, 38, 14, 0.008F},
                                         {{0, 44, -120}, 42, 16, 0.007F},
                                         {{110, 44, -110}, 36, 12, 0.010F},
                                         {{150, 38, 30}, 34, 12, 0.008F},
                                         {{-150, 38, 90}, 34, 12, 0.009F},
                                         {{-40, 40, 150}, 36, 14, 0.008F},
                                         {{120, 36, 140}, 34, 12, 0.010F}}};

Mesh makeShard(const Palette& palette, std::uint32_t variant)
{
    MeshMaker maker;
    Part& rock = maker.with(palette.rock);
    rock.uv_per_metre = 0.6F;
    constexpr std::array<std::uint32_t, 4> kTints{0x8C7F74, 0x9B8A77, 0x76706C, 0xA3927E};
    rock.colour = rgb(kTints[variant % 4]);
    rock.frame = scaled({1.0F, 0.62F + 0.1F * static_cast<float>(variant), 0.75F});
    rock.ball(0.5F, 0, 0.28F, 90 + variant); // 20 triangles
    return maker.take("shard " + std::to_string(variant));
}

Mesh makeCrystal(const Palette& palette, std::uint32_t variant)
{
    MeshMaker maker;
    Part& crystal = maker.with(palette.crystal);
    crystal.colour = variant == 0 ? rgb(0x6FD6E0) : rgb(0xA98BE8);
    const float w = 0.24F + 0.05F * static_cast<float>(variant);
    crystal.lathe({{0.0F, -0.75F}, {w, -0.25F}, {w, 0.3F}, {0.0F, 0.8F}}, 6, false, true); // 24 triangles
    return maker.take("crystal " + std::to_string(variant));
}

} // namespace

Debris::Debris(Scene& scene, const Palette& palette, std::uint64_t seed)
{
    std::array<std::uint32_t, 6> meshes{};
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
        meshes[i] = addMesh(scene, i < 4 ? makeShard(palette, i) : makeCrystal(palette, i - 4));
    }
    Rng rng(seed, 400);
    first_node_ = static_cast<std::uint32_t>(scene.nodes.size());
    for (std::uint32_t i = 0; i < kDebris; ++i) {
        const auto swarm = static_cast<std::uint32_t>(i % kSwarms.size());
        const Swarm& s = kSwarms[swarm];
        const float out = std::sqrt(rng.unit());
        Particle p;
        p.swarm = swarm;
        p.axis = rng.direction();
        p.spin_hz = rng.range(0.02F, 0.12F);
        p.orbit_radius_m = s.radius_m * out;
        p.orbit_hz = 0.02F / (0.4F + out) * rng.range(0.8F, 1.2F);
        p.orbit_start = rng.unit();
        p.height_m = s.centre.y + 7.0F * (rng.unit() + rng.unit() - 1.0F) * (1.2F - out * 0.7F);
        p.bob_m = rng.range(0.3F, 1.2F);
        particles_.push_back(p);
        const std::uint32_t kind = rng.below(10);
        Transform transform;
        // Many small ones and a few large.
        const float size = 0.35F + 1.5F * std::pow(rng.unit(), 4.0F) + 0.35F * rng.unit();
        transform.scale = glm::vec3(size);
        const std::uint32_t mesh = meshes[kind < 8 ? kind % 4 : 4 + kind % 2];
        scene.nodes[addNode(scene, "debris/" + std::to_string(i), mesh, transform)].dynamic = true;
    }
}

void Debris::pose(double time_s, std::vector<Node>& nodes) const
{
    std::array<glm::vec3, kSwarms.size()> centres{};
    for (std::size_t i = 0; i < kSwarms.size(); ++i) {
        const Swarm& s = kSwarms[i];
        const double turns = time_s * static_cast<double>(s.drift_hz) + 0.17 * static_cast<double>(i);
        const auto turn = static_cast<float>(turns - std::floor(turns));
        centres[i] = s.centre + s.drift_m * glm::vec3(cosineOfTurns(turn), 0.0F, sineOfTurns(turn));
    }
    for (std::size_t i = 0; i < particles_.size(); ++i) {
        const Particle& p = particles_[i];
        const double orbits = time_s * static_cast<double>(p.orbit_hz);
        const double spins = time_s * static_cast<double>(p.spin_hz) * 0.5; // half turns: a quaternion's angle
        const float orbit = p.orbit_start + static_cast<float>(orbits - std::floor(orbits));
        const float spin = p.orbit_start + static_cast<float>(spins - std::floor(spins));
        const glm::vec3& centre = centres[p.swarm];
        const float s = sineOfTurns(spin);
        Transform& transform = nodes[first_node_ + i].transform;
        transform.translation = {centre.x + p.orbit_radius_m * cosineOfTurns(orbit),
                                 p.height_m + p.bob_m * sineOfTurns(spin + spin),
                                 centre.z + p.orbit_radius_m * sineOfTurns(orbit)};
        transform.rotation = glm::quat(cosineOfTurns(spin), p.axis.x * s, p.axis.y * s, p.axis.z * s);
    }
}

void Turners::addSails(std::uint32_t node, float turns_per_s, float phase)
{
    sails_.push_back({.node = node, .rate = turns_per_s, .phase = phase});
}

void Turners::addFlag(std::uint32_t node, float phase)
{
    flags_.push_back({.node = node, .rate = 0.35F, .phase = phase});
}

void Turners::pose(double time_s, std::vector<Node>& nodes) const
{
    const auto turnOf = [time_s](const Turner& turner) {
        const double turns = time_s * static_cast<double>(turner.rate) + static_cast<double>(turner.phase);
        return static_cast<float>(turns - std::floor(turns));
    };
    for (const Turner& sails : sails_) {
        const double half_turns = 0.5 * (time_s * static_cast<double>(sails.rate) + static_cast<double>(sails.phase));
        const auto half = static_cast<float>(half_turns - std::floor(half_turns));
        nodes[sails.node].transform.rotation = glm::quat(cosineOfTurns(half), 0.0F, 0.0F, -sineOfTurns(half));
    }
    for (const Turner& flag : flags_) {
        // The wind comes from the west, as the sun does in this world: flags stream to the east.
        const float half_angle_turns = 0.035F * sineOfTurns(turnOf(flag));
        nodes[flag.node].transform.rotation =
            glm::quat(cosineOfTurns(half_angle_turns), 0.0F, sineOfTurns(half_angle_turns), 0.0F);
    }
}

} // namespace gnomon::worlds
