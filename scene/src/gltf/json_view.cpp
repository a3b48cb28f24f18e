// SPDX-License-Identifier: Apache-2.0
#include "gltf/json_view.h"

#include <cmath>

namespace gnomon::scene::gltf {

std::string JsonView::shown() const
{
    switch (value_->type()) {
    case nlohmann::json::value_t::object:
        return "an object";
    case nlohmann::json::value_t::array:
        return "an array of " + std::to_string(value_->size());
    default:
        break;
    }
    std::string text = value_->dump(-1, ' ', true);
    constexpr std::size_t kShown = 60;
    return text.size() > kShown ? text.substr(0, kShown) + "..." : text;
}

void JsonView::fail(const std::string& what, const std::string& todo) const
{
    context_->fail(pointer_, what, shown(), todo);
}

void JsonView::failFound(const std::string& what, const std::string& found, const std::string& todo) const
{
    context_->fail(pointer_, what, found, todo);
}

void JsonView::expectObject() const
{
    if (!value_->is_object()) {
        fail("an object is needed");
    }
}

std::optional<JsonView> JsonView::find(std::string_view key) const
{
    expectObject();
    const auto it = value_->find(key);
    if (it == value_->end()) {
        return std::nullopt;
    }
    return JsonView(*context_, *it, pointer_ + "/" + escapeKey(key));
}

JsonView JsonView::at(std::string_view key) const
{
    std::optional<JsonView> member = find(key);
    if (!member) {
        failFound("the property '" + std::string(key) + "' must be defined", "none");
    }
    return *member;
}

std::size_t JsonView::size() const
{
    if (!value_->is_array()) {
        fail("an array is needed");
    }
    if (value_->empty()) {
        fail("an array must not be empty");
    }
    context_->checkCount(value_->size(), pointer_);
    return value_->size();
}

JsonView JsonView::element(std::size_t i) const
{
    return {*context_, (*value_)[i], pointer_ + "/" + std::to_string(i)};
}

std::string JsonView::string() const
{
    if (!value_->is_string()) {
        fail("a string is needed");
    }
    return value_->get_ref<const std::string&>();
}

bool JsonView::boolean() const
{
    if (!value_->is_boolean()) {
        fail("true or false is needed");
    }
    return value_->get<bool>();
}

double JsonView::rawNumber() const
{
    if (!value_->is_number()) {
        fail("a number is needed");
    }
    const double number = value_->get<double>();
    if (!std::isfinite(number)) {
        fail("a finite number is needed");
    }
    return number;
}

float JsonView::number(double low, double high) const
{
    const double number = rawNumber();
    if (!(number >= low && number <= high)) {
        char range[96];
        std::snprintf(range, sizeof range, "a number in %g to %g is needed", low, high);
        fail(range);
    }
    return static_cast<float>(number);
}

std::uint64_t JsonView::uint(std::uint64_t low, std::uint64_t high) const
{
    const double number = rawNumber();
    if (std::floor(number) != number) {
        fail("an integer is needed");
    }
    if (!(number >= static_cast<double>(low) && number <= static_cast<double>(high))) {
        fail("an integer in " + std::to_string(low) + " to " + std::to_string(high) + " is needed");
    }
    return static_cast<std::uint64_t>(number);
}

std::uint32_t JsonView::index(std::size_t count) const
{
    const std::uint64_t i = uint(0, kMaxInteger);
    if (i >= count) {
        fail("the index is out of range: there are " + std::to_string(count) + " entries");
    }
    return static_cast<std::uint32_t>(i);
}

void JsonView::numbers(std::span<float> out, double low, double high) const
{
    if (!value_->is_array() || value_->size() != out.size()) {
        fail("an array of " + std::to_string(out.size()) + " numbers is needed");
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = element(i).number(low, high);
    }
}

std::string JsonView::string(std::string_view key, const std::string& otherwise) const
{
    const std::optional<JsonView> member = find(key);
    return member ? member->string() : otherwise;
}

bool JsonView::boolean(std::string_view key, bool otherwise) const
{
    const std::optional<JsonView> member = find(key);
    return member ? member->boolean() : otherwise;
}

float JsonView::number(std::string_view key, float otherwise, double low, double high) const
{
    const std::optional<JsonView> member = find(key);
    return member ? member->number(low, high) : otherwise;
}

std::uint64_t JsonView::uint(std::string_view key, std::uint64_t otherwise) const
{
    const std::optional<JsonView> member = find(key);
    return member ? member->uint() : otherwise;
}

std::uint32_t JsonView::index(std::string_view key, std::size_t count) const
{
    const std::optional<JsonView> member = find(key);
    return member ? member->index(count) : kNone;
}

} // namespace gnomon::scene::gltf
