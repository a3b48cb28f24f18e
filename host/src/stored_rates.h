// SPDX-License-Identifier: Apache-2.0
// Rates of a device that were measured, kept between runs.
#pragma once

#include <gnomon/device_rates.h>

#include <filesystem>
#include <optional>

namespace gnomon::host {

/// Nothing when there is no file, or one that holds no rates.
[[nodiscard]] std::optional<DeviceRates> loadRates(const std::filesystem::path& file);
/// Throws Error where the file cannot be written, or there is no folder for it (an empty path).
void storeRates(const DeviceRates& rates, const std::filesystem::path& file);

} // namespace gnomon::host
