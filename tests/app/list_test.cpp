// SPDX-License-Identifier: Apache-2.0
// `gnomon list`: an overview of a few screens, and all of one thing by its name.
#include "folder.h"
#include "process.h"

#include "list.h"
#include "list_rules.h"
#include "topics.h"

#include <gnomon/choice_rules.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace gnomon {
namespace {

test::Ran list(const std::vector<std::string>& more)
{
    const test::Folder folder;
    std::vector<std::string> arguments{"list"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::gnomon(arguments, {.folder = folder.path()});
}

const ChoiceValue& valueOf(std::string_view choice, std::string_view name)
{
    return *findChoice(choice, name);
}

TEST(List, AnswersToNamesWithWhatTheyAre)
{
    const std::string overview = list({}).out;
    for (const ChoiceValue& row : choiceValues()) {
        EXPECT_NE(overview.find(row.summary), std::string::npos) << row.name;
    }
    const std::string settings = list({"settings"}).out;
    for (const app::Setting& setting : app::settingTable()) {
        EXPECT_NE(settings.find("\n  " + std::string(setting.key) + " "), std::string::npos) << setting.key;
    }
    const std::string both = list({"smoothies"}).out;
    for (const char* part :
         {"a value of filter", "a value of soften", "docs/techniques/smoothies.md", "smoothies.reach"}) {
        EXPECT_NE(both.find(part), std::string::npos) << part;
    }
}

TEST(List, KnowsWhichSettingsAreAValuesOwn)
{
    const auto keys = [](const ChoiceValue& value) {
        std::vector<std::string_view> found;
        for (const app::Setting* setting : app::settingsOf(value)) {
            found.push_back(setting->key);
        }
        return found;
    };
    const auto contains = [](const std::vector<std::string_view>& all, std::string_view key) {
        return std::ranges::find(all, key) != all.end();
    };
    EXPECT_TRUE(contains(keys(valueOf("filter", "pcf")), "pcf.taps")) << "with another kernel than the default";
    EXPECT_TRUE(contains(keys(valueOf("partition", "multi")), "multi.fade")) << "with another motion";
    EXPECT_TRUE(contains(keys(valueOf("soften", "smoothies")), "smoothies.reach"));
    EXPECT_TRUE(contains(keys(valueOf("light", "spot")), "spot.cone"));
    EXPECT_TRUE(contains(keys(valueOf("motion", "step-band")), "step.angle"));
    EXPECT_FALSE(contains(keys(valueOf("filter", "pcf")), "map-size")) << "of nearly all";
    EXPECT_FALSE(contains(keys(valueOf("soften", "blur")), "blur.sigma")) << "of the map's blur";
    EXPECT_TRUE(keys(valueOf("fit", "uniform")).empty());
}

TEST(List, KnowsWhichRulesAreAValuesOwn)
{
    const auto rules = [](const ChoiceValue& value) {
        return app::refusedOf(value).size();
    };
    EXPECT_EQ(rules(valueOf("motion", "free")), 0U);
    EXPECT_EQ(rules(valueOf("partition", "auto")), 0U);
    EXPECT_GE(rules(valueOf("partition", "paraboloid")), 6U);
    EXPECT_EQ(rules(valueOf("light", "spot")), 2U) << "paraboloid and fit scene";
    std::set<std::string> named;
    for (const ChoiceValue& value : choiceValues()) {
        for (const app::Refused& row : app::refusedOf(value)) {
            named.insert(row.technique);
        }
    }
    const auto all = std::ranges::count_if(choiceRules(),
                                           [&named](const ChoiceRule& rule) { return named.contains(rule.refuses()); });
    EXPECT_EQ(static_cast<std::size_t>(all), choiceRules().size()) << "every rule is some value's";
}

TEST(List, JsonOfANameIsItsPartOfTheWhole)
{
    const app::Json whole = app::listJson("");
    const app::Json part = app::listJson("msm");
    EXPECT_EQ(part["name"], "msm");
    ASSERT_EQ(part["choices"].size(), 1U);
    EXPECT_EQ(part["choices"][0]["values"][0]["page"], "docs/techniques/msm.md");
    EXPECT_FALSE(part.contains("presets"));
    for (const auto& setting : part["settings"]) {
        EXPECT_NE(std::find(whole["settings"].begin(), whole["settings"].end(), setting), whole["settings"].end());
    }
    EXPECT_EQ(app::listJson("settings")["settings"], whole["settings"]);
    EXPECT_EQ(app::listJson("rules")["refused"], whole["refused"]);
    EXPECT_EQ(app::listJson("filter")["choices"][0]["values"].size(), 14U);
}

TEST(List, PagesAreThere)
{
    const std::filesystem::path root = GNOMON_SOURCE_DIR;
    const auto isThere = [&root](const std::string& page) {
        return std::filesystem::exists(root / page);
    };
    for (const app::Topic& topic : app::topics()) {
        const std::string page = app::pageOf(topic);
        EXPECT_TRUE(isThere(page)) << topic.name << " " << page;
        if (topic.preset != nullptr) {
            const bool has_one = isThere("docs/techniques/" + std::string(topic.name) + ".md");
            EXPECT_EQ(has_one, page.starts_with("docs/techniques")) << topic.name;
        }
    }
}

} // namespace
} // namespace gnomon
