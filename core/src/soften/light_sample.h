// SPDX-License-Identifier: Apache-2.0
// The point of a light that one frame of soften=converge sees it from.
#pragma once

#include <gnomon/converge.h>
#include <gnomon/frame.h>
#include <gnomon/plan.h>

namespace gnomon {

/// Precondition: checkLight() is ok.
[[nodiscard]] LightSample sampleOf(const Light& light, const ConvergeSample& sample);

} // namespace gnomon
