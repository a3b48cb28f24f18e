// SPDX-License-Identifier: Apache-2.0
// What a technique is made of. A new option of a technique is one row here.
#include "setting_rows.h"
#include "setting_values.h"

#include <gnomon/choices.h>

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {
namespace {

using enum SettingType;
using Group = SettingGroup;
using Value = SettingValue;

std::vector<std::string_view> choiceNames(std::string_view choice)
{
    std::vector<std::string_view> names;
    for (const ChoiceValue& row : choiceValues()) {
        if (row.choice == choice) {
            names.push_back(row.name);
        }
    }
    return names;
}

template <typename Enum>
void setChoice(std::string_view choice, Enum& target, const Value& value)
{
    target = static_cast<Enum>(findChoice(choice, value.text)->value);
}

/// auto | none | constant=M,slope=S,normal=T,receiver-plane=0|1, whose parts are settings of their own.
void applyBias(Settings& s, const Value& v)
{
    s.filter.bias = BiasOptions{};
    if (v.text == "auto") {
        return;
    }
    s.filter.bias.automatic = false;
    if (v.text == "none") {
        return;
    }
    std::vector<std::string_view> seen;
    for (const std::string_view part : split(v.text, ',')) {
        const std::size_t equals = part.find('=');
        const Setting* setting =
            equals == std::string_view::npos ? nullptr : findSetting(fmt::format("bias.{}", part.substr(0, equals)));
        if (setting == nullptr) {
            throw UsageError(fmt::format(
                "--bias: \"{}\" is not auto, none or constant=M,slope=S,normal=T,receiver-plane=0|1", v.text));
        }
        if (std::find(seen.begin(), seen.end(), setting->key) != seen.end()) {
            throw UsageError(fmt::format("--bias: \"{}\" gives {} twice", v.text, part.substr(0, equals)));
        }
        seen.push_back(setting->key);
        setting->apply(s, parseValue(*setting, part.substr(equals + 1)));
    }
}

bool isPcf(const Settings& s)
{
    return s.plan.technique.filter == Filter::pcf;
}
bool isDisc(const Settings& s)
{
    return isPcf(s) && (s.filter.pcf_kernel == PcfKernel::poisson || s.filter.pcf_kernel == PcfKernel::vogel);
}
bool isGaussian(const Settings& s)
{
    return isPcf(s) && !isDisc(s) && s.filter.pcf_kernel != PcfKernel::bilinear_2x2;
}

void manualBias(Settings& s)
{
    s.filter.bias.automatic = false;
}

const std::vector<Setting>& rows()
{
    static const std::vector<Setting> table{
        // clang-format off
        {.key = "filter", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "pcf", .choices = [] { return choiceNames("filter"); },
         .doc = "what a texel stores and how it is tested", .apply = [](Settings& s, const Value& v) { setChoice("filter", s.plan.technique.filter, v); }},
        {.key = "fit", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "uniform", .choices = [] { return choiceNames("fit"); },
         .doc = "how one frustum's projection is shaped", .apply = [](Settings& s, const Value& v) { setChoice("fit", s.plan.technique.fit, v); }},
        {.key = "partition", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "single", .choices = [] { return choiceNames("partition"); },
         .doc = "how a light's receivers are divided among frustums", .apply = [](Settings& s, const Value& v) { setChoice("partition", s.plan.technique.partition, v); }},
        {.key = "soften", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "none", .choices = [] { return choiceNames("soften"); },
         .doc = "what happens to the visibility in screen space", .apply = [](Settings& s, const Value& v) { setChoice("soften", s.plan.technique.soften, v); }},
        {.key = "motion", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "free", .choices = [] { return choiceNames("motion"); },
         .doc = "how the map follows a moving camera or sun", .apply = [](Settings& s, const Value& v) { setChoice("motion", s.plan.technique.motion, v); }},
        {.key = "map-size", .group = Group::technique, .type = integer, .form = "N", .unit = "texels", .default_text = "2048", .min = 16, .max = 16384,
         .doc = "side of one map", .apply = [](Settings& s, const Value& v) { s.plan.map_size = static_cast<std::uint32_t>(v.integer); }},
        {.key = "map-format", .group = Group::technique, .type = choice, .form = "FORMAT", .choices = [] { return enumNames<MapFormat>(11); },
         .doc = "what a texel is stored as; else the filter's own",
         .apply = [](Settings& s, const Value& v) { s.filter.format = *findMapFormat(v.text); s.format_given = true; }},
        {.key = "bias", .group = Group::technique, .type = text, .form = "BIAS", .default_text = "auto",
         .doc = "auto, none or constant=M,slope=S,normal=T,receiver-plane=0|1", .apply = applyBias},
        {.key = "bias.constant", .group = Group::technique, .type = real, .form = "M", .unit = "m", .min = -1e6, .max = 1e6,
         .doc = "towards the light; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.constant_m = static_cast<float>(v.real); }},
        {.key = "bias.slope", .group = Group::technique, .type = real, .form = "S", .unit = "texel depths", .min = 0, .max = 16,
         .doc = "times the depth that one texel spans; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.slope = static_cast<float>(v.real); }},
        {.key = "bias.normal", .group = Group::technique, .type = real, .form = "T", .unit = "texels", .min = 0, .max = 16,
         .doc = "receiver moved along its normal; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.normal_texels = static_cast<float>(v.real); }},
        {.key = "bias.receiver-plane", .group = Group::technique, .type = flag, .form = "0|1",
         .doc = "each tap against the receiver's plane there; ends bias=auto", .own_option = false,
         .apply = [](Settings& s, const Value& v) { manualBias(s); s.filter.bias.receiver_plane = v.flag; }},
        {.key = "pcf.kernel", .group = Group::technique, .type = choice, .form = "NAME", .default_text = "3x3", .choices = [] { return enumNames<PcfKernel>(6); },
         .doc = "2x2 is bilinear; 3x3, 5x5, 7x7 Gaussian; poisson, vogel discs", .own_option = false, .used = isPcf, .used_when = "filter pcf",
         .apply = [](Settings& s, const Value& v) { s.filter.pcf_kernel = *findPcfKernel(v.text); }},
        {.key = "pcf.taps", .group = Group::technique, .type = integer, .form = "N", .unit = "taps", .default_text = "16", .min = 4, .max = 64,
         .doc = "of a disc", .own_option = false, .used = isDisc, .used_when = "pcf.kernel poisson or vogel",
         .apply = [](Settings& s, const Value& v) { s.filter.disc_taps = static_cast<std::uint32_t>(v.integer); }},
        {.key = "pcf.radius", .group = Group::technique, .type = real, .form = "R", .unit = "texels", .default_text = "2.5", .min = 0.5, .max = 16,
         .doc = "of a disc", .own_option = false, .used = isDisc, .used_when = "pcf.kernel poisson or vogel",
         .apply = [](Settings& s, const Value& v) { s.filter.disc_radius_texels = static_cast<float>(v.real); }},
        {.key = "pcf.sigma", .group = Group::technique, .type = real, .form = "S", .unit = "texels", .min = 0.3, .max = 4,
         .doc = "of a Gaussian kernel; else its width / 4", .own_option = false, .used = isGaussian, .used_when = "pcf.kernel 3x3, 5x5 or 7x7",
         .apply = [](Settings& s, const Value& v) { s.filter.gaussian_sigma_texels = static_cast<float>(v.real); }},
        // clang-format on
    };
    return table;
}

} // namespace

void addTechniqueRows(std::vector<Setting>& table)
{
    table.insert(table.end(), rows().begin(), rows().end());
}

} // namespace gnomon::app
