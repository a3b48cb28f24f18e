// SPDX-License-Identifier: Apache-2.0
// Completion of a typed line. The program itself answers its shell, so the same tables complete a line and read it; the
// scripts of `gnomon completion SHELL` only ask and show.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

struct Candidate {
    std::string word;        // in the place of the whole word that is completed
    std::string description; // one line; may be empty
};

struct Completion {
    std::vector<Candidate> candidates;
    /// Files may follow too, by their extensions: "gltf glb". "/": folders alone. Empty: no files.
    std::string files;
    bool goes_on = false; // a word may go on after a candidate: no blank follows it
};

/// `words` are those after the program's name up to the cursor; the last one, which may be empty, is completed. There
/// is an answer to any words. Reads the scene that a line names, where names in it are asked for.
[[nodiscard]] Completion completionOf(std::span<const std::string> words);

/// The answer as the scripts read it: a line for each candidate, WORD, a tab and the description; then ":files", a tab
/// and the extensions, and ":nospace".
[[nodiscard]] std::string completionText(const Completion& completion);

[[nodiscard]] std::span<const std::string_view> shellNames();
/// The script of a shell of shellNames().
[[nodiscard]] std::string_view completionScript(std::string_view shell);

} // namespace gnomon::app
