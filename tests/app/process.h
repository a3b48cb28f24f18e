// SPDX-License-Identifier: Apache-2.0
// Runs the program: its entry in this process, or the built program as a user would.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::test {

struct Ran {
    int status = -1; // exit status; 128 + N when signal N ended it
    std::string out;
    std::string err;

    /// Lines of `err`, notices about the device left out.
    [[nodiscard]] std::vector<std::string> errorLines() const;
};

/// The target of a stream of the program.
enum class Stream : std::uint8_t {
    caught, // to Ran
    closed,
    full,   // a device that is
    broken, // a pipe that nobody has open for reading
    unread  // a pipe that is not emptied
};

struct How {
    std::filesystem::path folder;                                 // working folder
    std::vector<std::pair<std::string, std::string>> environment; // added to ours
    bool in_process = true; // false: the built program, which any of the following needs too
    rlim_t max_file_bytes = RLIM_INFINITY;
    Stream out = Stream::caught;
    Stream err = Stream::caught;
    int signal = 0;                    // 0: none is sent; else sent once both of these hold
    std::string signal_at;             // standard error has this
    std::filesystem::path signal_when; // there is such a file; empty: need not be
};

/// In this process the working folder, the environment and the descriptors of standard output and error are the
/// program's while it runs, so no other thread may need them. Truths are kept in a folder of the test program, never in
/// the user's, unless `environment` names one.
[[nodiscard]] Ran gnomon(const std::vector<std::string>& arguments, const How& how);

} // namespace gnomon::test
