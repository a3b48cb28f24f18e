// SPDX-License-Identifier: Apache-2.0
// A bar on stderr for work that takes a while; nothing unless stderr is a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace gnomon::app {

class Progress {
public:
    Progress(std::string label, std::uint64_t total);
    ~Progress(); // clears the line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void step();

private:
    std::string label_;
    std::uint64_t total_;
    std::uint64_t done_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point drawn_{};
};

/// A line on stderr that starts with the program's name.
void notice(const std::string& text);

} // namespace gnomon::app
