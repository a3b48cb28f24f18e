// SPDX-License-Identifier: Apache-2.0
// What T. Forsyth claims of depth aliasing and soft edges: a part of claimsOf2006().
#pragma once

#include "claim.h"

namespace gnomon::app {

[[nodiscard]] const std::vector<Claim>& depths2006();

} // namespace gnomon::app
