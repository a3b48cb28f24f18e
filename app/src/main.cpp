// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"
#include "interrupt.h"

#include "host/gpu.h"

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
    gnomon::app::haveLastWords();
    const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
    const int status = gnomon::app::runProgram(arguments);
    if (gnomon::host::anyDeviceAbandoned()) { // its driver's threads may be at work with what exit() takes down
        std::fflush(nullptr);
        std::_Exit(status);
    }
    return status;
}
