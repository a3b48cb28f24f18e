// SPDX-License-Identifier: Apache-2.0
// Another program at work beside this one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace gnomon::app::view {

class Child {
public:
    /// `command`: the program, looked for as a shell does, and its arguments. Throws Error where it cannot be started.
    explicit Child(const std::vector<std::string>& command);
    /// Ends it and what it has started.
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Nothing while it is at work; then its exit status, -1 where a signal ended it. Does not wait.
    [[nodiscard]] std::optional<int> look();
    /// What it has said so far, errors too; a megabyte at most.
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void hear();

    pid_t id_ = -1;
    int pipe_ = -1;
    std::string text_;
    std::optional<int> status_;
};

} // namespace gnomon::app::view
