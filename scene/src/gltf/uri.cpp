// SPDX-License-Identifier: Apache-2.0
#include "gltf/uri.h"

#include "files/files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>

namespace gnomon::scene::gltf {

namespace {

namespace fs = std::filesystem;

int hexDigit(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

std::optional<std::string> percentDecode(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            out += text[i];
            continue;
        }
        if (text.size() - i < 3 || hexDigit(text[i + 1]) < 0 || hexDigit(text[i + 2]) < 0) {
            return std::nullopt;
        }
        out += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
        i += 2;
    }
    return out;
}

int base64Digit(char c)
{
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::optional<std::vector<std::byte>> base64Decode(std::string_view text)
{
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        return std::nullopt;
    }
    std::vector<std::byte> out;
    out.reserve(text.size() / 4 * 3 + 2);
    unsigned bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const int digit = base64Digit(c);
        if (digit < 0) {
            return std::nullopt;
        }
        bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xFFFFFFU;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            out.push_back(static_cast<std::byte>(bits >> bit_count & 0xFFU));
        }
    }
    return out;
}

Resource decodeDataUri(const JsonView& uri, std::string_view text)
{
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) {
        uri.fail("a data URI needs a comma before its data");
    }
    const std::string_view body = text.substr(comma + 1);
    uri.context().checkFileBytes(body.size(), uri.pointer());
    uri.context().chargeBytes(body.size(), uri.pointer());
    std::string_view head = text.substr(5, comma - 5);
    constexpr std::string_view kBase64 = ";base64";
    Resource resource;
    if (head.ends_with(kBase64)) {
        head.remove_suffix(kBase64.size());
        std::optional<std::vector<std::byte>> bytes = base64Decode(body);
        if (!bytes) {
            uri.fail("the data URI holds invalid base64");
        }
        resource.bytes = std::move(*bytes);
    } else {
        const std::optional<std::string> bytes = percentDecode(body);
        if (!bytes) {
            uri.fail("the data URI holds invalid percent encoding");
        }
        resource.bytes.resize(bytes->size());
        std::transform(bytes->begin(), bytes->end(), resource.bytes.begin(),
                       [](char c) { return static_cast<std::byte>(c); });
    }
    resource.media_type = std::string(head.substr(0, head.find(';')));
    return resource;
}

/// The path that `text` names below the asset's folder; nothing where there is no such file.
std::optional<fs::path> resolve(const JsonView& uri, const std::string& text)
{
    const std::optional<std::string> decoded = percentDecode(text);
    if (!decoded || decoded->empty() || decoded->find('\0') != std::string::npos) {
        uri.fail("the URI is invalid");
    }
    if (text.substr(0, text.find('/')).find(':') != std::string::npos) {
        uri.fail("only data URIs and relative paths are supported", "put the file beside the scene");
    }
    const fs::path relative(*decoded);
    const bool climbs =
        std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; });
    if (relative.is_absolute() || climbs) {
        uri.fail("a URI must not lead out of the asset's folder", "put the file beside the scene");
    }
    if (uri.context().folder().empty()) {
        uri.fail("a scene read from memory cannot name other files", "pass its folder, or embed the data");
    }
    std::error_code error;
    const fs::path folder = fs::canonical(uri.context().folder(), error);
    const fs::path file = error ? fs::path() : fs::canonical(folder / relative, error);
    if (error == std::errc::no_such_file_or_directory) {
        return std::nullopt;
    }
    if (error) {
        uri.fail("the file cannot be found (" + error.message() + ")");
    }
    if (std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first != folder.end()) {
        uri.fail("a symbolic link leads out of the asset's folder", "put the file beside the scene");
    }
    return file;
}

} // namespace

std::vector<std::byte> readFile(Context& context, const fs::path& file, std::string_view where)
{
    std::string why;
    std::optional<PlainFile> plain = PlainFile::open(file, why);
    if (!plain) {
        context.fail(where, "the file cannot be opened: " + why);
    }
    context.checkFileBytes(plain->bytes(), where);
    context.noteFile(plain->bytes());
    context.chargeBytes(plain->bytes(), where);
    std::vector<std::byte> bytes(static_cast<std::size_t>(plain->bytes()));
    const std::optional<std::size_t> filled = plain->read(bytes.data(), bytes.size());
    if (!filled) {
        context.fail(where, "the file cannot be read", std::strerror(errno));
    }
    if (*filled != bytes.size()) {
        context.fail(where, "the file cannot be read to its end", "a file that shrank");
    }
    return bytes;
}

std::optional<Resource> fetchIfThere(const JsonView& uri)
{
    const auto* string = uri.value().get_ptr<const std::string*>(); // a data URI is too large to copy for nothing
    if (string == nullptr) {
        uri.fail("a string is needed");
    }
    const std::string& text = *string;
    if (text.starts_with("data:")) {
        return decodeDataUri(uri, text);
    }
    const std::optional<fs::path> file = resolve(uri, text);
    return file ? std::optional<Resource>({readFile(uri.context(), *file, uri.pointer()), {}}) : std::nullopt;
}

Resource fetch(const JsonView& uri)
{
    std::optional<Resource> resource = fetchIfThere(uri);
    if (!resource) {
        uri.fail("the file cannot be found (No such file or directory)");
    }
    return std::move(*resource);
}

} // namespace gnomon::scene::gltf
