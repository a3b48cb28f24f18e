// SPDX-License-Identifier: Apache-2.0
// A command line that is wrong, and what is to come of it.
#pragma once

#include "process.h"

#include <ostream>
#include <string>
#include <vector>

namespace gnomon::test {

struct Wrong {
    const char* name;
    std::vector<std::string> arguments;
    int status;
    std::string says; // part of the line
};

/// What googletest prints of a failed case, instead of its bytes.
void PrintTo(const Wrong& wrong, std::ostream* out);

/// One line of the program's on standard error, and nothing on standard output.
void expectOneLine(const Ran& ran, int status, const std::string& says);

/// The same in a folder that has a few files to be wrong about, to which nothing is added.
void expectOneLineAndNothingLeft(const Wrong& wrong, bool in_process);

} // namespace gnomon::test
