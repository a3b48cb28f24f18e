// SPDX-License-Identifier: Apache-2.0
// Truth on disk, by a hash of all that it depends on. Safe against concurrent runs, torn files and full disks: an entry
// is either whole and right, or it is not there.
#pragma once

#include "scene/hash.h"
#include "truth/visibility.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace gnomon::truth {

/// The result of one trace: all that a comparison needs of the truth.
struct Traced {
    Surfaces surfaces;
    Visibility visibility;
};

/// Part of every key. Count it up with any change after which the tracer gives other results for the same input, so
/// that old truths are traced anew.
inline constexpr std::uint32_t kTracerVersion = 4;

/// The key of scene, state, view, light, kind, samples, seed, the tracer's own version, and Embree's version and the
/// instructions that it uses here. Threads and callbacks do not count. Throws Error when Embree does not start.
[[nodiscard]] scene::Hash128 keyOf(const scene::Scene& scene, const scene::State& state, const View& view,
                                   const Light& light, const Options& options);

class Cache {
public:
    /// The user's cache folder ($XDG_CACHE_HOME/gnomon/truth, else ~/.cache/gnomon/truth); nothing when neither
    /// variable names an absolute path.
    [[nodiscard]] static std::optional<std::filesystem::path> defaultFolder();

    /// Makes nothing until the first store. `max_bytes`: the most that all entries may take together; the least
    /// recently used go first. Only files with an entry's name or temporary name are ever removed from the folder.
    explicit Cache(std::filesystem::path folder, std::uint64_t max_bytes = 4ULL << 30);

    /// The truth of `key`, which is of `kind` and whose images are of `size_px`. Nothing when there is no entry, or one
    /// that is torn, of another version, kind or size, or with a value that no truth has: not a number, a visibility
    /// outside [0, 1], a point or normal that is not finite, a negative error or distance (it is then removed). Object
    /// and triangle numbers are not checked: the key says which scene they are of. Never throws.
    [[nodiscard]] std::optional<Traced> load(const scene::Hash128& key, const glm::uvec2& size_px, Kind kind) const;
    /// Returns false, with a sentence in `why` if given, when the entry could not be written; then only the folder may
    /// be left behind. Images must be all of one size, up to 16384 a side, with values that load() accepts. Never
    /// throws.
    bool store(const scene::Hash128& key, const Traced& traced, std::string* why = nullptr) const;

private:
    std::filesystem::path folder_;
    std::uint64_t max_bytes_;
};

} // namespace gnomon::truth
