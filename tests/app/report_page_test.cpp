// SPDX-License-Identifier: Apache-2.0
// The pages of reports are well-formed, carry every string as text, and load nothing from elsewhere. tests/page tests
// them in a browser.
#include "report_pages.h"

#include "command_text.h"
#include "compare_steps.h"
#include "image/image_io.h"
#include "report_html.h"
#include "report_pictures.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace gnomon::app {
namespace {

constexpr const char* kHostile = "a<b>&\"c'</td><script>x</script>";
constexpr const char* kHostileText = "a&lt;b&gt;&amp;&quot;c&#39;&lt;/td&gt;&lt;script&gt;x&lt;/script&gt;";

/// Two techniques of one map, and a sweep's or a path's names where `more` has them.
Json makeResult(const std::string& text, const Json& more = Json::object())
{
    Json result{
        {"version", "version " + text},
        {"scene", "scene " + text},
        {"scene_hash", "hash " + text},
        {"camera", "camera " + text},
        {"light", "light " + text},
        {"device", "device " + text},
        {"driver", "driver " + text},
        {"size_px", {160, 90}},
        {"light_source", {{"type", "type " + text}, {"position_ws", {1.0, 2.0, 3.0}}, {"radius_m", 0.5}}},
        {"truth", {{"kind", "hard"}, {"requested", "hard"}, {"rays", 7}, {"seconds", 1.0}, {"from_cache", false}}},
        {"results", Json::array()},
        {"pixels", pixelsJson({})},
        {"baseline", {{"time_ms", {{"frame", 1.0}}}}},
        {"notes", {"note " + text}},
        {"report_files", {"truth.png"}}};
    const auto add = [&](const std::string& name, double rmse) {
        result["results"].push_back(
            {{"technique", name}, {"error", {{"rmse", rmse}}}, {"command", "gnomon compare " + text}});
    };
    add("first " + text, 0.1);
    add("second", 0.2);
    result.update(more);
    return result;
}

std::size_t occurrences(const std::string& page, const std::string& what)
{
    std::size_t count = 0;
    for (std::size_t i = page.find(what); i != std::string::npos; i = page.find(what, i + 1))
        ++count;
    return count;
}

struct Tags {
    std::vector<std::string> opened;
    std::vector<std::string> values; // of attributes
    std::string error;               // the first thing that is wrong; empty when nothing is
};

// Enough of HTML for our pages: every < opens a tag, attributes are in double quotes, all but void elements are closed.
Tags readTags(const std::string& page)
{
    const std::set<std::string> empty_elements = {"meta", "link", "img", "!DOCTYPE"};
    Tags tags;
    std::vector<std::string> open;
    for (std::size_t i = page.find('<'); i != std::string::npos; i = page.find('<', i)) {
        std::string tag;
        bool quoted = false;
        std::size_t value_start = 0;
        for (++i; i < page.size() && (quoted || page[i] != '>'); ++i) {
            if (page[i] == '"') {
                if (quoted)
                    tags.values.push_back(page.substr(value_start, i - value_start));
                value_start = i + 1;
                quoted = !quoted;
            }
            if (page[i] == '<')
                tags.error = "< in a tag";
            tag += page[i];
        }
        if (i >= page.size())
            tags.error = "a tag without end";
        const std::string name = tag.substr(0, tag.find(' '));
        if (name.starts_with("/")) {
            if (open.empty() || "/" + open.back() != name) {
                tags.error = name + " closes nothing";
                return tags;
            }
            open.pop_back();
        } else {
            tags.opened.push_back(name);
            if (name == "script") { // holds anything but its own end
                const std::size_t end = page.find("</script", i);
                if (end == std::string::npos) {
                    tags.error = "a script without end";
                    return tags;
                }
                i = end;
            }
            if (!empty_elements.contains(name))
                open.push_back(name);
        }
    }
    if (!open.empty())
        tags.error = open.back() + " stays open";
    return tags;
}

TEST(ReportPage, TheReaderOfTagsSeesMistakes)
{
    EXPECT_EQ(readTags("<p><img src=\"a>b\"></p>").error, "");
    EXPECT_NE(readTags("<p><b></p></b>").error, "");
    EXPECT_NE(readTags("<p>").error, "");
    EXPECT_NE(readTags("</p>").error, "");
    EXPECT_NE(readTags("<p <b>").error, "");
    EXPECT_NE(readTags("<p class=\"").error, "");
}

/// The page without style and scripts: all parts with the result's strings except the data of the scripts.
std::string textOf(const std::string& page)
{
    const std::size_t body = page.find("<body");
    return page.substr(body, page.find("<script") - body);
}

/// The JSON of a script element.
Json scriptOf(const std::string& page, const std::string& id)
{
    const std::string tag = "<script type=\"application/json\" id=\"" + id + "\">";
    const std::size_t start = page.find(tag) + tag.size();
    return Json::parse(page.substr(start, page.find("</script>", start) - start));
}

Json makeBench(const std::string& text)
{
    const Json pass{{"name", "pass " + text}, {"ms", 1.5}, {"iqr_ms", nullptr}, {"draws", 3}};
    const Json times{{"plan", 0.1}, {"maps", 1.5}, {"filter", 0.0}, {"mask", 2.0}, {"frame", 4.25}};
    return {{"version", "version " + text},
            {"scene", "scene " + text},
            {"scene_hash", "hash " + text},
            {"camera", "camera " + text},
            {"device", "device " + text},
            {"driver", "driver " + text},
            {"lights", Json::array({{{"name", "light " + text}, {"type", "spot"}}})},
            {"settings", {{"size", "64x32"}}},
            {"not_measured", Json::array({"missing " + text})},
            {"baseline", {{"time_ms", times}, {"passes", Json::array({pass})}, {"memory_bytes", 1048576}}},
            {"results", Json::array({{{"technique", "first " + text},
                                      {"time_ms", times},
                                      {"frame_ratio", 2.0},
                                      {"memory_bytes", 2097152},
                                      {"passes", Json::array({pass, pass})},
                                      {"command", "gnomon bench " + text}}})}};
}

TEST(ReportPage, TagsAreBalancedWhateverTheStrings)
{
    for (const bool bench : {false, true}) {
        const auto page = [&](const char* text) {
            return bench ? benchPage(makeBench(text)) : comparePage(makeResult(text), nullptr);
        };
        const Tags plain = readTags(page("plain"));
        const Tags hostile = readTags(page(kHostile));
        EXPECT_EQ(plain.error, "");
        EXPECT_EQ(hostile.error, "");
        EXPECT_EQ(plain.opened, hostile.opened); // no string became a tag
        EXPECT_EQ(plain.values.size(), hostile.values.size());
    }
    const Json bare{{"results", Json::array()}, {"notes", Json::array()}, {"report_files", Json::array()}};
    const Tags empty = readTags(comparePage(makeResult("plain", bare), nullptr));
    EXPECT_EQ(empty.error, "");
    EXPECT_LT(empty.opened.size(), readTags(comparePage(makeResult("plain"), nullptr)).opened.size());
}

TEST(ReportPage, EveryStringIsThereAndEscaped)
{
    const std::string page = comparePage(makeResult(kHostile), nullptr);
    EXPECT_EQ(page.find("<b>"), std::string::npos);
    EXPECT_EQ(page.find("<script>x"), std::string::npos);
    const std::string text = kHostileText;
    EXPECT_NE(page.find("<title>Shadows of scene " + text + "</title>"), std::string::npos);
    for (const std::string& place :
         {"<h1>Shadows of scene " + text + "</h1>", "<dt>scene</dt><dd>scene " + text + " (hash " + text + ")</dd>",
          "<dt>camera</dt><dd>camera " + text + "</dd>",
          "<dt>light</dt><dd>light " + text + ": type " + text + ", at 1,2,3, radius 0.5 m</dd>",
          "<dt>device</dt><dd>device " + text + " (driver " + text + ")</dd>",
          "<dt>version</dt><dd>version " + text + "</dd>",
          "<th role=\"rowheader\" scope=\"row\">first " + text + "</th>", "<li>note " + text + "</li>"}) {
        EXPECT_EQ(occurrences(textOf(page), place), 1U) << place;
    }
    const std::string bench = benchPage(makeBench(kHostile));
    EXPECT_EQ(bench.find("<script>x"), std::string::npos);
    EXPECT_EQ(occurrences(textOf(bench), "data-label=\"pass\">pass " + text + "</td>"), 3U);
}

/// The scripts read what was found, to the last sign, and no string ends their element.
TEST(ReportPage, ScriptsHaveTheResultAndThePictures)
{
    const Json result = makeResult(kHostile);
    const Json pictures = Json::array({{{"truth", "data:x</script>"}, {"techniques", Json::array()}}});
    const std::string page = comparePage(result, pictures);
    EXPECT_EQ(scriptOf(page, "data")["result"], result);
    EXPECT_EQ(scriptOf(page, "data")["names"], Json::array({std::string("first ") + kHostile, "second"}));
    EXPECT_EQ(scriptOf(page, "data")["legends"]["classes"]["acne"], "#d55e00");
    EXPECT_EQ(scriptOf(page, "pictures"), pictures);
    EXPECT_EQ(occurrences(page, "</script>"), 4U); // data, pictures, the charts' library, ours
    EXPECT_EQ(readTags(page).error, "");
    EXPECT_EQ(scriptOf(benchPage(makeBench(kHostile)), "data")["result"], makeBench(kHostile));
}

TEST(ReportPage, ASweepsStringsAreEscapedToo)
{
    const Json line{{"technique", std::string("first ") + kHostile}, {"rmse", {0.1, nullptr}}};
    const Json more{
        {"results", Json::array()},
        {"sweep", {{"key", std::string("key ") + kHostile}, {"values", {1.0, 2.5}}, {"results", Json::array({line})}}}};
    const std::string page = comparePage(makeResult(kHostile, more), nullptr);
    EXPECT_EQ(readTags(page).error, "");
    EXPECT_EQ(page.find("<script>x"), std::string::npos);
    const std::string text = kHostileText;
    const std::string label = "<td role=\"cell\" data-label=\"key " + text + "\">";
    for (const std::string& place :
         {"scope=\"col\">key " + text + "</th>", "<caption>Every technique over key " + text + ".</caption>",
          label + "1</td><td role=\"cell\" data-label=\"rmse\">0.1000</td>",
          label + "2.5</td><td role=\"cell\" data-label=\"rmse\">-</td>"}) {
        EXPECT_EQ(occurrences(textOf(page), place), 1U) << place;
    }
}

TEST(ReportPage, AWalksStringsAreEscapedToo)
{
    const Json path{{"name", std::string("walk ") + kHostile}, {"frames", {{"first", 3}, {"last", 5}}}, {"fps", 30.0}};
    const std::string page = comparePage(makeResult(kHostile, {{"path", path}}), nullptr);
    EXPECT_EQ(readTags(page).error, "");
    const std::string text = kHostileText;
    EXPECT_EQ(occurrences(textOf(page), "<dd>walk " + text + ", frames 3 to 5, 30 per second; "), 1U);
    EXPECT_EQ(occurrences(textOf(page), "<caption>Best first; means over the frames.</caption>"), 1U);
    EXPECT_EQ(occurrences(textOf(page), "title=\"root of the mean squared change"), 1U); // shimmer
}

TEST(ReportPage, NothingIsFetched)
{
    for (const std::string& page : {comparePage(makeResult("plain"), nullptr), benchPage(makeBench("plain"))}) {
        EXPECT_EQ(occurrences(page, "default-src 'none'"), 1U);
        EXPECT_EQ(page.find("default-src 'none'") < page.find("<style"), true); // before there is anything to load
        for (const char* foreign : {" src=\"", "url(", "@import", "<iframe", "onerror=", "onload=", "import("}) {
            EXPECT_EQ(occurrences(page, foreign), 0U) << foreign;
        }
        EXPECT_EQ(occurrences(page, " href=\"data:,\""), occurrences(page, " href="));
        EXPECT_NE(page.find("Permission is hereby granted, free of charge"), std::string::npos); // of Chart.js
    }
}

/// RFC 4648, section 10.
TEST(ReportPage, PicturesAreBase64)
{
    const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
    for (const auto& [text, code] : cases) {
        EXPECT_EQ(dataUri(text), std::string("data:image/png;base64,") + code);
    }
    EXPECT_EQ(dataUri("\xff\xfe\xfb"), "data:image/png;base64,//77");
}

TEST(ReportPictures, AreReducedWhereTheyWouldBeTooMany)
{
    EXPECT_EQ(pageReduction(17 * 1280 * 720), 1U);
    EXPECT_EQ(pageReduction(kMostPagePixels), 1U);
    EXPECT_EQ(pageReduction(kMostPagePixels + 1), 2U);
    EXPECT_EQ(pageReduction(std::uint64_t{3} * 17 * 3840 * 2160), 6U);
    Image8 picture(3, 2, 2);
    picture.values = {10, 0, 20, 0, 30, 5, 30, 0, 40, 0, 50, 6};
    const Image8 small = reduced(picture, 2);
    EXPECT_EQ(small.width, 2U);
    EXPECT_EQ(small.height, 1U);
    EXPECT_EQ(small.values,
              (std::vector<std::uint8_t>{25, 0, 40, 6})); // the last two pixels are a square that ends there
    EXPECT_EQ(reduced(picture, 1).values, picture.values);
}

TEST(CommandText, SaysWhatIsNotAtItsDefault)
{
    Settings settings = defaultSettings();
    settings.subcommand = kCompare;
    settings.scene = "my scene.glb";
    EXPECT_EQ(commandText(settings, kCompare, "hard"), "gnomon compare 'my scene.glb' --techniques=hard");
    for (const auto& [key, value] : std::initializer_list<std::pair<const char*, const char*>>{
             {"size", "64x32"}, {"sun", "-1,-1,0"}, {"map-size", "512"}, {"equal-error", "1"}, {"camera", "it's"}}) {
        applySetting(settings, key, value);
    }
    const std::string text = commandText(settings, kCompare, "pcf+map-size=512");
    EXPECT_EQ(text, "gnomon compare 'my scene.glb' --size=64x32 '--camera=it'\\''s' --sun=-1,-1,0 --equal-error "
                    "--techniques=pcf+map-size=512");
    EXPECT_EQ(commandText(settings, kBench, "hard").find("equal-error"), std::string::npos);
    settings.scene = "-x.glb";
    EXPECT_TRUE(commandText(settings, kBench, "hard").starts_with("gnomon bench ./-x.glb "));
}

TEST(CommandText, AWordIsOneWordToAShell)
{
    EXPECT_EQ(shellWord("pcf+map-size=1024,x.y/z%:@_-"), "pcf+map-size=1024,x.y/z%:@_-");
    EXPECT_EQ(shellWord(""), "''");
    EXPECT_EQ(shellWord("a b"), "'a b'");
    EXPECT_EQ(shellWord("$(x) `y` \"z\" \\ ~ * ? ! ; & | <"), "'$(x) `y` \"z\" \\ ~ * ? ! ; & | <'");
    EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
    EXPECT_EQ(shellWord("a\nb"), "'a\nb'");
}

} // namespace
} // namespace gnomon::app
