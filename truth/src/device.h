// SPDX-License-Identifier: Apache-2.0
// The Embree device.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <memory>

namespace gnomon::truth {

struct DeviceDeleter {
    using pointer = RTCDevice;
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using DevicePointer = std::unique_ptr<RTCDevice, DeviceDeleter>;

/// One thread builds on it, so that a structure, and with it the choice between equally near triangles, is always the
/// same. Throws Error when Embree does not start.
[[nodiscard]] DevicePointer newDevice();

/// A number for Embree's version and the instructions that it uses here, which both decide the last bits of its
/// results. Found once; threads may ask at the same time. Throws Error when Embree does not start.
[[nodiscard]] std::uint64_t tracerIdentity();

} // namespace gnomon::truth
