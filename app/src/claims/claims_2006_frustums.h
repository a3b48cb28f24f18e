// SPDX-License-Identifier: Apache-2.0
// T. Forsyth's claims about many frustums a lamp: a part of claimsOf2006().
#pragma once

#include "claim.h"

namespace gnomon::app {

[[nodiscard]] const std::vector<Claim>& frustums2006();

} // namespace gnomon::app
