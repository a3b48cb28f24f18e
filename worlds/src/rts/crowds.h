// SPDX-License-Identifier: Apache-2.0
// The moving things of the world `rts`: squads on their loops, a giant, debris in its swarms, sails and flags. All are
// pure functions of the time.
#pragma once

#include "loops.h"
#include "palette.h"
#include "terrain.h"

#include <cstdint>
#include <vector>

namespace gnomon::worlds {

inline constexpr std::uint32_t kSquads = 25;
inline constexpr std::uint32_t kSquadUnits = 16;
inline constexpr std::uint32_t kUnits = kSquads * kSquadUnits; // 400
inline constexpr std::uint32_t kDebris = 2000;

/// 400 units in 25 squads, three nodes each: a body and its two legs.
class Army {
public:
    Army(Scene& scene, const Palette& palette, std::uint64_t seed);
    void pose(double time_s, const Terrain& terrain, std::span<const Loop> loops, std::vector<Node>& nodes) const;
    /// Where the middle of a squad is.
    [[nodiscard]] Loop::Place squadAt(std::uint32_t squad, double time_s, std::span<const Loop> loops) const;

private:
    struct Unit {
        std::uint32_t body = 0; // node; the legs follow
        std::uint32_t squad = 0;
        float ahead_m = 0.0F; // distance ahead of the squad's middle
        float right_m = 0.0F;
        float scale = 1.0F;
        float step = 0.0F; // place in the walk cycle, in turns
    };
    struct Squad {
        std::uint32_t loop = 0;
        float start_m = 0.0F;
    };
    std::vector<Unit> units_;
    std::vector<Squad> squads_;
};

/// A figure of three metres with a skin over eleven joints, which walks the far round alone.
class Giant {
public:
    /// `start_m`: how far along his loop he is at time 0.
    Giant(Scene& scene, const Palette& palette, float start_m);
    void pose(double time_s, const Terrain& terrain, const Loop& loop, std::vector<Node>& nodes) const;
    [[nodiscard]] Loop::Place place(double time_s, const Loop& loop) const;

private:
    std::uint32_t root_ = 0; // node; the joints follow
    float start_m_ = 0.0F;
};

/// 2,000 shards and crystals in ten swarms that drift over the map.
class Debris {
public:
    Debris(Scene& scene, const Palette& palette, std::uint64_t seed);
    void pose(double time_s, std::vector<Node>& nodes) const;

private:
    struct Particle {
        glm::vec3 axis{0.0F, 1.0F, 0.0F};
        float spin_hz = 0.1F;
        float orbit_radius_m = 10.0F;
        float orbit_hz = 0.01F;
        float orbit_start = 0.0F; // turns
        float height_m = 30.0F;
        float bob_m = 1.0F;
        std::uint32_t swarm = 0;
    };
    std::uint32_t first_node_ = 0;
    std::vector<Particle> particles_;
};

/// Nodes that only turn: sails about z, flags to and fro about y.
class Turners {
public:
    void addSails(std::uint32_t node, float turns_per_s, float phase);
    void addFlag(std::uint32_t node, float phase);
    void pose(double time_s, std::vector<Node>& nodes) const;

private:
    struct Turner {
        std::uint32_t node = 0;
        float rate = 0.0F;
        float phase = 0.0F; // turns
    };
    std::vector<Turner> sails_;
    std::vector<Turner> flags_;
};

} // namespace gnomon::worlds
