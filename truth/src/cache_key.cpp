// SPDX-License-Identifier: Apache-2.0
// The inputs that a truth depends on. Structured bindings name all members of each struct, so that a new member does
// not compile until somebody has decided here whether it counts.
#include "cache_key.h"

#include "device.h"

namespace gnomon::truth {
namespace {

template <typename T>
void add(scene::Hasher& hasher, const T& vector)
{
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        hasher.add(vector[i]);
    }
}

void add(scene::Hasher& hasher, const scene::Hash128& hash)
{
    hasher.add(hash.high);
    hasher.add(hash.low);
}

void add(scene::Hasher& hasher, const View& view)
{
    const auto& [eye_ws, world_from_clip, size_px] = view;
    add(hasher, eye_ws);
    for (glm::length_t i = 0; i < world_from_clip.length(); ++i) {
        add(hasher, world_from_clip[i]);
    }
    add(hasher, size_px);
}

/// All of it for either kind: a truth traced again in vain costs seconds, a wrong one taken for right costs trust.
void add(scene::Hasher& hasher, const Light& light)
{
    const auto& [type, position_ws, direction_ws, angular_diameter_rad, radius_m, near_m, groups] = light;
    hasher.add(type);
    add(hasher, position_ws);
    add(hasher, direction_ws);
    for (const double value : {angular_diameter_rad, radius_m, near_m}) {
        hasher.add(value);
    }
    hasher.add(groups);
}

} // namespace

scene::Hash128 keyBy(std::uint64_t identity, const scene::Scene& scene, const scene::State& state, const View& view,
                     const Light& light, const Options& options)
{
    scene::Hasher hasher;
    hasher.add(kTracerVersion);
    hasher.add(identity);
    add(hasher, scene::sceneHash(scene));
    add(hasher, scene::stateHash(state));
    add(hasher, view);
    add(hasher, light);
    const auto& [kind, samples, pixels, seed, threads, progress, cancel, patience_s] = options;
    hasher.add(kind);
    hasher.add(pixels);
    if (kind == Kind::area || pixels == PixelTruth::area) {
        hasher.add(samples);
        hasher.add(seed);
    }
    return hasher.value();
}

scene::Hash128 keyOf(const scene::Scene& scene, const scene::State& state, const View& view, const Light& light,
                     const Options& options)
{
    return keyBy(tracerIdentity(), scene, state, view, light, options);
}

} // namespace gnomon::truth
