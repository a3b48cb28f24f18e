// SPDX-License-Identifier: Apache-2.0
// A bar on stderr for work that takes a while; nothing unless stderr is a terminal. Its steps are where a run that is
// asked to end does end.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace gnomon::app {

class Progress {
public:
    /// Work of `total` steps.
    Progress(std::string label, std::uint64_t total);
    /// Work whose share done is known.
    explicit Progress(std::string label);
    ~Progress(); // clears the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Throws Interrupted when the run is to end and this was not the last step: what is done is done.
    void step();
    /// [0, 1]. Never throws: for callbacks of work that polls interruptFlag() itself.
    void show(double share);

private:
    bool isTime(bool last);
    void draw(double share, const std::string& count);

    std::string label_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point drawn_{};
};

} // namespace gnomon::app
