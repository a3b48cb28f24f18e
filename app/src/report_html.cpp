// SPDX-License-Identifier: Apache-2.0
#include "report_html.h"

#include "page_texts.h"
#include "wrap_text.h"

#include <fmt/format.h>

#include <cstdint>

namespace gnomon::app {
namespace {

/// Nothing may be loaded, from anywhere: pictures are in the page, and so is what runs.
constexpr std::string_view kPolicy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'; "
                                     "script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// JSON that ends no script, whatever its texts are: of what HTML knows in a script, all begins with <.
std::string scriptJson(const Json& json)
{
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        if (c == '<') {
            out += "\\u003c";
        } else {
            out += c;
        }
    }
    return out;
}

std::string cellHtml(const TextTable& table, std::size_t row, std::size_t column)
{
    return fmt::format("<td role=\"cell\" data-label=\"{}\">{}</td>", escaped(table.columns[column]),
                       escaped(table.rows[row][column]));
}

} // namespace

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

std::string definition(std::string_view name, std::string_view text)
{
    return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(text));
}

std::string section(std::string_view id, std::string_view heading, std::string_view body)
{
    return body.empty()
               ? std::string()
               : fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}</h2>\n"
                             "{2}</section>\n",
                             id, escaped(heading), body);
}

std::string notesHtml(const Json& result)
{
    std::string items;
    for (const Json& note : result.at("notes")) {
        items += fmt::format("<li>{}</li>\n", escaped(textAt(note, "")));
    }
    return items.empty() ? items : "<ul class=\"notes\">\n" + items + "</ul>\n";
}

/// The roles are said, for a table that is laid out as cards on a small screen is none to a reader of screens.
std::string tableHtml(const TextTable& table, const TableHtml& about)
{
    std::string head;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        const std::string meaning = column < table.meanings.size() ? table.meanings[column] : std::string();
        const std::string title = meaning.empty() ? "" : fmt::format(" title=\"{}\"", escaped(meaning));
        head += fmt::format("<th role=\"columnheader\" scope=\"col\"{}>{}</th>", title, escaped(table.columns[column]));
    }
    std::string body;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        body += fmt::format("<tr role=\"row\" data-row=\"{}\"><th role=\"rowheader\" scope=\"row\">{}</th>", row,
                            escaped(table.rows[row].front()));
        for (std::size_t column = 1; column < table.columns.size(); ++column) {
            body += cellHtml(table, row, column);
        }
        body += "</tr>\n";
    }
    return fmt::format("<div class=\"table-frame\">\n<table role=\"table\" id=\"{}\"{}>\n<caption>{}</caption>\n"
                       "<thead role=\"rowgroup\">\n<tr role=\"row\">{}</tr>\n</thead>\n<tbody role=\"rowgroup\">\n{}"
                       "</tbody>\n</table>\n</div>\n",
                       about.id, about.picks ? " data-picks=\"yes\"" : "", escaped(about.caption), head, body);
}

std::string meaningsHtml(const TextTable& table)
{
    std::string list;
    for (std::size_t column = 0; column < table.meanings.size(); ++column) {
        list += table.meanings[column].empty() ? "" : definition(table.columns[column], table.meanings[column]);
    }
    return list.empty() ? list
                        : fmt::format("<details class=\"meanings\">\n<summary>What the columns mean</summary>\n<dl>\n"
                                      "{}</dl>\n</details>\n",
                                      list);
}

std::string dataUri(std::string_view png)
{
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string uri = "data:image/png;base64,";
    uri.reserve(uri.size() + (png.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < png.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8U | (i + k < png.size() ? static_cast<unsigned char>(png[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            uri += i + k > png.size() ? '=' : kDigits[bits >> (18U - 6U * k) & 63U];
        }
    }
    return uri;
}

std::string pageHtml(const Page& page)
{
    const std::string title = escaped(page.title);
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                    "<meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n"
                    "<title>{}</title>\n<style>\n{}</style>\n</head>\n",
                    kPolicy, title, joined(kPageStyle, ""));
    html += fmt::format("<body data-kind=\"{}\">\n<header class=\"masthead\">\n<p class=\"brand\">Gnomon</p>\n"
                        "<h1>{}</h1>\n<p class=\"lead\">{}</p>\n</header>\n<main>\n"
                        "<noscript><p>The pictures and charts of this page need JavaScript; its numbers do not.</p>"
                        "</noscript>\n{}</main>\n",
                        page.kind, title, escaped(page.lead), page.body);
    html += "<script type=\"application/json\" id=\"data\">" + scriptJson(page.data) + "</script>\n";
    html += std::string(kPicturesTag) + scriptJson(page.pictures) + "</script>\n";
    html += "<script>\n" + joined(kChartLicence, "") + joined(kChartLibrary, "") + "</script>\n";
    return html + "<script>\n" + joined(kPageScript, "") + "</script>\n</body>\n</html>\n";
}

} // namespace gnomon::app
