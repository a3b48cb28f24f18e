// SPDX-License-Identifier: Apache-2.0
#include "app/command_line.h"

#include <string>
#include <vector>

int main(int argc, char** argv)
{
    const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
    return gnomon::app::runProgram(arguments);
}
