// SPDX-License-Identifier: Apache-2.0
#include "cache_file.h"

#include "files/files.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

namespace gnomon::host {
namespace {

// The driver checks its own header but not the rest, so a torn file could reach it; hence a checksum of our own.
struct FileHeader {
    std::array<char, 8> magic{'G', 'N', 'P', 'I', 'P', 'E', '0', '1'};
    std::uint64_t size = 0;
    std::uint64_t checksum = 0;
};

// FNV-1a (Fowler, Noll, Vo 1991).
std::uint64_t checksumOf(std::string_view bytes)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : bytes) {
        hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ULL;
    }
    return hash;
}

} // namespace

std::filesystem::path cacheFile(const VkPhysicalDeviceProperties& properties, std::string_view subject)
{
    std::filesystem::path folder;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg == '/') {
        folder = xdg;
    } else if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
        folder = std::filesystem::path(home) / ".cache";
    } else {
        return {};
    }
    std::string name = std::string(subject) + "-";
    std::array<char, 16> text{};
    for (const std::uint8_t byte : properties.pipelineCacheUUID) {
        std::snprintf(text.data(), text.size(), "%02x", byte);
        name += text.data();
    }
    std::snprintf(text.data(), text.size(), "-%08x", properties.driverVersion);
    return folder / "gnomon" / (name + text.data() + ".bin");
}

std::string readCached(const std::filesystem::path& file)
{
    constexpr std::uint64_t kMaxBytes = 256ULL << 20;
    if (file.empty()) {
        return {};
    }
    FileHeader header;
    const FileHeader expected;
    std::string bytes;
    try {
        bytes = readWholeFile(file, kMaxBytes);
    } catch (const std::exception&) { // none yet, or none that can be had: it is made anew
        return {};
    }
    if (bytes.size() < sizeof header) {
        return {};
    }
    std::memcpy(&header, bytes.data(), sizeof header);
    bytes.erase(0, sizeof header);
    if (header.magic != expected.magic || bytes.size() != header.size || checksumOf(bytes) != header.checksum) {
        return {};
    }
    return bytes;
}

void writeCached(const std::filesystem::path& file, std::string_view payload)
{
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    FileHeader header;
    header.size = payload.size();
    header.checksum = checksumOf(payload);
    std::string bytes(sizeof header, '\0');
    std::memcpy(bytes.data(), &header, sizeof header);
    writeFile(file, bytes.append(payload));
}

} // namespace gnomon::host
