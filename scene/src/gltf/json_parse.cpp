// SPDX-License-Identifier: Apache-2.0
// The library's own tree builder accepts duplicate keys, keeps no pointer for its errors and knows no depth; this one
// is driven by the same parser's events.
#include "gltf/json_view.h"

namespace gnomon::scene::gltf {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxDepth = 128;
/// What one value costs in memory at least, with its place in a map; keeps a 1 GB file of "[0,0,0,…" within bounds.
constexpr std::uint64_t kBytesPerValue = 32;

class TreeBuilder final : public nlohmann::json_sax<json> {
public:
    explicit TreeBuilder(Context& context) : context_(context) {}

    bool null() override { return add(nullptr); }
    bool boolean(bool value) override { return add(value); }
    bool number_integer(number_integer_t value) override { return add(value); }
    bool number_unsigned(number_unsigned_t value) override { return add(value); }
    bool number_float(number_float_t value, const string_t& /*text*/) override { return add(value); }
    bool string(string_t& value) override
    {
        context_.chargeBytes(value.size(), "");
        return add(std::move(value));
    }
    bool binary(binary_t& /*value*/) override { return false; } // JSON text has none

    bool start_object(std::size_t /*size*/) override { return open(json::object()); }
    bool start_array(std::size_t /*size*/) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& key) override
    {
        context_.chargeBytes(key.size(), "");
        if (stack_.back()->contains(key)) {
            context_.fail(pointer(), "an object has the same key twice", "'" + escapeKey(key) + "'");
        }
        key_ = std::move(key);
        return true;
    }

    bool parse_error(std::size_t position, const std::string& /*token*/, const nlohmann::detail::exception& e) override
    {
        constexpr int kNumberOverflow = 406;
        if (e.id == kNumberOverflow) {
            context_.fail(nextPointer(), "a number is out of range", "one beyond double precision");
        }
        // The library's text starts with "[json.exception...] "; what follows is for people.
        const std::string text = e.what();
        const std::size_t start = text.find("] ");
        context_.fail(pointer(), "invalid JSON (byte " + std::to_string(position) + ")",
                      start == std::string::npos ? text : text.substr(start + 2));
    }

    [[nodiscard]] json take() { return std::move(root_); }

private:
    /// Where the value that comes next will be.
    [[nodiscard]] std::string nextPointer() const
    {
        if (stack_.empty()) {
            return "";
        }
        const json& top = *stack_.back();
        return pointer() + "/" + (top.is_array() ? std::to_string(top.size()) : escapeKey(key_));
    }

    /// Where the container being filled is.
    [[nodiscard]] std::string pointer() const
    {
        std::string text;
        for (const std::string& step : steps_) {
            text += "/" + step;
        }
        return text;
    }

    json& place(json value)
    {
        context_.chargeBytes(kBytesPerValue, "");
        if (stack_.empty()) {
            root_ = std::move(value);
            return root_;
        }
        json& top = *stack_.back();
        if (top.is_array()) {
            top.push_back(std::move(value));
            return top.back();
        }
        return top[key_] = std::move(value);
    }

    bool add(json value)
    {
        place(std::move(value));
        return true;
    }

    bool open(json container)
    {
        if (stack_.size() >= kMaxDepth) {
            context_.fail(pointer(), "the JSON is nested deeper than " + std::to_string(kMaxDepth) + " levels");
        }
        if (!stack_.empty()) {
            const json& top = *stack_.back();
            steps_.push_back(top.is_array() ? std::to_string(top.size()) : escapeKey(key_));
        }
        stack_.push_back(&place(std::move(container)));
        return true;
    }

    bool close()
    {
        stack_.pop_back();
        if (!steps_.empty()) {
            steps_.pop_back();
        }
        return true;
    }

    Context& context_;
    json root_;
    std::vector<json*> stack_;
    std::vector<std::string> steps_; // one per container below the root
    std::string key_;
};

} // namespace

json parseJson(Context& context, std::span<const std::byte> text)
{
    const auto* begin = reinterpret_cast<const unsigned char*>(text.data());
    if (text.size() >= 3 && begin[0] == 0xEF && begin[1] == 0xBB && begin[2] == 0xBF) {
        context.fail("", "invalid JSON (byte 0)", "a byte order mark", "save the file as UTF-8 without one");
    }
    TreeBuilder builder(context);
    json::sax_parse(begin, begin + text.size(), &builder);
    return builder.take();
}

} // namespace gnomon::scene::gltf
