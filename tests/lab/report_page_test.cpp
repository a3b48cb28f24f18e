// SPDX-License-Identifier: Apache-2.0
// The page is well-formed, carries every string as text, and asks for nothing from elsewhere.
#include "lab/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace gnomon::lab {
namespace {

constexpr const char* kHostile = "a<b>&\"c'</td><script>x</script>";
constexpr const char* kHostileText = "a&lt;b&gt;&amp;&quot;c&#39;&lt;/td&gt;&lt;script&gt;x&lt;/script&gt;";

Report makeReport(const std::string& text)
{
    Report report;
    report.title = "title " + text;
    report.truth_file = "truth.png";
    report.facts = {{"fact " + text, "value " + text}};
    report.plots = {{"plot.svg", "plot " + text}};
    report.table_caption = "caption " + text;
    report.columns = {"technique " + text, "rmse"};
    report.column_meanings = {"", "meaning " + text};
    report.rows = {{"first " + text, "0.1 " + text}, {"second", "0.2"}};
    report.techniques = {{"first " + text, "m.png", "e.png", "c.png", "d.png"},
                         {"second", "n.png", "f.png", "g.png", ""}};
    report.notes = {"note " + text};
    return report;
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

TEST(ReportPage, TheReaderOfTagsSeesMistakes)
{
    EXPECT_EQ(readTags("<p><img src=\"a>b\"></p>").error, "");
    EXPECT_NE(readTags("<p><b></p></b>").error, "");
    EXPECT_NE(readTags("<p>").error, "");
    EXPECT_NE(readTags("</p>").error, "");
    EXPECT_NE(readTags("<p <b>").error, "");
    EXPECT_NE(readTags("<p class=\"").error, "");
}

TEST(ReportPage, TagsAreBalancedWhateverTheStrings)
{
    const Tags plain = readTags(reportPage(makeReport("plain")));
    const Tags hostile = readTags(reportPage(makeReport(kHostile)));
    EXPECT_EQ(plain.error, "");
    EXPECT_EQ(hostile.error, "");
    EXPECT_EQ(plain.opened, hostile.opened); // no string became a tag
    EXPECT_EQ(plain.values.size(), hostile.values.size());
    EXPECT_EQ(readTags(reportPage(Report{})).error, "");
}

TEST(ReportPage, EveryStringIsThereAndEscaped)
{
    const std::string page = reportPage(makeReport(kHostile));
    EXPECT_EQ(page.find("<b>"), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    const std::string text = kHostileText;
    for (const std::string& place :
         {"<title>title " + text + "</title>", "<h1>title " + text + "</h1>",
          "<dt>fact " + text + "</dt><dd>value " + text + "</dd>", "<th scope=\"col\">technique " + text + "</th>",
          "<th scope=\"col\" title=\"meaning " + text + "\">rmse</th>", "<dt>rmse</dt><dd>meaning " + text + "</dd>",
          "<th scope=\"row\"><a href=\"#technique-1\">first " + text + "</a></th>", "<td>0.1 " + text + "</td>",
          "<caption>caption " + text + "</caption>", "<figcaption>plot " + text + "</figcaption>",
          "<li>note " + text + "</li>", ">first " + text + "</h2>", "alt=\"Mask of first " + text})
        EXPECT_EQ(occurrences(page, place), 1U) << place;
}

TEST(ReportPage, FileNamesArePathsWithinTheFolder)
{
    Report report = makeReport("");
    report.truth_file = "javascript:alert(1)";
    report.techniques[0].mask_file = "//elsewhere/a+b \"c'#?%.png";
    const std::string page = reportPage(report);
    EXPECT_EQ(occurrences(page, "src=\"./javascript%3Aalert%281%29\""), 3U);
    EXPECT_EQ(occurrences(page, "src=\".///elsewhere/a%2Bb%20%22c%27%23%3F%25.png\""), 1U);
    for (std::size_t i = page.find("src=\""); i != std::string::npos; i = page.find("src=\"", i + 1))
        EXPECT_EQ(page.substr(i + 5, 2), "./");
}

TEST(ReportPage, NothingRunsAndNothingIsFetched)
{
    const std::string page = reportPage(makeReport("plain"));
    for (const char* foreign :
         {"<script", "http:", "https:", "url(", "@import", "<link", "<iframe", "onerror", "onload"})
        EXPECT_EQ(occurrences(page, foreign), 0U) << foreign;
}

TEST(ReportPage, PicturesWithAFileAreShownWithAltAndCaption)
{
    const std::string page = reportPage(makeReport("plain"));
    EXPECT_EQ(occurrences(page, "<img "), 2U + 5U + 4U); // the second technique has no density
    EXPECT_EQ(occurrences(page, "<figcaption>"), 11U);
    EXPECT_EQ(occurrences(page, "alt=\"\""), 0U);
    EXPECT_EQ(occurrences(page, " alt=\""), 11U);
    EXPECT_EQ(occurrences(page, "src=\"./truth.png\""), 3U); // at the top, and beside each mask
    for (const char* file : {"plot.svg", "m.png", "e.png", "c.png", "d.png", "n.png", "f.png", "g.png"})
        EXPECT_EQ(occurrences(page, "src=\"./" + std::string(file) + "\""), 1U) << file;
}

TEST(ReportPage, AMapsPictureIsShownOnce)
{
    Report report = makeReport("plain");
    report.techniques[1].density_file = "d.png";
    const std::string page = reportPage(report);
    EXPECT_EQ(readTags(page).error, "");
    EXPECT_EQ(occurrences(page, "src=\"./d.png\""), 1U);
    const std::size_t link = page.find("The picture is <a href=\"#technique-1\">that of first plain</a>");
    EXPECT_LT(page.find("id=\"technique-2\""), link);
    EXPECT_NE(link, std::string::npos);
}

TEST(ReportPage, ColumnsWithoutAMeaningStandAlone)
{
    Report report = makeReport("plain");
    report.column_meanings.clear();
    const std::string page = reportPage(report);
    EXPECT_EQ(occurrences(page, "<th scope=\"col\">rmse</th>"), 1U);
    EXPECT_EQ(occurrences(page, "class=\"meanings\""), 0U);
}

TEST(ReportPage, RowsAndTechniquesKeepTheirOrderAndAreLinked)
{
    const std::string page = reportPage(makeReport("plain"));
    EXPECT_LT(page.find("0.1 plain"), page.find("0.2"));
    EXPECT_LT(page.find("id=\"technique-1\""), page.find("id=\"technique-2\""));
    EXPECT_LT(page.find("<caption>caption plain</caption>"), page.find("0.1 plain"));
    for (const char* id : {"technique-1", "technique-2"}) {
        EXPECT_EQ(occurrences(page, "href=\"#" + std::string(id) + "\""), 1U);
        EXPECT_EQ(occurrences(page, " id=\"" + std::string(id) + "\""), 1U);
    }
}

TEST(ReportPage, ReadersOfLightAndDarkScreensAreServed)
{
    const std::string page = reportPage(makeReport("plain"));
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
    EXPECT_NE(page.find("color-scheme: light dark"), std::string::npos);
    EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
    EXPECT_NE(page.find("<meta charset=\"utf-8\">"), std::string::npos);
    EXPECT_EQ(reportPage(makeReport("plain")), page);
}

} // namespace
} // namespace gnomon::lab
