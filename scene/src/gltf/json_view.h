// SPDX-License-Identifier: Apache-2.0
// A JSON value together with the pointer that leads to it. Every getter checks type and range and fails with that
// pointer, so nothing read through a view is unchecked.
#pragma once

#include "gltf/context.h"
#include "scene/json.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene::gltf {

/// readJson() of scene/json.h, with what is wrong said by the context.
[[nodiscard]] JsonTree<nlohmann::json> parseJson(Context& context, std::span<const std::byte> text);

class JsonView {
public:
    JsonView(Context& context, const nlohmann::json& value, std::string pointer)
        : context_(&context), value_(&value), pointer_(std::move(pointer))
    {
    }

    [[nodiscard]] Context& context() const { return *context_; }
    [[nodiscard]] const nlohmann::json& value() const { return *value_; }
    [[nodiscard]] const std::string& pointer() const { return pointer_; }

    /// Member of an object; fails when this is no object.
    [[nodiscard]] std::optional<JsonView> find(std::string_view key) const;
    /// Member of an object; fails when it is missing.
    [[nodiscard]] JsonView at(std::string_view key) const;
    [[nodiscard]] bool has(std::string_view key) const { return find(key).has_value(); }
    void expectObject() const;

    /// Length of an array. glTF has no empty arrays, and ours have a limit.
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] JsonView element(std::size_t i) const;

    [[nodiscard]] std::string string() const;
    [[nodiscard]] bool boolean() const;
    /// Finite, and finite as a float too.
    [[nodiscard]] float number(double low = -std::numeric_limits<float>::max(),
                               double high = std::numeric_limits<float>::max()) const;
    [[nodiscard]] double rawNumber() const;
    [[nodiscard]] std::uint64_t uint(std::uint64_t low = 0, std::uint64_t high = kMaxInteger) const;
    /// An index into something with `count` entries.
    [[nodiscard]] std::uint32_t index(std::size_t count) const;
    /// An array of exactly out.size() numbers.
    void numbers(std::span<float> out, double low = -std::numeric_limits<float>::max(),
                 double high = std::numeric_limits<float>::max()) const;

    // Members with defaults.
    [[nodiscard]] std::string string(std::string_view key, const std::string& otherwise) const;
    [[nodiscard]] bool boolean(std::string_view key, bool otherwise) const;
    [[nodiscard]] float number(std::string_view key, float otherwise, double low, double high) const;
    [[nodiscard]] std::uint64_t uint(std::string_view key, std::uint64_t otherwise) const;
    [[nodiscard]] std::uint32_t index(std::string_view key, std::size_t count) const; // kNone when absent

    [[noreturn]] void fail(const std::string& what, const std::string& todo = {}) const;
    [[noreturn]] void failFound(const std::string& what, const std::string& found, const std::string& todo = {}) const;

    /// Integers up to here are exact in every JSON parser.
    static constexpr std::uint64_t kMaxInteger = (1ULL << 53) - 1;

private:
    [[nodiscard]] std::string shown() const;

    Context* context_;
    const nlohmann::json* value_;
    std::string pointer_;
};

} // namespace gnomon::scene::gltf
