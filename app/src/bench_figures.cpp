// SPDX-License-Identifier: Apache-2.0
#include "bench_figures.h"

#include "scene/json.h"

#include "files/files.h"

#include <gnomon/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace gnomon::app {
namespace {

constexpr std::size_t kLongestName = 1000; // the name of a technique with every setting that it can have
constexpr const char* kNoLeast = "bytes_minimum";

/// A text from the file made short and printable on one line.
std::string shortened(std::string text)
{
    constexpr std::size_t kLongest = 200;
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20U || c >= 0x7FU; }, '?');
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

class FiguresReader final : public scene::JsonOwner {
public:
    explicit FiguresReader(const std::string& file) : file_(file) {}

    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& found,
                           const std::string& /*todo*/) const override
    {
        throw Error(fmt::format("reading earlier result {}", file_),
                    shortened(fmt::format("{}{}{}{}{}", pointer, pointer.empty() ? "" : ": ", what,
                                          found.empty() ? "" : ": ", found)),
                    "give a file that `gnomon bench --json` of this version wrote");
    }

    [[nodiscard]] BenchFigures read(std::string_view text)
    {
        const auto tree = scene::readJson<Json>(text, *this);
        const Json& bench = tree.root();
        if (!bench.is_object()) {
            fail("", "it is no JSON object", "", "");
        }
        BenchFigures figures;
        figures.file = file_;
        figures.device = nameAt(bench, "", "device") + ", " + nameAt(bench, "", "driver");
        if (!at(bench, "", "settings").is_object()) {
            fail("/settings", "it is no object", "", "");
        }
        figures.sight = sightOf(bench);
        const Json& results = arrayAt(bench, "", "results");
        std::set<std::string> names;
        for (std::size_t i = 0; i < results.size(); ++i) {
            const std::string place = fmt::format("/results/{}", i);
            figures.techniques.push_back(techniqueOf(results[i], place));
            if (!names.insert(figures.techniques.back().name).second) {
                fail(place, "a technique is listed twice", figures.techniques.back().name, "");
            }
        }
        if (figures.techniques.empty()) {
            fail("/results", "it has no technique", "", "");
        }
        return figures;
    }

private:
    [[nodiscard]] const Json& at(const Json& object, const std::string& place, const char* key) const
    {
        if (!object.is_object()) {
            fail(place, "it is no object", "", "");
        }
        const auto member = object.find(key);
        if (member == object.end()) {
            fail(place, fmt::format("there is no \"{}\"", key), "", "");
        }
        return *member;
    }

    [[nodiscard]] const Json& arrayAt(const Json& object, const std::string& place, const char* key) const
    {
        const Json& array = at(object, place, key);
        if (!array.is_array()) {
            fail(place + "/" + key, "it is no list", "", "");
        }
        return array;
    }

    [[nodiscard]] std::string nameAt(const Json& object, const std::string& place, const char* key) const
    {
        const Json& value = at(object, place, key);
        if (!value.is_string() || value.get_ref<const std::string&>().size() > kLongestName) {
            fail(place + "/" + key, "it is no name", "", "");
        }
        return shortenedName(value.get<std::string>());
    }

    /// Names are printed: they keep their length, for they are compared.
    static std::string shortenedName(std::string name)
    {
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return c < 0x20U || c >= 0x7FU; }, '?');
        return name;
    }

    /// Null is nothing.
    [[nodiscard]] std::optional<double> numberIn(const Json& object, const std::string& place, const char* key) const
    {
        const Json& value = at(object, place, key);
        if (value.is_null()) {
            return std::nullopt;
        }
        if (!value.is_number() || !(value.get<double>() >= 0.0)) {
            fail(place + "/" + key, "it is no number of 0 or above", "", "");
        }
        return value.get<double>();
    }

    [[nodiscard]] RelativeTime timeOf(const Json& median_of, const std::string& median_place, const char* median_key,
                                      const Json& iqr_of, const std::string& iqr_place, const char* iqr_key,
                                      double without_ms) const
    {
        const auto relative = [&](const std::optional<double>& ms) {
            return ms && without_ms > 0.0 ? std::optional(*ms / without_ms) : std::nullopt;
        };
        return {relative(numberIn(median_of, median_place, median_key)),
                relative(numberIn(iqr_of, iqr_place, iqr_key))};
    }

    /// Every whole number; the least is none that is done.
    [[nodiscard]] Counts countsOf(const Json& object, const std::string& place) const
    {
        if (!object.is_object()) {
            fail(place, "it is no object", "", "");
        }
        Counts counts;
        for (const auto& [key, value] : object.items()) {
            if (value.is_number_unsigned() && key.find(kNoLeast) == std::string::npos && key.size() <= kLongestName) {
                counts[shortenedName(key)] = value.get<std::uint64_t>();
            } else if (value.is_number_integer() && !value.is_number_unsigned()) {
                fail(place + "/" + scene::escapeKey(key), "it is no count", "", "");
            }
        }
        return counts;
    }

    [[nodiscard]] PassFigures passOf(const Json& pass, const std::string& place, double without_ms) const
    {
        PassFigures figures;
        figures.name = nameAt(pass, place, "name");
        figures.time = timeOf(pass, place, "ms", pass, place, "iqr_ms", without_ms);
        figures.counts = countsOf(pass, place);
        return figures;
    }

    [[nodiscard]] TechniqueFigures techniqueOf(const Json& result, const std::string& place) const
    {
        TechniqueFigures figures;
        figures.name = nameAt(result, place, "technique");
        (void)at(result, place, "static_frame_ratio"); // which no other subcommand's results have
        const Json& times = at(result, place, "time_ms");
        const Json& iqrs = at(result, place, "iqr_ms");
        const std::string times_place = place + "/time_ms";
        const std::string iqrs_place = place + "/iqr_ms";
        const double ratio = numberIn(result, place, "frame_ratio").value_or(0.0);
        const double frame_ms = numberIn(times, times_place, "frame").value_or(0.0);
        const double without_ms = ratio > 0.0 ? frame_ms / ratio : 0.0;
        figures.frame = timeOf(times, times_place, "frame", iqrs, iqrs_place, "frame", without_ms);
        figures.plan = timeOf(times, times_place, "plan", iqrs, iqrs_place, "plan", without_ms);
        figures.counts = countsOf(at(result, place, "counters"), place + "/counters");
        std::set<std::string> names;
        const Json& passes = arrayAt(result, place, "passes");
        for (std::size_t i = 0; i < passes.size(); ++i) {
            const std::string pass_place = fmt::format("{}/passes/{}", place, i);
            figures.passes.push_back(passOf(passes[i], pass_place, without_ms));
            const PassFigures& pass = figures.passes.back();
            if (!names.insert(pass.name).second) {
                fail(pass_place, "a pass is listed twice", pass.name, "");
            }
            for (const auto& [name, count] : pass.counts) {
                figures.counts.erase(name); // their sum, which would be told twice
            }
        }
        return figures;
    }

    const std::string& file_;
};

} // namespace

Sight sightOf(const Json& bench)
{
    Sight sight;
    for (const char* key : {"scene_hash", "eye", "lights", "path"}) {
        sight[key] = bench.contains(key) ? bench.at(key).dump() : "null";
    }
    const Json& settings = bench.at("settings");
    for (const Setting& setting : settingTable()) {
        using Group = SettingGroup;
        const bool decides = setting.group == Group::picture || setting.group == Group::time;
        // Ways of shading are there to be compared.
        if (const auto value = settings.find(setting.key);
            decides && setting.key != "shading" && value != settings.end()) {
            sight[std::string(setting.key)] = value->dump();
        }
    }
    return sight;
}

BenchFigures parseBenchFigures(std::string_view text, const std::string& file)
{
    return FiguresReader(file).read(text);
}

BenchFigures readBenchFigures(const std::filesystem::path& file)
{
    constexpr std::uint64_t kMaxBytes = 1U << 24U; // as presets, which results are too
    return parseBenchFigures(readWholeFile(file, kMaxBytes, "earlier result"), file.string());
}

} // namespace gnomon::app
