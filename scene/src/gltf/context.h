// SPDX-License-Identifier: Apache-2.0
// Shared by every part of the glTF reader: the report of a failure, and the file's use of its limits.
#pragma once

#include "scene/gltf.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene::gltf {

/// For failures that have no place within the file.
inline constexpr std::string_view kWholeFile = "(whole file)";

class Context {
public:
    Context(std::string label, std::filesystem::path folder, const Limits& limits)
        : label_(std::move(label)), folder_(std::move(folder)), limits_(limits)
    {
    }

    /// Throws Error: "cannot load FILE: WHAT at WHERE: found FOUND; ADVICE". `where` is a JSON pointer, "byte N" before
    /// there is JSON, or kWholeFile.
    [[noreturn]] void fail(std::string_view where, const std::string& what, const std::string& found = {},
                           const std::string& todo = {}) const;
    /// A limit of `Limits` is exceeded; `name` is the flag's name for it.
    [[noreturn]] void failLimit(std::string_view where, const std::string& what, std::string_view name,
                                std::uint64_t limit, std::uint64_t found) const;

    /// Counts bytes of files, with which the limit of decoded bytes grows. Call it before their bytes are charged.
    void noteFile(std::uint64_t bytes);
    /// Counts bytes about to be read or allocated; throws when they pass total-bytes, or are out of proportion to the
    /// files. Call it before allocating.
    void chargeBytes(std::uint64_t bytes, std::string_view where);
    /// Counts vertices or indices about to be produced.
    void chargeVertices(std::uint64_t count, std::string_view where);
    /// Counts elements about to be checked: a file may name one buffer in a million accessors.
    void chargeChecks(std::uint64_t count, std::string_view where);
    void checkCount(std::uint64_t count, std::string_view where) const;
    void checkFileBytes(std::uint64_t bytes, std::string_view where) const;

    /// Keeps a sentence, each once.
    void notice(const std::string& sentence);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const Limits& limits() const { return limits_; }
    [[nodiscard]] const std::string& label() const { return label_; }
    [[nodiscard]] std::vector<std::string> takeNotices() { return std::move(notices_); }

private:
    std::string label_;
    std::filesystem::path folder_;
    Limits limits_;
    std::uint64_t bytes_ = 0;
    std::uint64_t file_bytes_ = 0;
    std::uint64_t vertices_ = 0;
    std::uint64_t checks_ = 0;
    std::vector<std::string> notices_;
};

} // namespace gnomon::scene::gltf
