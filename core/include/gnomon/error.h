// SPDX-License-Identifier: Apache-2.0
// The one exception type: a failure of the outside world (unreadable file, no driver, out of memory, lost device).
// Expected outcomes are values (plan.h: Outcome); programming errors are assertions.
#pragma once

#include <stdexcept>
#include <string>

namespace gnomon {

/// what() is one line: what was tried, what was found, what to do about it (where there is something to do).
class Error : public std::runtime_error {
public:
    Error(const std::string& tried, const std::string& found, const std::string& todo = {});

    [[nodiscard]] const std::string& tried() const { return tried_; }
    [[nodiscard]] const std::string& found() const { return found_; }
    [[nodiscard]] const std::string& todo() const { return todo_; }

private:
    std::string tried_;
    std::string found_;
    std::string todo_;
};

} // namespace gnomon
