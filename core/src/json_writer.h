// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon {

/// Just enough JSON for plans: no file, no locale, numbers in their shortest form that reads back the same.
class JsonWriter {
public:
    std::string take() { return std::move(text_) + "\n"; }

    void open(std::string_view key, char bracket)
    {
        begin(key);
        text_ += bracket;
        ++depth_;
        first_ = true;
    }
    void close(char bracket)
    {
        --depth_;
        if (!first_ && inline_ == 0) {
            newLine();
        }
        text_ += bracket;
        first_ = false;
    }
    /// Everything up to the matching closeLine() is on one line.
    void openLine(std::string_view key, char bracket)
    {
        begin(key);
        text_ += bracket;
        ++depth_;
        ++inline_;
        first_ = true;
    }
    void closeLine(char bracket)
    {
        close(bracket);
        --inline_;
    }
    void value(std::string_view key, double number)
    {
        begin(key);
        if (!std::isfinite(number)) {
            text_ += "null";
            return;
        }
        append(number == 0.0 ? 0.0 : number); // -0 and 0 are one number
    }
    void value(std::string_view key, std::unsigned_integral auto number)
    {
        begin(key);
        append(number);
    }
    void value(std::string_view key, std::string_view string)
    {
        begin(key);
        quote(string);
    }
    void nothing(std::string_view key)
    {
        begin(key);
        text_ += "null";
    }
    void flag(std::string_view key, bool set)
    {
        begin(key);
        text_ += set ? "true" : "false";
    }
    void vector(std::string_view key, const auto& components, int count)
    {
        openLine(key, '[');
        for (int i = 0; i < count; ++i) {
            value({}, components[i]);
        }
        closeLine(']');
    }

private:
    void begin(std::string_view key)
    {
        if (!first_) {
            text_ += inline_ != 0 ? ", " : ",";
        }
        if (inline_ == 0 && depth_ > 0) {
            newLine();
        }
        first_ = false;
        if (!key.empty()) {
            quote(key);
            text_ += ": ";
        }
    }
    void newLine()
    {
        text_ += '\n';
        text_.append(2 * depth_, ' ');
    }
    void append(auto number)
    {
        std::array<char, 32> digits;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
        text_.append(digits.data(), end);
    }
    void quote(std::string_view string)
    {
        text_ += '"';
        for (const char c : string) {
            if (c == '"' || c == '\\') {
                text_ += '\\';
            }
            text_ += c;
        }
        text_ += '"';
    }

    std::string text_;
    std::size_t depth_ = 0;
    int inline_ = 0;
    bool first_ = true;
};

} // namespace gnomon
