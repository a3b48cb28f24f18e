// SPDX-License-Identifier: Apache-2.0
// A line and status 1 where the program would end silently, in code or threads that are not ours.
#pragma once

namespace gnomon::app {

/// An exception that leaves a thread of a driver or library, mostly for want of memory, ends the program with a line.
/// So does a signal (SIGSEGV, SIGBUS, SIGABRT) where memory is limited (`ulimit -v`, `-d`): drivers on the CPU do not
/// check all their allocations. Without a limit signals keep their effect, for debuggers. Only main() calls it.
void haveLastWords() noexcept;

} // namespace gnomon::app
