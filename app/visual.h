// SPDX-License-Identifier: Apache-2.0
// Shared by all that draws: the device by the settings, validation, masks as images.
#pragma once

#include "app/settings.h"
#include "host/gpu.h"
#include "image/image.h"

#include <memory>

namespace gnomon::host {
class Window;
}

namespace gnomon::app {

/// Opens the device, one that draws in `window` where that is given; says on stderr when it is a software rasteriser
/// that nobody asked for. Throws Error, also when the picture or the map is larger than the device can draw.
[[nodiscard]] std::unique_ptr<host::Gpu> openGpu(const Settings& settings, const host::Window* window = nullptr,
                                                 const vulkan::ShaderHook& shaders = {});
/// With --validate: throws Error with the first validation message, when there is one.
void requireSilence(const host::Gpu& gpu);
/// [0, 1] to 0 .. 65535, to nearest; NaN becomes 0, so that it shows.
[[nodiscard]] Image16 maskAs16Bit(const ImageF& mask);

} // namespace gnomon::app
