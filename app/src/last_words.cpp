// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include "streams.h"

#include <csignal>
#include <exception>
#include <new>
#include <string_view>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace gnomon::app {
namespace {

constexpr int kFailed = 1;

/// Whatever locks and half-made things there are: nothing is called but what may be called anywhere.
[[noreturn]] void end(std::string_view words)
{
    notice(words);
    ::_exit(kFailed);
}

[[noreturn]] void onTerminate()
{
    try {
        if (const std::exception_ptr left = std::current_exception()) {
            std::rethrow_exception(left);
        }
    } catch (const std::bad_alloc&) {
        end("out of memory in a driver or library; a smaller --size or --map-size, or more memory (ulimit -v), may do");
    } catch (const std::system_error& error) {
        end(error.code() == std::errc::resource_unavailable_try_again
                ? "a driver or library was given no thread; allow more processes (ulimit -u)"
                : error.what());
    } catch (const std::exception& error) {
        end(error.what());
    } catch (...) {
    }
    end("a driver or library gave up");
}

extern "C" void onFall(int)
{
    end("a driver or library fell, most likely for want of memory, which is limited; "
        "raise the limit (ulimit -v or -d), or take a smaller --size or --map-size");
}

bool isLimited(decltype(RLIMIT_AS) what) noexcept
{
    rlimit limit{};
    return ::getrlimit(what, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

} // namespace

void haveLastWords() noexcept
{
    std::set_terminate(onTerminate);
    if (!isLimited(RLIMIT_AS) && !isLimited(RLIMIT_DATA)) {
        return;
    }
    struct sigaction action {};
    action.sa_handler = onFall;
    ::sigemptyset(&action.sa_mask);
    for (const int number : {SIGSEGV, SIGBUS, SIGABRT}) {
        ::sigaction(number, &action, nullptr);
    }
}

} // namespace gnomon::app
