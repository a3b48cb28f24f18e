// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include <gnomon/error.h>

#include <string>

namespace gnomon::truth {
namespace {

/// Whether eight lanes multiply and add in one rounding, which Embree's properties do not tell.
bool fusesMultiplyAdd()
{
#if defined(__x86_64__) || defined(__i386__)
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
    return true;
#endif
}

/// No AVX-512. GCC 12 compiled Debian's Embree 3.13 so that code for packets stores a mask register of 16 lanes in 2
/// bytes of the stack and reads 8 bytes back: unless the others are 0 by chance, rtcOccluded16() never comes to an end
/// (decision 259). AVX2 has no mask registers.
constexpr const char* kConfiguration =
#if defined(__x86_64__) || defined(__i386__)
    "threads=1,set_affinity=0,max_isa=avx2";
#else
    "threads=1,set_affinity=0";
#endif

std::uint64_t findIdentity()
{
    const DevicePointer device = newDevice();
    const auto has = [&](RTCDeviceProperty property) -> std::uint64_t {
        return rtcGetDeviceProperty(device.get(), property) != 0 ? 1 : 0;
    };
    const auto version =
        static_cast<std::uint64_t>(rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_VERSION)); // 31305 is 3.13.5
    return version << 8U | has(RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED) |
           has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) << 1U |
           has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) << 2U | (fusesMultiplyAdd() ? 8U : 0U);
}

} // namespace

DevicePointer newDevice()
{
    DevicePointer device(rtcNewDevice(kConfiguration));
    if (!device) {
        const RTCError error = rtcGetDeviceError(nullptr);
        throw Error("starting the ray tracer",
                    "Embree gave no device (error " + std::to_string(static_cast<int>(error)) + ")", {},
                    error == RTC_ERROR_OUT_OF_MEMORY ? ErrorKind::out_of_memory : ErrorKind::other);
    }
    return device;
}

std::uint64_t tracerIdentity()
{
    static const std::uint64_t kIdentity = findIdentity();
    return kIdentity;
}

} // namespace gnomon::truth
