// SPDX-License-Identifier: Apache-2.0
// HTML that the pages of all reports share: one file that loads nothing from elsewhere.
#pragma once

#include "compare_table.h"
#include "result_json.h"

#include <string>
#include <string_view>

namespace gnomon::app {

/// Text as it stands in HTML and in attributes between double quotes.
[[nodiscard]] std::string escaped(std::string_view text);
/// A name and what it is, of a list <dl>.
[[nodiscard]] std::string definition(std::string_view name, std::string_view text);
/// A section with a heading. `heading` is text, `body` HTML; empty without a body.
[[nodiscard]] std::string section(std::string_view id, std::string_view heading, std::string_view body);
/// A list of the notes, or nothing.
[[nodiscard]] std::string notesHtml(const Json& result);

/// A table as pages/table.js sorts and filters it. Its first column names the rows.
struct TableHtml {
    std::string id;
    std::string caption;
    bool picks = false; // a row is chosen by a click, and the pictures are the chosen row's
};
[[nodiscard]] std::string tableHtml(const TextTable& table, const TableHtml& about);
/// The meanings of the columns, folded away.
[[nodiscard]] std::string meaningsHtml(const TextTable& table);

/// PNG as a data: URI.
[[nodiscard]] std::string dataUri(std::string_view png);

struct Page {
    std::string kind;  // the kind of page that pages/page.js makes: "compare", "sweep", "scenes" or "bench"
    std::string title; // and first heading
    std::string lead;  // one line below it
    std::string body;  // HTML: sections
    Json data;         // the data that the scripts read
    Json pictures;     // the pictures that the scripts show; null: nothing
};
/// The whole file, in UTF-8. The scripts, the style and the charts' library are in it.
[[nodiscard]] std::string pageHtml(const Page& page);
/// The tag before a page's pictures. The part of a page before it does not depend on them.
inline constexpr std::string_view kPicturesTag = "<script type=\"application/json\" id=\"pictures\">";

} // namespace gnomon::app
