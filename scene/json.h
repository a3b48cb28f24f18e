// SPDX-License-Identifier: Apache-2.0
// The reader of all JSON from outside: glTF files, presets (results among them) and paths. The JSON library's own tree
// builder accepts duplicate keys, keeps no pointer for its errors and knows no depth; this one is driven by the same
// parser's events. Later steps (copying, printing, destroying) may recurse as deep as the tree, so the depth is limited
// here, once.
#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// Arrays and objects within each other; deeper than any glTF, preset or path needs.
inline constexpr std::size_t kMaxJsonDepth = 128;

/// `key` as one step of a JSON pointer (RFC 6901).
[[nodiscard]] std::string escapeKey(std::string_view key);

/// The owner of a text: reports errors in it, and counts the memory that reading takes.
class JsonOwner {
public:
    virtual ~JsonOwner() = default;
    /// Throws. `pointer` is empty for the whole text; `found` and `todo` may be empty.
    [[noreturn]] virtual void fail(const std::string& pointer, const std::string& what, const std::string& found,
                                   const std::string& todo) const = 0;
    /// Counts memory before it is taken; may throw.
    virtual void charge(std::uint64_t /*bytes*/) {}
};

/// Leaves an array or object empty, from its leaves on, which takes no memory. nlohmann's own destructor allocates
/// memory for the contents, and without any it ends the program. `value` is nested kMaxJsonDepth levels at most.
template <typename Json>
void takeApart(Json& value) noexcept
{
    if (value.is_array()) {
        auto& array = value.template get_ref<typename Json::array_t&>();
        for (Json& element : array) {
            takeApart(element);
        }
        array.clear();
    } else if (value.is_object()) {
        auto& object = value.template get_ref<typename Json::object_t&>();
        for (auto& member : object) {
            takeApart(member.second);
        }
        object.clear();
    }
}

/// A tree that was read, which can be destroyed without memory.
template <typename Json>
class JsonTree {
public:
    explicit JsonTree(Json&& root) noexcept : root_(std::move(root)) {}
    JsonTree(JsonTree&& other) noexcept : root_(std::move(other.root_)) {}
    JsonTree& operator=(JsonTree&&) = delete;
    ~JsonTree() { takeApart(root_); }

    [[nodiscard]] const Json& root() const { return root_; }

private:
    Json root_;
};

namespace detail {

/// The least memory of one value, with its place in a map; keeps a 1 GB file of "[0,0,0,..." within bounds.
inline constexpr std::uint64_t kBytesPerJsonValue = 32;

/// The parser's sentence without its "[json.exception...] ", on one line and short, since it quotes the text.
[[nodiscard]] std::string shortReason(std::string_view text);

template <typename Json>
class TreeBuilder final : public nlohmann::json_sax<Json> {
    using Base = nlohmann::json_sax<Json>;
    static constexpr bool kOrdered = std::is_same_v<Json, nlohmann::ordered_json>;

public:
    explicit TreeBuilder(JsonOwner& owner) : owner_(owner) {}
    ~TreeBuilder() override { takeApart(root_); }
    TreeBuilder(const TreeBuilder&) = delete;
    TreeBuilder& operator=(const TreeBuilder&) = delete;

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(typename Base::number_integer_t value) override { return add(value); }
    bool number_unsigned(typename Base::number_unsigned_t value) override { return add(value); }
    bool number_float(typename Base::number_float_t value, const std::string& /*text*/) override { return add(value); }
    bool string(std::string& value) override
    {
        owner_.charge(value.size());
        return add(std::move(value));
    }
    bool binary(typename Base::binary_t& /*value*/) override { return false; } // JSON text has none

    bool start_object(std::size_t /*size*/) override { return open(Json::object()); }
    bool start_array(std::size_t /*size*/) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(std::string& key) override
    {
        owner_.charge(key.size());
        bool twice = false;
        if constexpr (kOrdered) { // whose own search is linear
            owner_.charge(key.size());
            twice = !names_.back().insert(key).second;
        } else {
            twice = stack_.back()->contains(key);
        }
        if (twice) {
            owner_.fail(pointer(), "an object has the same key twice", "'" + escapeKey(key) + "'", {});
        }
        key_ = std::move(key);
        return true;
    }

    bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::detail::exception& e) override
    {
        constexpr int kNumberOverflow = 406;
        if (e.id == kNumberOverflow) {
            owner_.fail(nextPointer(), "a number is out of range", "one beyond double precision", {});
        }
        owner_.fail(pointer(), "invalid JSON (byte " + std::to_string(position) + ")", shortReason(e.what()), {});
        return false; // never: GCC does not see that fail() never returns
    }

    [[nodiscard]] JsonTree<Json> take() { return JsonTree<Json>(std::move(root_)); }

private:
    /// The place of the next value.
    [[nodiscard]] std::string nextPointer() const { return stack_.empty() ? "" : pointer() + "/" + nextStep(); }

    [[nodiscard]] std::string nextStep() const
    {
        const Json& top = *stack_.back();
        return top.is_array() ? std::to_string(top.size()) : escapeKey(key_);
    }

    /// The place of the container being filled.
    [[nodiscard]] std::string pointer() const
    {
        std::string text;
        for (const std::string& step : steps_) {
            text += "/" + step;
        }
        return text;
    }

    Json& place(Json value)
    {
        owner_.charge(kBytesPerJsonValue);
        if (stack_.empty()) {
            root_ = std::move(value);
            return root_;
        }
        Json& top = *stack_.back();
        if (top.is_array()) {
            top.push_back(std::move(value));
            return top.back();
        }
        auto& object = top.template get_ref<typename Json::object_t&>();
        if constexpr (kOrdered) { // key() has seen that there is none of the name
            makeRoom(object);
            return object.emplace_back(std::move(key_), std::move(value)).second;
        } else {
            return object.emplace(std::move(key_), std::move(value)).first->second;
        }
    }

    /// Makes room for one more member. An ordered object that grows by itself copies all members and destroys the old
    /// ones, which takes memory when there may be none: see takeApart().
    static void makeRoom(typename Json::object_t& object)
    {
        if (object.size() < object.capacity()) {
            return;
        }
        constexpr std::size_t kFewest = 8;
        typename Json::object_t larger;
        larger.reserve(std::max(kFewest, 2 * object.size()));
        for (const auto& member : object) {
            larger.emplace_back(member.first, Json());
        }
        auto to = larger.begin();
        for (auto& member : object) {
            (to++)->second = std::move(member.second);
        }
        object.swap(larger);
    }

    bool add(Json value)
    {
        place(std::move(value));
        return true;
    }

    bool open(Json container)
    {
        if (stack_.size() >= kMaxJsonDepth) {
            owner_.fail(pointer(), "the JSON is nested deeper than " + std::to_string(kMaxJsonDepth) + " levels", {},
                        {});
        }
        if (!stack_.empty()) {
            steps_.push_back(nextStep());
        }
        stack_.push_back(&place(std::move(container)));
        names_.resize(stack_.size());
        return true;
    }

    bool close()
    {
        stack_.pop_back();
        names_.pop_back();
        if (!steps_.empty()) {
            steps_.pop_back();
        }
        return true;
    }

    JsonOwner& owner_;
    Json root_;
    std::vector<Json*> stack_;
    std::vector<std::set<std::string>> names_; // the names of each object on the stack, where the tree is slow to say
    std::vector<std::string> steps_;           // one per container below the root
    std::string key_;
};

} // namespace detail

/// Reads UTF-8 JSON as nlohmann::json or ordered_json. Refuses, through the owner, byte order marks, invalid UTF-8,
/// duplicate keys, numbers beyond double and nesting deeper than kMaxJsonDepth. NUL bytes and white space at the end
/// are padding. Never recurses; takes time and memory in proportion to the text.
template <typename Json>
[[nodiscard]] JsonTree<Json> readJson(std::string_view text, JsonOwner& owner)
{
    if (text.starts_with("\xEF\xBB\xBF")) {
        owner.fail("", "invalid JSON (byte 0)", "a byte order mark", "save the file as UTF-8 without one");
    }
    // The parser takes a NUL for the end of the text, whatever follows.
    constexpr std::string_view kPadding("\0 \t\r\n", 5);
    const std::size_t nul = text.find('\0');
    if (nul != std::string_view::npos && text.find_first_not_of(kPadding, nul) != std::string_view::npos) {
        owner.fail("", "invalid JSON (byte " + std::to_string(nul + 1) + ")", "a NUL byte", {});
    }
    detail::TreeBuilder<Json> builder(owner);
    Json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take();
}

} // namespace gnomon::scene
