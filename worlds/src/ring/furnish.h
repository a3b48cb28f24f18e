// SPDX-License-Identifier: Apache-2.0
// The places of all things in the world `ring`.
#pragma once

#include "folk.h"
#include "lamps.h"
#include "palette.h"

namespace gnomon::worlds {

inline constexpr double kRail_m = 3.1; // height of the rails over rooms

/// The meshes that rooms are furnished with, each once.
struct Wares {
    std::uint32_t stool, table, shelf, jukebox, glasses, bench, nightstand;
    std::array<std::uint32_t, 3> chairs, sofas, beds, lockers, crates, drums, consoles, stalls, planters;
    std::uint32_t scanner, workbench, turbine, boiler, wares, fern, bush, tree, rock;
    std::array<std::uint32_t, 2> palms;
};
[[nodiscard]] Wares addWares(Scene& scene, const RingPalette& palette);

/// Puts things into one room: `tiles` from its middle, `depth_m` from the middle of the promenade, `turn_rad` from
/// facing the promenade.
class Decorator {
public:
    Decorator(Scene& scene, const RingPalette& palette, const Wares& wares, LampMaker& lamps, const Folk& folk,
              int sector, int side)
        : scene_(scene), palette_(palette), wares_(wares), lamps_(lamps), folk_(folk), sector_(sector), side_(side),
          rng_seed_(static_cast<std::uint32_t>(sector * 2 + (side > 0 ? 1 : 0)))
    {
    }
    /// Puts all things into the room.
    void furnish();

private:
    [[nodiscard]] Transform spot(double tiles, double depth_m, float turn_rad, double height_m, float scale) const;
    void put(std::uint32_t mesh, double tiles, double depth_m, float turn_rad = 0.0F, double height_m = 0.0,
             float scale = 1.0F);
    void lamp(Lamp lamp, double tiles, double depth_m, double height_m, const Shine& shine, float turn_rad = 0.0F);
    void mood(double tiles, double depth_m, double height_m, const Shine& shine);
    void guest(double tiles, double depth_m, float turn_rad, std::uint32_t kind);
    /// Potted; `green` stands in the pot.
    void plant(std::uint32_t green, double tiles, double depth_m, std::uint32_t pot, float scale = 1.0F);
    /// A table with chairs around, and a lamp over it.
    void tableSet(double tiles, double depth_m, int chairs, std::uint32_t chair);
    /// A rail over the room, from wall to wall along the ring, for lamps to hang from.
    void rail(double depth_m);
    void counter(int from, int to, double depth_m);
    void rug(double tiles, double depth_m, double radius_m, std::uint32_t srgb, std::uint32_t border);

    /// Puts the things before a room's walls.
    void promenade();
    void bar(bool large);
    void lounge();
    void garden();
    void market();
    void berths();
    void lab();
    void stores();
    void workshop();
    void engine();

    Scene& scene_;
    const RingPalette& palette_;
    const Wares& wares_;
    LampMaker& lamps_;
    const Folk& folk_;
    int sector_;
    int side_;
    std::uint32_t rng_seed_;
    std::uint32_t put_ = 0;
};

} // namespace gnomon::worlds
