// SPDX-License-Identifier: Apache-2.0
// JSON of a technique, a camera and a light, the same for every result file. Key order is fixed; a number that is
// absent or not finite is null.
#pragma once

#include "app/settings.h"
#include "host/frame_renderer.h"
#include "lab/metrics/error.h"
#include "lab/metrics/error_classes.h"
#include "lab/texel_density.h"
#include "lab/timing.h"
#include "result_json.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::app {

using MemoryByPurpose = std::vector<std::pair<std::string, std::uint64_t>>;

[[nodiscard]] Json numberJson(double value);
[[nodiscard]] Json numberJson(const std::optional<double>& value);
[[nodiscard]] Json vectorJson(const glm::dvec3& vector);

/// Median of the whole frame, ms; 0 without samples.
[[nodiscard]] double frameMedian(const std::vector<host::FrameTimes>& samples);

/// Sentences about measurements that the device lacks for these frames; empty when it measured all.
[[nodiscard]] std::vector<std::string> notMeasured(const std::vector<host::FrameTimes>& samples);

/// PREFIXtime_ms and PREFIXiqr_ms: {"plan", "maps", "filter", "mask", "frame"}; null for stages that are not measured,
/// and for the range of one sample.
void addTimes(Json& json, const std::string& prefix, const std::vector<host::FrameTimes>& samples);
/// "memory_bytes" and "memory_by_purpose_bytes".
void addMemory(Json& json, const MemoryByPurpose& memory);
/// {"texels", "bytes", "format", "image_layers", "mip_levels"}: texels of all maps, bytes of their image with all that
/// it has for each texel: image layers (lvsm) and mip levels.
[[nodiscard]] Json mapJson(const MapPages& atlas, const ShadowOptions& options);
/// Every pass of the host and the library in order: [{"name", "ms", "iqr_ms", "share", counts, "texels",
/// "bytes_minimum"}]. Passes of one name are one, as the stages are. Null: iqr_ms of one sample, share where the clock
/// measured no frame, times and counts that the device did not give, and members that are not defined for the pass.
[[nodiscard]] Json passesJson(const lab::Timed& timed);
/// How the maps of cascades were drawn when these times were taken; null where there are none, or never two at once.
[[nodiscard]] Json cascadePassJson(const lab::Timed& timed);
[[nodiscard]] Json countersJson(const lab::Counters& counters);
/// How many maps and objects frames drew, kept or culled: a row for each member of vulkan::MapReuse, means per frame.
struct ReuseCounter {
    std::string_view name; // in JSON
    std::string_view title;
    double mean = 0.0;
};
[[nodiscard]] std::vector<ReuseCounter> reuseCounters(const std::vector<host::FrameTimes>& samples);
/// reuseCounters() by name.
[[nodiscard]] Json reuseJson(const std::vector<host::FrameTimes>& samples);
/// {"rmse", "mae", "bias", "p99", "edge", "acne", "detached", "bleeding", "terminator"}, with `more` before the
/// classes; null where no pixel counts.
[[nodiscard]] Json errorJson(const std::optional<lab::ErrorNumbers>& error,
                             const std::optional<lab::ClassErrors>& classes, const Json& more = Json::object());
/// The member of a value; null where there is no value.
template <typename T>
[[nodiscard]] Json memberJson(const std::optional<T>& value, double T::*member)
{
    return value ? numberJson((*value).*member) : Json(nullptr);
}
/// {"p01", "p50", "p99", "pixels": {"counted", "left_out"}}; percentiles are null when no pixel counts.
[[nodiscard]] Json densityJson(const lab::TexelDensity& density);
/// The median frame divided by that without shadows; null where the clock measured none.
[[nodiscard]] Json frameRatioJson(const lab::Timed& technique);
/// Null when no pixel counts.
[[nodiscard]] Json fitEfficiencyJson(const lab::TexelDensity& density, double fit_efficiency);
/// Units of the keys that do not name theirs and that every result has.
[[nodiscard]] Json sharedUnitsJson();
/// The settings of one technique, as a preset has them: without values that follow from others (the filter's own
/// format, the border that a kernel needs, which differ between techniques) and without the place of the result.
[[nodiscard]] Json repeatJson(const Settings& settings, std::uint32_t subcommand);
/// The settings that repeat the whole run: with the scene, its hash and the list of techniques too.
[[nodiscard]] Json runJson(const Settings& settings, std::string_view scene_hash, std::uint32_t subcommand);
/// {"name", "frames": {"first", "last"}, "fps", "speed"}. Precondition: there is a --path.
[[nodiscard]] Json pathJson(const Settings& settings);
/// Where the picture is taken from, resolved; near_m and far_m are 0 where the scene's size decides.
[[nodiscard]] Json eyeJson(const host::Eye& eye);
/// The light, resolved: members without meaning for its type are left out.
[[nodiscard]] Json lightJson(const host::ShadedLight& light);

} // namespace gnomon::app
