// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <csignal>
#include <unistd.h>

namespace gnomon::app {
namespace {

constexpr int kShellBase = 128; // shells add it to the number of a signal that ended a program

std::atomic<int> first_signal{0};
std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may touch no other atomics");

extern "C" void onSignal(int number)
{
    // The number is set before the flag, so that a reader of the flag knows the signal. When two signals come at the
    // same time, to two threads or one in the other's handler, one is the first.
    int none = 0;
    if (!first_signal.compare_exchange_strong(none, number)) {
        ::_exit(kShellBase + number);
    }
    flag = true;
}

} // namespace

void watchForInterrupts()
{
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        ::sigaction(number, nullptr, &before);
        if (before.sa_handler == SIG_IGN) {
            continue;
        }
        struct sigaction action {};
        action.sa_handler = onSignal;
        action.sa_flags = SA_RESTART; // reads and writes of drivers and libraries go on
        ::sigemptyset(&action.sa_mask);
        ::sigaction(number, &action, nullptr);
    }
}

const std::atomic<bool>& interruptFlag()
{
    return flag;
}

int interruptStatus()
{
    return kShellBase + first_signal;
}

void requireNotInterrupted()
{
    if (flag) {
        throw Interrupted();
    }
}

} // namespace gnomon::app
