// SPDX-License-Identifier: Apache-2.0
#include "worlds/worlds.h"

#include <algorithm>
#include <array>

// Every world, in the order shown to people: its name, the function that makes it, a summary. Its own source defines the
// function; nothing else declares it.
#define GNOMON_WORLDS(WORLD)                                                                                           \
    WORLD("rts", makeRts,                                                                                              \
          "a strategy game's map: 400 walking units, a camp, groves, floating debris, one sun (Marinescu 2011)")       \
    WORLD("sundial", makeSundial,                                                                                      \
          "a meadow with trees, fences and a house under a sun and a moon on their courses (Fortier 2010)")            \
    WORLD("ring", makeRing,                                                                                            \
          "a space station bent into a ring: 89 point lights inside lamps, tiles, walkers, plants (Forsyth 2006)")     \
    WORLD("spotlit", makeSpotlit, "sculpture on a stage under three spot lights with cookies (Shastry 2005)")          \
    WORLD("canopies", makeCanopies,                                                                                    \
          "three roofs over each other, where averaged maps let light through; closed-form answers")                   \
    WORLD("planes", makePlanes, "one box above one plane, a sun and a spot light, with closed-form answers")

namespace gnomon::worlds {

#define GNOMON_DECLARE_WORLD(name, make, summary) scene::Scene make(std::uint64_t seed);
GNOMON_WORLDS(GNOMON_DECLARE_WORLD)
#undef GNOMON_DECLARE_WORLD

std::span<const World> all()
{
#define GNOMON_ROW_OF_WORLD(name, make, summary) World{name, summary, &(make)},
    static constexpr std::array kWorlds{GNOMON_WORLDS(GNOMON_ROW_OF_WORLD)};
#undef GNOMON_ROW_OF_WORLD
    return kWorlds;
}

const World* find(std::string_view name)
{
    const std::span<const World> worlds = all();
    const auto world = std::ranges::find(worlds, name, &World::name);
    return world != worlds.end() ? &*world : nullptr;
}

} // namespace gnomon::worlds
