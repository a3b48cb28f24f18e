// SPDX-License-Identifier: Apache-2.0
// The pictures in a report's page.
#pragma once

#include "compare_result.h"
#include "host/scene_on_gpu.h"
#include "image/image.h"
#include "result_json.h"

#include <cstdint>

namespace gnomon::app {

/// The frame of `subject` shaded once with all light and once with none of its lights, without anti-aliasing, as
/// techniques are judged: any mask's picture lies between the two. Throws as host::FrameRenderer does.
[[nodiscard]] Shades drawShades(const host::SceneOnGpu& scene, const lab::Subject& subject, const Settings& settings);

/// More pixels of techniques' frames than this are shown smaller, so that a page stays one that a browser opens: some
/// 35 MB.
inline constexpr std::uint64_t kMostPagePixels = std::uint64_t{16} << 20U;
/// How many pixels on each side become one, for a page of `pixels`.
[[nodiscard]] std::uint32_t pageReduction(std::uint64_t pixels);
/// Means of squares of `reduction` pixels on a side; what is left at the right and below makes smaller ones.
[[nodiscard]] Image8 reduced(const Image8& picture, std::uint32_t reduction);

/// [{"frame", "reduction", "truth", "lit", "unlit", "densities", "techniques": [{"mask", "error", "classes",
/// "density"}]}] with PNGs as data: URIs, for each frame that is shown. "frame" is there only along a path; "density"
/// is a place in "densities", and is absent along a path. A sweep has no techniques.
[[nodiscard]] Json pagePictures(const CompareResult& result);

} // namespace gnomon::app
