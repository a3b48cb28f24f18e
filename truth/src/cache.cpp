// SPDX-License-Identifier: Apache-2.0
#include "truth/cache.h"

#include "cache_entry.h"
#include "files/files.h"
#include "files/temporary.h"

#include <gnomon/error.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <dirent.h>
#include <exception>
#include <fcntl.h>
#include <memory>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>
#include <vector>

namespace gnomon::truth {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".truth";
constexpr std::size_t kKeyDigits = 32;
/// No store takes this long: the process that wrote the file was killed, and nobody has stored or read that entry
/// again.
constexpr std::chrono::hours kTemporaryLifetime{1};

bool isEntryName(std::string_view name)
{
    return name.size() == kKeyDigits + kSuffix.size() && name.ends_with(kSuffix) &&
           name.find_first_not_of("0123456789abcdef") == kKeyDigits;
}

/// Is it the name that writeFile() gives an entry while it writes: ".ENTRY.N.tmp"?
bool isTemporaryName(std::string_view name)
{
    constexpr std::size_t kEntryLength = kKeyDigits + kSuffix.size();
    return name.size() > kEntryLength + 1 && name.front() == '.' && isEntryName(name.substr(1, kEntryLength)) &&
           name[kEntryLength + 1] == '.' && name.ends_with(".tmp");
}

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor()
    {
        if (number_ >= 0) {
            ::close(number_);
        }
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

/// The result of reading. `failed` is the disk's or the system's fault, not the file's.
enum class Read : std::uint8_t { whole, ended_early, failed };

Read readExactly(int descriptor, char* to, std::size_t count)
{
    while (count > 0) {
        const ssize_t got = ::read(descriptor, to, count);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got <= 0) {
            return got < 0 ? Read::failed : Read::ended_early;
        }
        to += got;
        count -= static_cast<std::size_t>(got);
    }
    return Read::whole;
}

/// An entry, or nothing; and whether what lies there is bad for certain.
struct Loaded {
    std::optional<Traced> traced;
    bool bad = false;
};

Loaded readEntry(const fs::path& file, const EntryOf& asked, std::uint64_t max_bytes)
{
    // Without O_NONBLOCK a pipe of that name would be waited for.
    const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat info {};
    if (descriptor.number() < 0 || ::fstat(descriptor.number(), &info) != 0 || !S_ISREG(info.st_mode)) {
        return {};
    }
    const auto file_bytes = static_cast<std::uint64_t>(info.st_size);
    std::array<char, kEntryHeaderBytes> head{};
    if (file_bytes < head.size() || file_bytes > max_bytes) {
        return {std::nullopt, true};
    }
    const auto refusal = [](Read read) {
        return Loaded{std::nullopt, read == Read::ended_early};
    };
    if (const Read read = readExactly(descriptor.number(), head.data(), head.size()); read != Read::whole) {
        return refusal(read);
    }
    const std::optional<EntryHeader> header = parseHeader({head.data(), head.size()}, file_bytes, asked);
    if (!header) {
        return {std::nullopt, true};
    }
    std::string payload(header->payload_bytes, '\0');
    if (const Read read = readExactly(descriptor.number(), payload.data(), payload.size()); read != Read::whole) {
        return refusal(read);
    }
    std::optional<Traced> traced = decodePayload(*header, payload);
    if (traced) {
        ::futimens(descriptor.number(), nullptr); // used just now; where rights are missing it ages, no more
    }
    const bool bad = !traced;
    return {std::move(traced), bad};
}

struct CloseFolder {
    void operator()(DIR* folder) const { ::closedir(folder); }
};

struct Entry {
    fs::file_time_type used;
    fs::path file;
    std::uint64_t bytes = 0;
};

/// Removes what killed processes left, and the least recently used entries but `kept` until the rest fits. Other
/// processes may do the same at the same time, so whatever fails is passed over.
void tidy(const fs::path& folder, std::uint64_t max_bytes, const fs::path& kept)
{
    std::vector<Entry> entries;
    std::uint64_t total = 0;
    const auto now = fs::file_time_type::clock::now();
    // The standard library's iterator ends the program when memory runs out (GCC 12).
    const std::unique_ptr<DIR, CloseFolder> open(::opendir(folder.c_str()));
    while (const dirent* const found = open ? ::readdir(open.get()) : nullptr) {
        const std::string_view name = found->d_name;
        if (!isEntryName(name) && !isTemporaryName(name)) {
            continue;
        }
        const fs::path file = folder / name;
        std::error_code gone;
        if (!fs::is_regular_file(fs::symlink_status(file, gone))) {
            continue;
        }
        const fs::file_time_type used = fs::last_write_time(file, gone);
        const std::uint64_t bytes = gone ? 0 : fs::file_size(file, gone);
        if (gone) {
            continue;
        }
        if (isEntryName(name)) {
            total += bytes;
            entries.push_back({used, file, bytes});
        } else if (now - used > kTemporaryLifetime) {
            fs::remove(file, gone);
        }
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return std::tie(a.used, a.file) < std::tie(b.used, b.file); });
    for (const Entry& entry : entries) {
        if (total <= max_bytes) {
            break;
        }
        if (entry.file != kept) {
            std::error_code ignored;
            fs::remove(entry.file, ignored);
            total -= entry.bytes;
        }
    }
}

/// An empty string when it worked, else why not.
std::string writeEntry(const fs::path& folder, const fs::path& file, const scene::Hash128& key, const Traced& traced,
                       std::uint64_t max_bytes)
{
    const std::optional<std::string> bytes = encodeEntry(key, traced);
    if (!bytes) {
        return "writing " + file.string() + ": its images are not of one size from 1 to " +
               std::to_string(kMaxCachedSide) + " pixels a side, or have values that no truth has";
    }
    if (bytes->size() > max_bytes) {
        return "writing " + file.string() + ": its " + std::to_string(bytes->size()) +
               " bytes are more than the whole cache may take (" + std::to_string(max_bytes) + ")";
    }
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return "making the folder " + folder.string() + ": " + error.message();
    }
    // writeFile() writes into a pipe or a device of that name, which could take for ever.
    const fs::file_status status = fs::symlink_status(file, error);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        return "writing " + file.string() + ": something that is not a plain file has its name; remove it";
    }
    try {
        writeFile(file, *bytes);
    } catch (const Error& why) {
        return why.what();
    }
    return {};
}

fs::path fileOf(const fs::path& folder, const scene::Hash128& key)
{
    return folder / (scene::toString(key) + std::string(kSuffix));
}

} // namespace

std::optional<fs::path> Cache::defaultFolder()
{
    for (const auto& [variable, below] : {std::pair("XDG_CACHE_HOME", ""), std::pair("HOME", ".cache")}) {
        const char* value = std::getenv(variable);
        if (value != nullptr && fs::path(value).is_absolute()) {
            return fs::path(value) / below / "gnomon" / "truth";
        }
    }
    return std::nullopt;
}

Cache::Cache(fs::path folder, std::uint64_t max_bytes) : folder_(std::move(folder)), max_bytes_(max_bytes) {}

std::optional<Traced> Cache::load(const scene::Hash128& key, const glm::uvec2& size_px, Kind kind) const
{
    try {
        const fs::path file = fileOf(folder_, key);
        Loaded loaded = readEntry(file, {key, size_px, kind}, max_bytes_);
        if (loaded.bad) {
            std::error_code ignored;
            fs::remove(file, ignored);
        } else if (loaded.traced) {
            removeLeftBehind(file, Temporary::Kind::file);
        }
        return std::move(loaded.traced);
    } catch (const std::exception&) {
        // No memory for it. The truth can still be traced.
        return std::nullopt;
    }
}

bool Cache::store(const scene::Hash128& key, const Traced& traced, std::string* why) const
{
    std::string reason;
    bool written = false;
    try {
        const fs::path file = fileOf(folder_, key);
        reason = writeEntry(folder_, file, key, traced, max_bytes_);
        written = reason.empty();
        tidy(folder_, max_bytes_, file);
    } catch (const std::exception&) {
        // No memory for it. An entry that is written stays; the next one's store tidies up.
        reason = written ? "" : "out of memory"; // so short that it takes none
    }
    if (why != nullptr) {
        *why = std::move(reason);
    }
    return written;
}

} // namespace gnomon::truth
