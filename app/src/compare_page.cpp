// SPDX-License-Identifier: Apache-2.0
// Plain HTML and CSS: nothing runs and nothing is fetched.
#include "compare_page.h"

#include "compare_text.h"
#include "page_style.h"
#include "report_names.h"
#include "sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace gnomon::app {
namespace {

std::string escaped(std::string_view text)
{
    constexpr std::string_view kSpecial = "&<>\"'";
    constexpr const char* kEntities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    std::string out;
    for (const char c : text) {
        const std::size_t i = kSpecial.find(c);
        out += i == std::string_view::npos ? std::string(1, c) : kEntities[i];
    }
    return out;
}

/// A path as RFC 3986 has it. All but letters, digits and -._~/ is written as %XX, so that neither ? nor # nor : has a
/// meaning, and "./" before it keeps it in the page's folder.
std::string urlOf(std::string_view path)
{
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
    std::string url = "./";
    for (const char c : path) {
        url += kPlain.find(c) != std::string_view::npos ? std::string(1, c)
                                                        : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return url;
}

/// `text` is text, all others are HTML; an empty section is none.
std::string section(std::string_view id, std::string_view text, std::string_view body)
{
    return body.empty() ? std::string()
                        : fmt::format("<section aria-labelledby=\"{0}\">\n<h2 id=\"{0}\">{1}</h2>\n{2}</section>\n", id,
                                      escaped(text), body);
}

std::string pictures(std::string_view figures)
{
    return figures.empty() ? std::string() : fmt::format("<div class=\"pictures\">\n{}</div>\n", figures);
}

std::string figure(const std::string& file, std::string_view alternative, std::string_view caption)
{
    return fmt::format(
        "<figure>\n<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>\n<figcaption>{2}</figcaption>\n</figure>\n",
        urlOf(file), escaped(alternative), escaped(caption));
}

std::string definition(std::string_view name, std::string_view text)
{
    return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(text));
}

std::string sectionId(std::size_t technique)
{
    return fmt::format("technique-{}", technique + 1);
}

/// What was compared and how, for whoever opens the page a year later.
std::string facts(const Json& result)
{
    std::string list = "<dl>\n";
    const auto add = [&](std::string_view name, std::string_view text) {
        list += definition(name, text);
    };
    add("scene", fmt::format("{} ({})", textAt(result, "/scene"), textAt(result, "/scene_hash")));
    add("camera", textAt(result, "/camera"));
    add("light", fmt::format("{}: {}", textAt(result, "/light"), lightText(result.at("light_source"))));
    if (result.contains("sweep") && result.at("sweep").contains("truth")) {
        const Json& sweep = result.at("sweep");
        add("shown", fmt::format("scene, camera, light and the truth's picture at {}",
                                 placeText(textAt(sweep, "/key"), sweep.at("values")[0].get<double>())));
    }
    if (result.contains("path")) {
        add("path", fmt::format("{}, {} per second; camera and light are of the first", framesText(result),
                                *numberAt(result, "/path/fps")));
    }
    const Json& size = result.at("size_px");
    add("size", fmt::format("{} x {} pixels", size[0].dump(), size[1].dump()));
    add("truth", truthText(result));
    add("pixels", countedText(result));
    add("device", fmt::format("{} ({})", textAt(result, "/device"), textAt(result, "/driver")));
    add("version", textAt(result, "/version"));
    add("result", fmt::format("{}: every number, and the settings to repeat it", kReportResult));
    return list + "</dl>\n";
}

/// Those that are there.
std::string plots(const Json& result)
{
    const Json& files = result.at("report_files");
    std::string figures;
    const auto add = [&](const std::string& file, const std::string& caption) {
        if (std::find(files.begin(), files.end(), file) != files.end()) {
            figures += figure(file, caption, caption);
        }
    };
    add(kReportError, "Error of every technique over the frames.");
    add(kReportChange, "How much the error of every technique changes from one frame to the next, at the same points: "
                       "level is steady, peaks are pops.");
    if (result.contains("sweep")) {
        const std::string& key = textAt(result, "/sweep/key");
        const Json& lines = result.at("sweep").at("results");
        add(kReportSweep, lines.size() == 1 ? fmt::format("Error over {}, and where it comes from.", key)
                                            : fmt::format("Error of every technique over {}.", key));
        for (std::size_t i = 0; i < lines.size(); ++i) {
            add(numbered(i, kReportSweep),
                fmt::format("{}: where its error over {} comes from.", textAt(lines[i], "/technique"), key));
        }
    }
    return pictures(figures);
}

std::string tableCaption(const Json& result)
{
    if (result.contains("sweep")) {
        return fmt::format("Every technique over {}.", textAt(result, "/sweep/key"));
    }
    return result.contains("path") ? "Best first; means over the frames." : "Best first.";
}

std::string numbers(const Json& result)
{
    const TextTable table = compareTable(result, false);
    std::string head;
    std::string meanings;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        const std::string& meaning = table.meanings[column];
        const std::string title = meaning.empty() ? "" : fmt::format(" title=\"{}\"", escaped(meaning));
        head += fmt::format("<th scope=\"col\"{}>{}</th>", title, escaped(table.columns[column]));
        meanings += meaning.empty() ? "" : definition(table.columns[column], meaning);
    }
    std::string body;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const std::string name = escaped(table.rows[row].front());
        const bool linked = row < result.at("results").size();
        body += fmt::format("<tr><th scope=\"row\">{}</th>",
                            linked ? fmt::format("<a href=\"#{}\">{}</a>", sectionId(row), name) : name);
        for (std::size_t column = 1; column < table.columns.size(); ++column) {
            body += fmt::format("<td>{}</td>", escaped(table.rows[row][column]));
        }
        body += "</tr>\n";
    }
    return fmt::format("<div class=\"scroll\" role=\"region\" aria-labelledby=\"numbers\" tabindex=\"0\">\n"
                       "<table>\n<caption>{}</caption>\n<thead>\n<tr>{}</tr>\n</thead>\n<tbody>\n{}</tbody>\n</table>\n"
                       "</div>\n<dl class=\"meanings\">\n{}</dl>\n",
                       escaped(tableCaption(result)), head, body, meanings);
}

std::string notes(const Json& result)
{
    std::string items;
    for (const Json& note : result.at("notes")) {
        items += fmt::format("<li>{}</li>\n", escaped(textAt(note, "")));
    }
    return items.empty() ? items : "<ul>\n" + items + "</ul>\n";
}

/// Techniques that render the same map have the same picture, which is shown once.
std::string density(const Json& results, std::size_t number)
{
    constexpr std::string_view kMeaning = "Shadow texels per screen pixel: below 1 a texel covers more than a pixel.";
    const std::string& file = textAt(results[number], "/pictures/0/density");
    std::size_t first = 0;
    while (textAt(results[first], "/pictures/0/density") != file) {
        ++first;
    }
    const std::string& name = textAt(results[first], "/technique");
    return first == number ? figure(file, "Shadow texels per pixel of " + name + " in false colour", kMeaning)
                           : fmt::format("<p>{} The picture is <a href=\"#{}\">that of {}</a>.</p>\n", kMeaning,
                                         sectionId(first), escaped(name));
}

/// Truth and technique side by side, frame after frame.
std::string shownFrames(const Json& results, std::size_t number)
{
    std::string body;
    for (const Json& shown : results[number].at("pictures")) {
        const bool many = shown.contains("frame");
        const std::string frame = many ? fmt::format(", frame {}", shown.at("frame").dump()) : "";
        const std::string where = textAt(results[number], "/technique") + frame;
        std::string figures =
            figure(textAt(shown, "/truth"), "The ray-traced mask in grey" + frame,
                   many ? "The truth: white is lit, black is in shadow."
                        : "The truth again, to look from one to the other.") +
            figure(textAt(shown, "/mask"), "Mask of " + where + " in grey", "Mask: white is lit, black is in shadow.") +
            figure(textAt(shown, "/error"), "Signed error of " + where + " in false colour",
                   "Error: blue where the mask is darker than the truth, orange where it is brighter.") +
            figure(textAt(shown, "/classes"), "Classes of the error of " + where + " in colour over the grey truth",
                   "Where the error comes from, over the truth.");
        if (shown.contains("density")) {
            figures += density(results, number);
        }
        body += (many ? fmt::format("<h3>{}</h3>\n", frame.substr(2)) : "") + pictures(figures);
    }
    return body;
}

} // namespace

std::string comparePage(const Json& result)
{
    const std::string title = fmt::format("Shadows of {} against ray-traced truth", textAt(result, "/scene"));
    std::string body = "<div class=\"overview\">\n" + section("facts", "What was compared", facts(result)) +
                       section("truth", "The truth",
                               figure(kReportTruth, "The ray-traced mask in grey",
                                      "Traced with rays. White is lit, black is in shadow.")) +
                       "</div>\n" + section("plots", "Plots", plots(result)) +
                       section("numbers", "Numbers", numbers(result)) + section("notes", "Notes", notes(result));
    const Json& results = result.at("results");
    for (std::size_t i = 0; i < results.size(); ++i) {
        body += section(sectionId(i), textAt(results[i], "/technique"), shownFrames(results, i));
    }
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
                       "<style>\n{1}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n</header>\n<main>\n{2}</main>\n"
                       "</body>\n</html>\n",
                       escaped(title), kPageStyle, body);
}

} // namespace gnomon::app
