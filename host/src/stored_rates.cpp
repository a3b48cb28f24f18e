// SPDX-License-Identifier: Apache-2.0
#include "stored_rates.h"

#include "cache_file.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace gnomon::host {
namespace {

constexpr double DeviceRates::*kRates[] = {
    &DeviceRates::rest_ns,         &DeviceRates::caster_ns,  &DeviceRates::texel_ns,  &DeviceRates::block_texel_ns,
    &DeviceRates::moment_texel_ns, &DeviceRates::compare_ns, &DeviceRates::search_ns, &DeviceRates::ray_ns};
using Numbers = std::array<double, std::size(kRates)>;

} // namespace

std::optional<DeviceRates> loadRates(const std::filesystem::path& file)
{
    const std::string bytes = readCached(file);
    Numbers numbers{};
    if (bytes.size() != sizeof numbers) {
        return std::nullopt;
    }
    std::memcpy(numbers.data(), bytes.data(), sizeof numbers);
    if (std::ranges::any_of(numbers, [](double ns) { return !std::isfinite(ns) || ns < 0.0; })) {
        return std::nullopt;
    }
    DeviceRates rates;
    rates.source = RateSource::measured;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        rates.*kRates[i] = numbers[i];
    }
    return rates;
}

void storeRates(const DeviceRates& rates, const std::filesystem::path& file)
{
    if (file.empty()) {
        throw Error("keeping the device's rates", "neither XDG_CACHE_HOME nor HOME names a folder", "set one of them");
    }
    Numbers numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = rates.*kRates[i];
    }
    std::string bytes(sizeof numbers, '\0');
    std::memcpy(bytes.data(), numbers.data(), sizeof numbers);
    writeCached(file, bytes);
}

} // namespace gnomon::host
