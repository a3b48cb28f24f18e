// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::test {

/// Marks the running case as one that draws: a process that it started may give work to a driver unseen.
void noteDrawing();

} // namespace gnomon::test
