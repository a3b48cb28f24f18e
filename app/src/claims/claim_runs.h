// SPDX-License-Identifier: Apache-2.0
// Runs the commands of claims in this process and keeps what they found, so that claims may share a command.
#pragma once

#include "app/settings.h"
#include "result_json.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::app {

/// What one command found.
struct ClaimRun {
    Settings settings;
    Json json; // null of a command that draws a picture
};

/// Of the commands that a claim lists, in their order.
class ClaimRuns {
public:
    void add(std::string_view command, const ClaimRun& run);

    [[nodiscard]] std::size_t count() const { return runs_.size(); }
    [[nodiscard]] const Json& json(std::size_t run) const { return at(run).json; }
    /// The number that `pointer` leads to in a run's result for a technique, as the command writes it. NaN where it is
    /// null or missing. Throws Error when the run has no such technique: the table of claims is wrong.
    [[nodiscard]] double of(std::size_t run, std::string_view technique, const char* pointer) const;
    [[nodiscard]] double of(std::string_view technique, const char* pointer) const { return of(0, technique, pointer); }
    /// The number of one technique by that of another one, of the first run.
    [[nodiscard]] double ratio(std::string_view technique, std::string_view other, const char* pointer) const;
    /// Milliseconds of a technique's pass by its name; NaN where there is none.
    [[nodiscard]] double passMs(std::size_t run, std::string_view technique, std::string_view pass) const;
    /// Milliseconds of maps and the mask with its blur, which are all that a technique adds.
    [[nodiscard]] double shadowMs(std::size_t run, std::string_view technique) const;
    /// The number that `pointer` leads to in a run's JSON as a whole.
    [[nodiscard]] double number(std::size_t run, const char* pointer) const;

private:
    struct Named {
        std::string_view command;
        const ClaimRun* run;
    };
    [[nodiscard]] const ClaimRun& at(std::size_t run) const;
    [[nodiscard]] const Json& resultOf(std::size_t run, std::string_view technique) const;

    std::vector<Named> runs_;
};

/// All that were run until now.
class ClaimRunner {
public:
    /// `shared`: of --gpu and --validate, which every command that draws has too.
    explicit ClaimRunner(const Settings& shared);
    ~ClaimRunner(); // removes the pictures that commands drew
    ClaimRunner(const ClaimRunner&) = delete;
    ClaimRunner& operator=(const ClaimRunner&) = delete;

    /// Throws what the command would.
    const ClaimRun& run(std::string_view command);

private:
    [[nodiscard]] std::filesystem::path folder();
    [[nodiscard]] ClaimRun make(std::string_view command);

    const Settings& shared_;
    std::filesystem::path folder_; // empty: no command has drawn a picture
    std::map<std::string, std::unique_ptr<ClaimRun>, std::less<>> runs_;
};

/// "gnomon compare ring --light \"lantern 0\"" as a shell would part it, without the program's name. Precondition: it
/// begins with that.
[[nodiscard]] std::vector<std::string> argumentsOf(std::string_view command);

} // namespace gnomon::app
