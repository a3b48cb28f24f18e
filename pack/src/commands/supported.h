// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gnomon/plan.h>

namespace gnomon::pack {

/// Throws Error where a light's options ask for what this backend does not do.
void checkSupported(const char* tried, const Plan& plan);

} // namespace gnomon::pack
