// SPDX-License-Identifier: Apache-2.0
#include "gltf/casting_extras.h"

#include <cmath>
#include <string>

namespace gnomon::scene::gltf {

namespace {

void ignore(const JsonView& view, const std::string& needed)
{
    view.context().notice(view.pointer() + " is not " + needed + " and was ignored");
}

std::optional<bool> readFlag(const JsonView& view)
{
    if (!view.value().is_boolean()) {
        ignore(view, "true or false");
        return {};
    }
    return view.value().get<bool>();
}

std::optional<float> readBias(const JsonView& view)
{
    const double bias_m = view.value().is_number() ? view.value().get<double>() : std::nan("");
    if (!(std::abs(bias_m) <= kMostBias_m)) {
        ignore(view, "a number of metres from -1e6 to 1e6");
        return {};
    }
    return static_cast<float>(bias_m);
}

std::optional<std::uint32_t> readGroups(const JsonView& view)
{
    const nlohmann::json& list = view.value();
    bool is_sound = list.is_array() && list.size() <= kMostGroups;
    std::uint32_t groups = 0;
    for (std::size_t i = 0; is_sound && i < list.size(); ++i) {
        is_sound = list[i].is_number_unsigned() && list[i].get<std::uint64_t>() < kMostGroups;
        groups |= is_sound ? 1U << list[i].get<std::uint32_t>() : 0U;
    }
    if (!is_sound) {
        ignore(view, "an array of up to 32 groups, whole numbers from 0 to 31,");
        return {};
    }
    return groups;
}

/// Calls take(key, value) for each member of extras/gnomon; take() says whether it knows the key.
template <typename Take>
void eachMember(const JsonView& view, const Take& take)
{
    const std::optional<JsonView> extras = view.find("extras");
    if (!extras || !extras->value().is_object()) { // glTF allows any value, and others' are not ours to judge
        return;
    }
    const std::optional<JsonView> ours = extras->find("gnomon");
    if (!ours) {
        return;
    }
    if (!ours->value().is_object()) {
        ignore(*ours, "an object");
        return;
    }
    for (const auto& [key, value] : ours->value().items()) {
        const JsonView member = ours->at(key);
        if (!take(key, member)) {
            ignore(member, "a member that Gnomon knows");
        }
    }
}

} // namespace

Casting readCasting(const JsonView& node)
{
    Casting casting;
    eachMember(node, [&](const std::string& key, const JsonView& value) {
        if (key == "casts") {
            casting.casts = readFlag(value);
        } else if (key == "receives") {
            casting.receives = readFlag(value);
        } else if (key == "moves") {
            casting.moves = readFlag(value);
        } else if (key == "bias_m") {
            casting.bias_m = readBias(value);
        } else if (key == "groups") {
            casting.groups = readGroups(value);
        } else {
            return false;
        }
        return true;
    });
    return casting;
}

std::optional<std::uint32_t> readLightGroups(const JsonView& light)
{
    std::optional<std::uint32_t> groups;
    eachMember(light, [&](const std::string& key, const JsonView& value) {
        if (key != "groups") {
            return false;
        }
        groups = readGroups(value);
        return true;
    });
    return groups;
}

} // namespace gnomon::scene::gltf
