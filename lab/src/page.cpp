// SPDX-License-Identifier: Apache-2.0
// The page of a comparison. Plain HTML and CSS: nothing runs and nothing is fetched.
#include "lab/report.h"

#include <cassert>

namespace gnomon::lab {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --ground: #fbfbf9; --panel: #ffffff; --ink: #1d1d1b; --faint: #5c5c57;
  --line: #d9d8d2; --link: #0b5a94; --best: #eaf3fa; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #161617; --panel: #1f1f21; --ink: #ececea; --faint: #a8a8a3; --line: #3a3a3d; --link: #8cc4f0;
    --best: #1c2c38; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem clamp(0.75rem, 3vw, 2.5rem) 4rem; max-width: 110rem; background: var(--ground);
  color: var(--ink); font: 1rem/1.5 system-ui, sans-serif; }
h1 { margin: 0.5rem 0 1.5rem; font-size: 1.75rem; line-height: 1.2; }
h2 { margin: 3rem 0 0.75rem; font-size: 1.25rem; }
h3 { margin: 1.5rem 0 0.75rem; font-size: 1rem; color: var(--faint); }
.overview h2 { margin-top: 0; }
h1, h2, dd, td, th, figcaption { overflow-wrap: anywhere; }
a { color: var(--link); }
a:focus-visible { outline: 3px solid var(--link); outline-offset: 2px; }
.overview { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 1.5rem 2.5rem;
  align-items: start; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.3rem 1.25rem; margin: 0; }
dt { color: var(--faint); }
.meanings { margin-top: 0.75rem; font-size: 0.9rem; }
dd { margin: 0; }
.scroll { overflow-x: auto; border: 1px solid var(--line); border-radius: 6px; background: var(--panel); }
table { border-collapse: collapse; min-width: 100%; font-variant-numeric: tabular-nums; }
caption { padding: 0.6rem 0.9rem; text-align: left; color: var(--faint); }
th, td { padding: 0.45rem 0.9rem; border-top: 1px solid var(--line); text-align: right; overflow-wrap: normal; }
th:first-child { text-align: left; }
thead th { color: var(--faint); font-weight: 600; vertical-align: bottom; }
tbody tr:first-child { background: var(--best); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 34rem), 1fr)); gap: 1.25rem;
  align-items: start; }
figure { margin: 0; padding: 0.6rem; border: 1px solid var(--line); border-radius: 6px; background: var(--panel); }
figure a { display: block; }
img { display: block; max-width: 100%; height: auto; margin: 0 auto; outline: 1px solid var(--line); }
figcaption { margin-top: 0.5rem; color: var(--faint); font-size: 0.9rem; }
@media print { body { max-width: none; } figure, tr { break-inside: avoid; } }
)css";

std::string escapeHtml(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        switch (c) {
        case '&':
            out += "&amp;";
            break;
        case '<':
            out += "&lt;";
            break;
        case '>':
            out += "&gt;";
            break;
        case '"':
            out += "&quot;";
            break;
        case '\'':
            out += "&#39;";
            break;
        default:
            out += c;
        }
    }
    return out;
}

// A path as RFC 3986 has it. All but letters, digits and -._~/ is written as %XX, so that neither ? nor # nor : has a
// meaning, and "./" before it keeps it in the page's folder.
std::string urlOf(std::string_view path)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
    std::string url = "./";
    for (const char c : path) {
        if (plain.find(c) != std::string_view::npos) {
            url += c;
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        url += '%';
        url += digits[byte >> 4U];
        url += digits[byte & 15U];
    }
    return url;
}

std::string sectionId(std::size_t technique)
{
    return "technique-" + std::to_string(technique + 1);
}

void addFigure(std::string& page, const std::string& file, const std::string& alternative, std::string_view caption)
{
    if (file.empty())
        return;
    const std::string url = urlOf(file);
    page += "<figure>\n<a href=\"" + url + "\"><img src=\"" + url + "\" alt=\"" + escapeHtml(alternative) +
            "\"></a>\n<figcaption>" + escapeHtml(caption) + "</figcaption>\n</figure>\n";
}

void addFacts(std::string& page, const Report& report)
{
    if (report.facts.empty())
        return;
    page += "<section aria-labelledby=\"facts\">\n<h2 id=\"facts\">What was compared</h2>\n<dl>\n";
    for (const auto& [name, value] : report.facts)
        page += "<dt>" + escapeHtml(name) + "</dt><dd>" + escapeHtml(value) + "</dd>\n";
    page += "</dl>\n</section>\n";
}

void addTruth(std::string& page, const Report& report)
{
    if (report.truth_file.empty())
        return;
    page += "<section aria-labelledby=\"truth\">\n<h2 id=\"truth\">The truth</h2>\n";
    addFigure(page, report.truth_file, "The ray-traced mask in grey",
              "Traced with rays. White is lit, black is in shadow.");
    page += "</section>\n";
}

void addPlots(std::string& page, const Report& report)
{
    if (report.plots.empty())
        return;
    page += "<section aria-labelledby=\"plots\">\n<h2 id=\"plots\">Plots</h2>\n<div class=\"pictures\">\n";
    for (const ReportPlot& plot : report.plots)
        addFigure(page, plot.file, plot.caption, plot.caption);
    page += "</div>\n</section>\n";
}

std::string_view meaningOf(const Report& report, std::size_t column)
{
    return column < report.column_meanings.size() ? report.column_meanings[column] : std::string_view();
}

void addMeanings(std::string& page, const Report& report)
{
    std::string meanings;
    for (std::size_t column = 0; column < report.columns.size(); ++column) {
        if (const std::string_view meaning = meaningOf(report, column); !meaning.empty())
            meanings += "<dt>" + escapeHtml(report.columns[column]) + "</dt><dd>" + escapeHtml(meaning) + "</dd>\n";
    }
    if (!meanings.empty())
        page += "<dl class=\"meanings\">\n" + meanings + "</dl>\n";
}

void addTable(std::string& page, const Report& report)
{
    page += "<section aria-labelledby=\"numbers\">\n<h2 id=\"numbers\">Numbers</h2>\n<div class=\"scroll\" "
            "role=\"region\" aria-labelledby=\"numbers\" tabindex=\"0\">\n<table>\n<caption>" +
            escapeHtml(report.table_caption) + "</caption>\n<thead>\n<tr>";
    for (std::size_t column = 0; column < report.columns.size(); ++column) {
        const std::string_view meaning = meaningOf(report, column);
        page += "<th scope=\"col\"" + (meaning.empty() ? "" : " title=\"" + escapeHtml(meaning) + "\"") + ">" +
                escapeHtml(report.columns[column]) + "</th>";
    }
    page += "</tr>\n</thead>\n<tbody>\n";
    for (std::size_t row = 0; row < report.rows.size(); ++row) {
        assert(report.rows[row].size() == report.columns.size());
        page += "<tr>";
        for (std::size_t column = 0; column < report.rows[row].size(); ++column) {
            const std::string text = escapeHtml(report.rows[row][column]);
            if (column > 0)
                page += "<td>" + text + "</td>";
            else if (row < report.techniques.size())
                page += "<th scope=\"row\"><a href=\"#" + sectionId(row) + "\">" + text + "</a></th>";
            else
                page += "<th scope=\"row\">" + text + "</th>";
        }
        page += "</tr>\n";
    }
    page += "</tbody>\n</table>\n</div>\n";
    addMeanings(page, report);
    page += "</section>\n";
}

constexpr std::string_view kDensity = "Shadow texels per screen pixel: below 1 a texel covers more than a pixel.";

// Techniques that render the same map have the same picture, which is shown once.
void addDensity(std::string& page, const Report& report, std::size_t number)
{
    const ReportTechnique& technique = report.techniques[number];
    for (std::size_t i = 0; i < number && !technique.density_file.empty(); ++i) {
        if (report.techniques[i].density_file == technique.density_file) {
            page += "<p>" + std::string(kDensity) + " The picture is <a href=\"#" + sectionId(i) + "\">that of " +
                    escapeHtml(report.techniques[i].name) + "</a>.</p>\n";
            return;
        }
    }
    addFigure(page, technique.density_file, "Shadow texels per pixel of " + technique.name + " in false colour",
              kDensity);
}

// Truth and technique side by side, frame after frame.
void addFrames(std::string& page, const ReportTechnique& technique)
{
    for (const ReportFrame& frame : technique.frames) {
        page += "<h3>" + escapeHtml(frame.name) + "</h3>\n<div class=\"pictures\">\n";
        const std::string where = technique.name + ", " + frame.name;
        addFigure(page, frame.truth_file, "The ray-traced mask in grey, " + frame.name,
                  "The truth: white is lit, black is in shadow.");
        addFigure(page, frame.mask_file, "Mask of " + where + " in grey", "Mask: white is lit, black is in shadow.");
        addFigure(page, frame.error_file, "Signed error of " + where + " in false colour",
                  "Error: blue where the mask is darker than the truth, orange where it is brighter.");
        addFigure(page, frame.class_file, "Classes of the error of " + where + " in colour over the grey truth",
                  "Where the error comes from, over the truth.");
        page += "</div>\n";
    }
}

void addTechnique(std::string& page, const Report& report, std::size_t number)
{
    const ReportTechnique& technique = report.techniques[number];
    const std::string id = sectionId(number);
    page += "<section aria-labelledby=\"" + id + "\">\n<h2 id=\"" + id + "\">" + escapeHtml(technique.name) + "</h2>\n";
    if (!technique.frames.empty()) {
        addFrames(page, technique);
        page += "</section>\n";
        return;
    }
    page += "<div class=\"pictures\">\n";
    addFigure(page, report.truth_file, "The ray-traced mask in grey",
              "The truth again, to look from one to the other.");
    addFigure(page, technique.mask_file, "Mask of " + technique.name + " in grey",
              "Mask: white is lit, black is in shadow.");
    addFigure(page, technique.error_file, "Signed error of " + technique.name + " in false colour",
              "Error: blue where the mask is darker than the truth, orange where it is brighter.");
    addFigure(page, technique.class_file,
              "Classes of the error of " + technique.name + " in colour over the grey truth",
              "Where the error comes from, over the truth.");
    addDensity(page, report, number);
    page += "</div>\n</section>\n";
}

void addNotes(std::string& page, const Report& report)
{
    if (report.notes.empty())
        return;
    page += "<section aria-labelledby=\"notes\">\n<h2 id=\"notes\">Notes</h2>\n<ul>\n";
    for (const std::string& note : report.notes)
        page += "<li>" + escapeHtml(note) + "</li>\n";
    page += "</ul>\n</section>\n";
}

} // namespace

std::string reportPage(const Report& report)
{
    const std::string title = escapeHtml(report.title);
    std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
                       title + "</title>\n<style>";
    page += kStyle;
    page +=
        "</style>\n</head>\n<body>\n<header>\n<h1>" + title + "</h1>\n</header>\n<main>\n<div class=\"overview\">\n";
    addFacts(page, report);
    addTruth(page, report);
    page += "</div>\n";
    addPlots(page, report);
    addTable(page, report);
    addNotes(page, report);
    for (std::size_t i = 0; i < report.techniques.size(); ++i)
        addTechnique(page, report, i);
    page += "</main>\n</body>\n</html>\n";
    return page;
}

} // namespace gnomon::lab
