// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include "interrupt.h"
#include "streams.h"

#include <fmt/format.h>

#include <algorithm>
#include <unistd.h>

namespace gnomon::app {

Progress::Progress(std::string label, std::uint64_t total)
    : label_(std::move(label)), total_(total), terminal_(total > 1 && ::isatty(STDERR_FILENO) != 0)
{
}

Progress::Progress(std::string label) : label_(std::move(label)), total_(0), terminal_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress()
{
    if (terminal_) {
        writeStderr("\r\033[K");
    }
}

void Progress::step()
{
    ++done_;
    if (isTime(done_ == total_)) {
        draw(total_ == 0 ? 1.0 : static_cast<double>(done_) / static_cast<double>(total_),
             fmt::format("{}/{}", done_, total_));
    }
    if (done_ < total_) {
        requireNotInterrupted();
    }
}

void Progress::show(double share)
{
    const double shown = std::clamp(share, 0.0, 1.0);
    if (isTime(shown == 1.0)) {
        draw(shown, fmt::format("{:.0f} %", 100.0 * shown));
    }
}

bool Progress::isTime(bool last)
{
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || (now - drawn_ < std::chrono::milliseconds(50) && !last)) {
        return false;
    }
    drawn_ = now;
    return true;
}

void Progress::draw(double share, const std::string& count)
{
    constexpr double kWidth = 40.0;
    const auto filled = static_cast<std::size_t>(kWidth * std::clamp(share, 0.0, 1.0));
    const std::string bar = fmt::format("\r\033[K{} [{:#<{}}{:.<{}}] {}", label_, "", filled, "",
                                        static_cast<std::size_t>(kWidth) - filled, count);
    writeStderr(bar);
}

} // namespace gnomon::app
