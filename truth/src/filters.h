// SPDX-License-Identifier: Apache-2.0
// The filters that Embree calls at each hit. The geometry's user pointer is the array of parts, by object.
#pragma once

#include <embree3/rtcore.h>

namespace gnomon::truth {

/// For rays that look for the nearest hit: from a camera, and towards a light's centre.
void filterNearest(const RTCFilterFunctionNArguments* args);
/// For rays that ask only whether anything is hit.
void filterAny(const RTCFilterFunctionNArguments* args);

} // namespace gnomon::truth
