// SPDX-License-Identifier: Apache-2.0
// The rest of claims_2006.cpp: ids in place of depth, smoothies, shadow volumes.
#pragma once

#include "claim.h"

namespace gnomon::app {

[[nodiscard]] const std::vector<Claim>& ids2006();

} // namespace gnomon::app
