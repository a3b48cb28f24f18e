// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include <fmt/format.h>

#include <cstdio>
#include <unistd.h>

namespace gnomon::app {

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)), total_(total), terminal_(total > 1 && ::isatty(STDERR_FILENO) != 0)
{
}

Progress::~Progress()
{
    if (terminal_) {
        std::fputs("\r\033[K", stderr);
    }
}

void Progress::step()
{
    ++done_;
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || (now - drawn_ < std::chrono::milliseconds(50) && done_ != total_)) {
        return;
    }
    drawn_ = now;
    constexpr std::uint64_t kWidth = 40;
    const std::uint64_t filled = total_ == 0 ? kWidth : kWidth * done_ / total_;
    const std::string bar =
        fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {}/{}", label_, "", filled, "", kWidth - filled, done_, total_);
    std::fputs(bar.c_str(), stderr);
    std::fflush(stderr);
}

void notice(const std::string& text)
{
    fmt::print(stderr, "gnomon: {}\n", text);
}

} // namespace gnomon::app
