// SPDX-License-Identifier: Apache-2.0
#include <gnomon/error.h>

namespace gnomon {
namespace {

std::string oneLine(const std::string& tried, const std::string& found, const std::string& todo)
{
    std::string line = tried + ": " + found;
    if (!todo.empty()) {
        line += "; " + todo;
    }
    // The program prints what() as one line, whatever a file name or a driver's message brings along.
    for (char& c : line) {
        if (c == '\n' || c == '\r') {
            c = ' ';
        }
    }
    return line;
}

} // namespace

Error::Error(const std::string& tried, const std::string& found, const std::string& todo, ErrorKind kind)
    : std::runtime_error(oneLine(tried, found, todo)), tried_(tried), found_(found), todo_(todo), kind_(kind)
{
}

} // namespace gnomon
