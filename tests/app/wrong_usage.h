// SPDX-License-Identifier: Apache-2.0
// A wrong command line, and its expected result.
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

/// The text of a failed case for googletest, instead of its bytes.
void PrintTo(const Wrong& wrong, std::ostream* out);

/// One line of the program's on standard error, and nothing on standard output.
void expectOneLine(const Ran& ran, int status, const std::string& says);

/// expectOneLine() in a folder with a few files to name wrongly. Nothing may be added to the folder.
void expectOneLineAndNothingLeft(const Wrong& wrong, bool in_process);

} // namespace gnomon::test
