// SPDX-License-Identifier: Apache-2.0
#include "files/files.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

std::string whyNotPlain(mode_t mode)
{
    return S_ISDIR(mode)    ? "it is a directory"
           : S_ISFIFO(mode) ? "it is a pipe; a plain file is needed"
           : S_ISSOCK(mode) ? "it is a socket; a plain file is needed"
                            : "it is a device; a plain file is needed";
}

char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

} // namespace

std::optional<PlainFile> PlainFile::open(const std::filesystem::path& file, std::string& why)
{
    // Looked at before it is opened, for that alone can do something to a device; and after, for another may lie there.
    struct stat info {};
    if (file.empty()) {
        why = "its name is empty";
        return std::nullopt;
    }
    if (::stat(file.c_str(), &info) != 0) {
        why = std::generic_category().message(errno);
        return std::nullopt;
    }
    if (!S_ISREG(info.st_mode)) {
        why = whyNotPlain(info.st_mode);
        return std::nullopt;
    }
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor < 0 || ::fstat(descriptor, &info) != 0) {
        why = std::generic_category().message(errno);
    } else if (!S_ISREG(info.st_mode)) {
        why = whyNotPlain(info.st_mode);
    } else {
        return PlainFile(descriptor, static_cast<std::uint64_t>(info.st_size));
    }
    if (descriptor >= 0) {
        ::close(descriptor);
    }
    return std::nullopt;
}

PlainFile::PlainFile(PlainFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), bytes_(other.bytes_)
{
}

PlainFile::~PlainFile()
{
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
}

std::optional<std::size_t> PlainFile::read(void* to, std::size_t count)
{
    std::size_t filled = 0;
    while (filled < count) {
        const ssize_t got = ::read(descriptor_, static_cast<char*>(to) + filled, count - filled);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return std::nullopt;
        }
        if (got == 0) {
            break;
        }
        filled += static_cast<std::size_t>(got);
    }
    return filled;
}

std::string readWholeFile(const std::filesystem::path& file, std::uint64_t max_bytes, std::string_view what)
{
    const std::string tried = "reading " + std::string(what) + (what.empty() ? "" : " ") + file.string();
    std::string why;
    std::optional<PlainFile> plain = PlainFile::open(file, why);
    if (!plain) {
        throw Error(tried, why);
    }
    if (plain->bytes() > max_bytes) {
        throw Error(tried, "it has " + std::to_string(plain->bytes()) + " bytes, more than the limit of " +
                               std::to_string(max_bytes));
    }
    std::string bytes(static_cast<std::size_t>(plain->bytes()), '\0');
    const std::optional<std::size_t> filled = plain->read(bytes.data(), bytes.size());
    if (!filled) {
        throw Error(tried, std::generic_category().message(errno));
    }
    bytes.resize(*filled);
    return bytes;
}

bool hasExtension(const std::filesystem::path& file, std::string_view extension)
{
    const std::string has = file.extension().string();
    return std::equal(has.begin(), has.end(), extension.begin(), extension.end(),
                      [](char a, char b) { return lower(a) == lower(b); });
}

} // namespace gnomon
