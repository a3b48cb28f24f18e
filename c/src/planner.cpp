// SPDX-License-Identifier: Apache-2.0
#include "handles.h"

#include <gnomon/choice_rules.h>
#include <gnomon/option_table.h>

#include <memory>

using namespace gnomon;
using namespace gnomon::c;

namespace {

constexpr std::size_t kMostOptions = 256; // of one planner

/// The rows of the option table, with texts that have an end.
class OptionList {
public:
    OptionList()
    {
        const ShadowOptions defaults;
        for (const OptionRow& row : optionTable()) {
            std::string choices;
            for (const std::string_view name : row.choices != nullptr ? row.choices() : decltype(row.choices()){}) {
                choices += (choices.empty() ? "" : " ") + std::string(name);
            }
            rows_.push_back({texts_(row.key), texts_(row.doc), texts_(row.form), texts_(row.unit),
                             texts_(textOf(row, row.get(defaults))), texts_(choices), row.min, row.max});
        }
    }

    [[nodiscard]] const std::vector<GnomonOption>& rows() const { return rows_; }

private:
    Texts texts_;
    std::vector<GnomonOption> rows_;
};

const std::vector<GnomonOption>& optionList()
{
    static const OptionList list;
    return list.rows();
}

const OptionRow& requireOption(const char* key)
{
    const OptionRow* row = findOption(&required(key, "key"));
    if (row == nullptr) {
        throw WrongCall{"there is no option " + quoted(key),
                        "gnomonOptionAt() and `gnomon list options` have all keys"};
    }
    return *row;
}

OptionValue readValue(const OptionRow& row, std::string_view text)
{
    if (text.empty()) {
        return row.get(ShadowOptions{});
    }
    OptionReading reading = readOption(row, text);
    if (!reading.value) {
        throw WrongCall{std::string(row.key) + ": " + quoted(text) + " is not " + reading.expected, ""};
    }
    return std::move(*reading.value);
}

/// Makes the planner anew where its options have changed.
void renew(GnomonPlanner& own)
{
    if (own.options != own.planned) {
        std::vector<ShadowOptions> options = own.options;
        Planner planner{std::span<const ShadowOptions>(options)};
        own.plan = nullptr; // it was the old planner's
        own.planner = std::move(planner);
        own.planned = std::move(options);
    }
}

template <class T>
const T* elementAt(const GnomonPlanner* planner, const std::vector<T> FlatPlan::*list, std::uint32_t index,
                   const char* name)
{
    return guardedPointer("reading a plan", [&] {
        const std::vector<T>& elements = planned(planner).flat.*list;
        requireIndex(index, elements.size(), name);
        return &elements[index];
    });
}

} // namespace

extern "C" {

uint32_t gnomonOptionCount(void) noexcept
{
    return static_cast<uint32_t>(optionTable().size());
}

const GnomonOption* gnomonOptionAt(uint32_t index) noexcept
{
    return guardedPointer("describing an option", [&] {
        const std::vector<GnomonOption>& rows = optionList();
        requireIndex(index, rows.size(), "index");
        return &rows[index];
    });
}

GnomonPlanner* gnomonMakePlanner(uint32_t header_interface) noexcept
{
    return guardedPointer("making a planner", [&] {
        requireInterface(header_interface);
        return std::make_unique<GnomonPlanner>().release();
    });
}

void gnomonFreePlanner(GnomonPlanner* planner) noexcept
{
    delete planner;
}

GnomonStatus gnomonSetOption(GnomonPlanner* planner, uint32_t options, const char* key, const char* value) noexcept
{
    return guarded("setting an option", [&] {
        GnomonPlanner& own = required(planner, "planner");
        const OptionRow& row = requireOption(key);
        const OptionValue wanted = readValue(row, &required(value, "value"));
        requireIndex(options, std::min(own.options.size() + 1, kMostOptions), "options");
        ShadowOptions changed = options < own.options.size() ? own.options[options] : ShadowOptions{};
        row.set(changed, wanted);
        if (options == own.options.size()) {
            own.options.emplace_back();
        }
        own.options[options] = changed;
    });
}

const char* gnomonGetOption(const GnomonPlanner* planner, uint32_t options, const char* key) noexcept
{
    return guardedPointer("reading an option", [&] {
        const GnomonPlanner& own = required(planner, "planner");
        const OptionRow& row = requireOption(key);
        requireIndex(options, own.options.size(), "options");
        thread_local std::string text;
        text = textOf(row, row.get(own.options[options]));
        // It outlives the call. NOLINTNEXTLINE(clang-analyzer-cplusplus.InnerPointer)
        return static_cast<const char*>(text.c_str());
    });
}

GnomonStatus gnomonCheckOptions(const GnomonPlanner* planner, uint32_t options, uint32_t light_type) noexcept
{
    return guarded("checking options", [&] {
        const GnomonPlanner& own = required(planner, "planner");
        requireIndex(options, own.options.size(), "options");
        const auto type = static_cast<LightType>(takenEnum(light_type, 3, "light_type"));
        if (const Resolution resolution = resolve(own.options[options]); !resolution) {
            throw WrongCall{resolution.refusal, ""};
        }
        if (const auto reason = refusal(type, own.options[options])) {
            throw WrongCall{std::string(*reason), ""};
        }
    });
}

GnomonStatus gnomonLoseMap(GnomonPlanner* planner, uint32_t map_index, uint32_t map_generation) noexcept
{
    return guarded("losing a map", [&] { required(planner, "planner").planner.lost({map_index, map_generation}); });
}

GnomonStatus gnomonLoseAllMaps(GnomonPlanner* planner) noexcept
{
    return guarded("losing all maps", [&] { required(planner, "planner").planner.reset(); });
}

const GnomonPlan* gnomonPlan(GnomonPlanner* planner, const GnomonFrame* frame) noexcept
{
    return guardedPointer("planning a frame", [&] {
        GnomonPlanner& own = required(planner, "planner");
        const Frame& wanted = own.frame.take(required(frame, "frame"));
        renew(own);
        own.plan = nullptr; // should memory run out, there is none
        own.has_page_table = false;
        const Plan& plan = own.planner.plan(wanted);
        flatten(plan, own.flat);
        own.plan = &plan;
        return static_cast<const GnomonPlan*>(&own.flat.plan);
    });
}

const GnomonLightPlan* gnomonLightAt(const GnomonPlanner* planner, uint32_t light) noexcept
{
    return elementAt(planner, &FlatPlan::lights, light, "light");
}

const GnomonView* gnomonViewAt(const GnomonPlanner* planner, uint32_t view) noexcept
{
    return elementAt(planner, &FlatPlan::views, view, "view");
}

const GnomonPages* gnomonPagesAt(const GnomonPlanner* planner, uint32_t options) noexcept
{
    return elementAt(planner, &FlatPlan::pages, options, "options");
}

const GnomonPass* gnomonPassAt(const GnomonPlanner* planner, uint32_t pass) noexcept
{
    return elementAt(planner, &FlatPlan::passes, pass, "pass");
}

const char* gnomonPlanJson(GnomonPlanner* planner) noexcept
{
    return guardedPointer("writing a plan as JSON", [&] {
        std::string text = toJson(*planned(planner).plan);
        planner->json = std::move(text);
        return static_cast<const char*>(planner->json.c_str());
    });
}

} // extern "C"
