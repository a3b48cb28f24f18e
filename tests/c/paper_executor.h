// SPDX-License-Identifier: Apache-2.0
// Carries out commands on paper: every image and buffer that a command names is there, large enough, and of the right
// kind. A failure is one of the test that runs it.
#pragma once

#include <gnomon/gnomon.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace gnomon::test {

class PaperExecutor {
public:
    /// The host's images have this size.
    PaperExecutor(std::uint32_t width, std::uint32_t height);

    void run(const GnomonCommandList* list);
    void forget();

    [[nodiscard]] std::uint32_t ran(GnomonCommandKind kind) const;
    [[nodiscard]] const std::set<std::string>& modules() const { return modules_; }

private:
    using Name = std::pair<std::uint32_t, std::uint32_t>;
    struct Image {
        std::string format;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::uint32_t layers = 0;
        std::uint32_t levels = 1;
        std::uint32_t samples = 1;
    };
    [[nodiscard]] const Image& imageOf(const std::uint32_t (&name)[2]) const;
    [[nodiscard]] std::uint64_t bytesOf(const std::uint32_t (&name)[2]) const;
    void runOne(const GnomonCommandList& list, const GnomonCommand& command);
    void drop(std::uint32_t options);
    void make(const GnomonCommand& command);
    void write(const GnomonCommandList& list, const GnomonCommand& command);
    void copy(const GnomonCommand& command) const;
    void aim(const GnomonCommand& command) const;
    void bind(const GnomonCommandList& list, const GnomonCommand& command);

    std::map<Name, Image> images_;
    std::map<Name, std::uint64_t> buffers_; // bytes
    std::map<Name, std::uint64_t> written_; // by the list that is run: the end of what is written, bytes
    std::map<std::uint32_t, std::uint32_t> ran_;
    std::set<std::string> modules_;
};

} // namespace gnomon::test
