// SPDX-License-Identifier: Apache-2.0
#include "gltf/context.h"

#include <gnomon/error.h>

#include <algorithm>

namespace gnomon::scene::gltf {

namespace {

/// Notices are for people: beyond this many nobody reads on, and a hostile file must not fill memory with them.
constexpr std::size_t kMaxNotices = 100;

/// Adds without wrapping; a sum that would wrap is over every limit anyway.
std::uint64_t saturatingAdd(std::uint64_t a, std::uint64_t b)
{
    const std::uint64_t sum = a + b;
    return sum < a ? UINT64_MAX : sum;
}

} // namespace

void Context::fail(std::string_view where, const std::string& what, const std::string& found,
                   const std::string& todo) const
{
    std::string text = what;
    if (where != kWholeFile) {
        text += " at " + (where.empty() ? std::string("/") : std::string(where)); // "" is the pointer to the root
    }
    if (!found.empty()) {
        text += ": found " + found;
    }
    throw Error("cannot load " + label_, text, todo);
}

void Context::failLimit(std::string_view where, const std::string& what, std::string_view name, std::uint64_t limit,
                        std::uint64_t found) const
{
    fail(where, what + " is over the limit " + std::string(name) + "=" + std::to_string(limit), std::to_string(found),
         "if you trust the file, raise the limit with --limit " + std::string(name) + "=N");
}

void Context::noteFile(std::uint64_t bytes)
{
    file_bytes_ = saturatingAdd(file_bytes_, bytes);
}

void Context::chargeBytes(std::uint64_t bytes, std::string_view where)
{
    bytes_ = saturatingAdd(bytes_, bytes);
    if (bytes_ > limits_.max_total_bytes) {
        failLimit(where, "the total of bytes read and decoded", "total-bytes", limits_.max_total_bytes, bytes_);
    }
    // Divided, not multiplied, so that nothing wraps.
    if (bytes_ > Limits::kFreeBytes &&
        (bytes_ - Limits::kFreeBytes) / std::max<std::uint64_t>(file_bytes_, 1) > limits_.max_growth) {
        failLimit(where, "the memory that a file of " + std::to_string(file_bytes_) + " bytes asks for", "growth",
                  limits_.max_growth, bytes_ / std::max<std::uint64_t>(file_bytes_, 1));
    }
}

void Context::chargeVertices(std::uint64_t count, std::string_view where)
{
    vertices_ = saturatingAdd(vertices_, count);
    if (vertices_ > limits_.max_vertices) {
        failLimit(where, "the total of vertices and indices", "vertices", limits_.max_vertices, vertices_);
    }
}

void Context::chargeChecks(std::uint64_t count, std::string_view where)
{
    checks_ = saturatingAdd(checks_, count);
    if (checks_ > limits_.max_vertices) {
        failLimit(where, "the total of accessor elements", "vertices", limits_.max_vertices, checks_);
    }
}

void Context::checkCount(std::uint64_t count, std::string_view where) const
{
    if (count > limits_.max_count) {
        failLimit(where, "the number of items", "count", limits_.max_count, count);
    }
}

void Context::checkFileBytes(std::uint64_t bytes, std::string_view where) const
{
    if (bytes > limits_.max_file_bytes) {
        failLimit(where, "the size of a file or data URI in bytes", "file-bytes", limits_.max_file_bytes, bytes);
    }
}

void Context::notice(const std::string& sentence)
{
    if (notices_.size() < kMaxNotices && std::find(notices_.begin(), notices_.end(), sentence) == notices_.end()) {
        notices_.push_back(sentence);
    }
}

} // namespace gnomon::scene::gltf
