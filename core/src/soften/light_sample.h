// SPDX-License-Identifier: Apache-2.0
// The point of a light that one frame of soften=converge sees it from.
#pragma once

#include <gnomon/converge.h>
#include <gnomon/frame.h>
#include <gnomon/plan.h>

namespace gnomon {

/// Precondition: checkLight() is ok.
[[nodiscard]] LightSample sampleOf(const Light& light, const ConvergeSample& sample);
/// The light as it shines from there.
[[nodiscard]] Light sampledLight(const Light& light, const LightSample& sample);

} // namespace gnomon
