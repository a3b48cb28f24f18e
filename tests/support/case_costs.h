// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::test {

/// The case that runs counts as drawn: what it started may hand work to a driver where this process does not see it.
void noteDrawing();

} // namespace gnomon::test
