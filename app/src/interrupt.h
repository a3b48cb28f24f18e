// SPDX-License-Identifier: Apache-2.0
// Ending a run from outside. SIGINT, SIGTERM and SIGHUP only set a flag; long work looks at it between its steps
// (Progress does so by itself), so that files and devices are given back in order. A second signal ends the program at
// once.
#pragma once

#include <atomic>
#include <exception>

namespace gnomon::app {

/// Not an error: the run was asked to end.
class Interrupted : public std::exception {
public:
    [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
};

/// Starts to watch for the signals. One that is ignored already, as in the background of a script, stays so.
void watchForInterrupts();
/// True once a signal came. For work that polls by itself.
[[nodiscard]] const std::atomic<bool>& interruptFlag();
/// 128 + the first signal's number: 130 for SIGINT, 143 for SIGTERM, 129 for SIGHUP. Precondition: one came.
[[nodiscard]] int interruptStatus();
/// Throws Interrupted once a signal came.
void requireNotInterrupted();

/// An exception that leaves a thread of a driver or library, mostly for want of memory, ends the program with a line.
/// So does a signal (SIGSEGV, SIGBUS, SIGABRT) where memory is limited (`ulimit -v`, `-d`): drivers on the CPU do not
/// check all their allocations. Without a limit signals keep their effect, for debuggers. Only main() calls it.
void haveLastWords() noexcept;

} // namespace gnomon::app
