// SPDX-License-Identifier: Apache-2.0
// The page is well-formed, carries every string as text, and asks for nothing from elsewhere.
#include "compare_page.h"

#include "compare_json.h"

#include <gtest/gtest.h>

#include <algorithm>
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
        {"report_files", {"truth.png", "error.svg", "sweep.svg"}}};
    const auto add = [&](const std::string& name, const std::string& number, const std::string& density) {
        Json pictures{{"truth", "truth.png"},
                      {"mask", number + "m.png"},
                      {"error", number + "e.png"},
                      {"classes", number + "c.png"},
                      {"density", density}};
        result["results"].push_back({{"technique", name},
                                     {"error", {{"rmse", number == "1" ? 0.1 : 0.2}}},
                                     {"pictures", Json::array({pictures})}});
    };
    add("first " + text, "1", "1d.png");
    add("second", "2", "2d.png");
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
    const std::set<std::string> empty_elements = {"meta", "img", "!DOCTYPE"};
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
            if (!empty_elements.contains(name))
                open.push_back(name);
        }
    }
    if (!open.empty())
        tags.error = open.back() + " stays open";
    return tags;
}

TEST(ComparePage, TheReaderOfTagsSeesMistakes)
{
    EXPECT_EQ(readTags("<p><img src=\"a>b\"></p>").error, "");
    EXPECT_NE(readTags("<p><b></p></b>").error, "");
    EXPECT_NE(readTags("<p>").error, "");
    EXPECT_NE(readTags("</p>").error, "");
    EXPECT_NE(readTags("<p <b>").error, "");
    EXPECT_NE(readTags("<p class=\"").error, "");
}

TEST(ComparePage, TagsAreBalancedWhateverTheStrings)
{
    const Tags plain = readTags(comparePage(makeResult("plain")));
    const Tags hostile = readTags(comparePage(makeResult(kHostile)));
    EXPECT_EQ(plain.error, "");
    EXPECT_EQ(hostile.error, "");
    EXPECT_EQ(plain.opened, hostile.opened); // no string became a tag
    EXPECT_EQ(plain.values.size(), hostile.values.size());
    const Json bare{{"results", Json::array()}, {"notes", Json::array()}, {"report_files", Json::array()}};
    const Tags empty = readTags(comparePage(makeResult("plain", bare)));
    EXPECT_EQ(empty.error, "");
    EXPECT_LT(empty.opened.size(), plain.opened.size());
}

TEST(ComparePage, EveryStringIsThereAndEscaped)
{
    const std::string page = comparePage(makeResult(kHostile));
    EXPECT_EQ(page.find("<b>"), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    const std::string text = kHostileText;
    const std::string title = "Shadows of scene " + text + " against ray-traced truth";
    for (const std::string& place :
         {"<title>" + title + "</title>", "<h1>" + title + "</h1>",
          "<dt>scene</dt><dd>scene " + text + " (hash " + text + ")</dd>",
          "<dt>camera</dt><dd>camera " + text + "</dd>",
          "<dt>light</dt><dd>light " + text + ": type " + text + ", at 1,2,3, radius 0.5 m</dd>",
          "<dt>device</dt><dd>device " + text + " (driver " + text + ")</dd>",
          "<dt>version</dt><dd>version " + text + "</dd>",
          "<th scope=\"row\"><a href=\"#technique-1\">first " + text + "</a></th>", "<li>note " + text + "</li>",
          ">first " + text + "</h2>", "alt=\"Mask of first " + text, "alt=\"Signed error of first " + text,
          "alt=\"Classes of the error of first " + text, "alt=\"Shadow texels per pixel of first " + text}) {
        EXPECT_EQ(occurrences(page, place), 1U) << place;
    }
}

TEST(ComparePage, ASweepsStringsAreEscapedToo)
{
    const Json line{{"technique", std::string("first ") + kHostile}, {"rmse", {0.1, nullptr}}};
    const Json more{
        {"results", Json::array()},
        {"sweep", {{"key", std::string("key ") + kHostile}, {"values", {1.0, 2.5}}, {"results", Json::array({line})}}}};
    const std::string page = comparePage(makeResult(kHostile, more));
    EXPECT_EQ(readTags(page).error, "");
    EXPECT_EQ(page.find("<script"), std::string::npos);
    const std::string text = kHostileText;
    for (const std::string& place :
         {"<th scope=\"col\">key " + text + "</th>", "<caption>Every technique over key " + text + ".</caption>",
          "<figcaption>Error over key " + text + ", and where it comes from.</figcaption>",
          "<th scope=\"row\">first " + text + "</th><td>1</td><td>0.1000</td>",
          "<th scope=\"row\">first " + text + "</th><td>2.5</td><td>-</td>"}) {
        EXPECT_EQ(occurrences(page, place), 1U) << place;
    }
}

TEST(ComparePage, AWalksStringsAreEscapedToo)
{
    const Json path{{"name", std::string("walk ") + kHostile}, {"frames", {{"first", 3}, {"last", 5}}}, {"fps", 30.0}};
    Json result = makeResult(kHostile, {{"path", path}});
    for (Json& technique : result["results"]) {
        Json frame = technique["pictures"][0];
        frame.erase("density");
        frame["frame"] = 4;
        technique["pictures"] = Json::array({frame, frame});
    }
    const std::string page = comparePage(result);
    EXPECT_EQ(readTags(page).error, "");
    const std::string text = kHostileText;
    EXPECT_EQ(occurrences(page, "<dd>walk " + text + ", frames 3 to 5, 30 per second; "), 1U);
    EXPECT_EQ(occurrences(page, "<h3>frame 4</h3>"), 4U);
    EXPECT_EQ(occurrences(page, "alt=\"Mask of first " + text + ", frame 4 in grey\""), 2U);
    EXPECT_EQ(occurrences(page, "<caption>Best first; means over the frames.</caption>"), 1U);
    EXPECT_EQ(occurrences(page, "<th scope=\"col\" title=\"root of the mean squared change"), 1U); // shimmer
    EXPECT_EQ(occurrences(page, "src=\"./error.svg\""), 1U);
}

TEST(ComparePage, FileNamesArePathsWithinTheFolder)
{
    Json result = makeResult("");
    result["results"][0]["pictures"][0]["truth"] = "javascript:alert(1)";
    result["results"][0]["pictures"][0]["mask"] = "//elsewhere/a+b \"c'#?%.png";
    const std::string page = comparePage(result);
    EXPECT_EQ(occurrences(page, "src=\"./javascript%3Aalert%281%29\""), 1U);
    EXPECT_EQ(occurrences(page, "src=\".///elsewhere/a%2Bb%20%22c%27%23%3F%25.png\""), 1U);
    for (std::size_t i = page.find("src=\""); i != std::string::npos; i = page.find("src=\"", i + 1))
        EXPECT_EQ(page.substr(i + 5, 2), "./");
}

TEST(ComparePage, NothingRunsAndNothingIsFetched)
{
    const std::string page = comparePage(makeResult("plain"));
    for (const char* foreign :
         {"<script", "http:", "https:", "url(", "@import", "<link", "<iframe", "onerror", "onload"})
        EXPECT_EQ(occurrences(page, foreign), 0U) << foreign;
}

TEST(ComparePage, PicturesAreShownWithAltAndCaption)
{
    const std::string page = comparePage(makeResult("plain"));
    EXPECT_EQ(occurrences(page, "<img "), 2U + 5U + 5U); // truth, plot, techniques
    EXPECT_EQ(occurrences(page, "<figcaption>"), 12U);
    EXPECT_EQ(occurrences(page, "alt=\"\""), 0U);
    EXPECT_EQ(occurrences(page, " alt=\""), 12U);
    EXPECT_EQ(occurrences(page, "src=\"./truth.png\""), 3U); // at the top, and beside each mask
    for (const char* file :
         {"error.svg", "1m.png", "1e.png", "1c.png", "1d.png", "2m.png", "2e.png", "2c.png", "2d.png"}) {
        EXPECT_EQ(occurrences(page, "src=\"./" + std::string(file) + "\""), 1U) << file;
    }
    EXPECT_EQ(occurrences(page, "change.svg"), 0U); // it is not among the report's files
}

TEST(ComparePage, AMapsPictureIsShownOnce)
{
    Json result = makeResult("plain");
    result["results"][1]["pictures"][0]["density"] = "1d.png";
    const std::string page = comparePage(result);
    EXPECT_EQ(readTags(page).error, "");
    EXPECT_EQ(occurrences(page, "src=\"./1d.png\""), 1U);
    const std::size_t link = page.find("The picture is <a href=\"#technique-1\">that of first plain</a>");
    EXPECT_LT(page.find("id=\"technique-2\""), link);
    EXPECT_NE(link, std::string::npos);
}

TEST(ComparePage, ColumnsSayWhatTheyMean)
{
    const std::string page = comparePage(makeResult("plain"));
    EXPECT_EQ(occurrences(page, "<th scope=\"col\">technique</th>"), 1U); // which needs no word
    EXPECT_EQ(occurrences(page, "<th scope=\"col\" title=\"memory beyond the frame without shadows\">MiB</th>"), 1U);
    EXPECT_EQ(occurrences(page, "<dt>MiB</dt><dd>memory beyond the frame without shadows</dd>"), 1U);
    EXPECT_EQ(occurrences(page, "<dt>technique</dt>"), 0U);
}

TEST(ComparePage, RowsAndTechniquesKeepTheirOrderAndAreLinked)
{
    const std::string page = comparePage(makeResult("plain"));
    EXPECT_LT(page.find("<td>0.1000</td>"), page.find("<td>0.2000</td>"));
    EXPECT_LT(page.find("id=\"technique-1\""), page.find("id=\"technique-2\""));
    EXPECT_LT(page.find("<caption>Best first.</caption>"), page.find("<td>0.1000</td>"));
    for (const char* id : {"technique-1", "technique-2"}) {
        EXPECT_EQ(occurrences(page, "href=\"#" + std::string(id) + "\""), 1U);
        EXPECT_EQ(occurrences(page, " id=\"" + std::string(id) + "\""), 1U);
    }
}

TEST(ComparePage, ReadersOfLightAndDarkScreensAreServed)
{
    const std::string page = comparePage(makeResult("plain"));
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
    EXPECT_NE(page.find("color-scheme: light dark"), std::string::npos);
    EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
    EXPECT_NE(page.find("<meta charset=\"utf-8\">"), std::string::npos);
    EXPECT_EQ(comparePage(makeResult("plain")), page);
}

} // namespace
} // namespace gnomon::app
