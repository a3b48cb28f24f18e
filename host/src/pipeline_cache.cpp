// SPDX-License-Identifier: Apache-2.0
#include "pipeline_cache.h"

#include "check.h"
#include "files/files.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>

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

std::string readPayload(const std::filesystem::path& file)
{
    constexpr std::uint64_t kMaxBytes = 256ULL << 20;
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

} // namespace

std::filesystem::path pipelineCacheFile(const VkPhysicalDeviceProperties& properties)
{
    std::filesystem::path folder;
    if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg == '/') {
        folder = xdg;
    } else if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
        folder = std::filesystem::path(home) / ".cache";
    } else {
        return {};
    }
    std::string name = "pipelines-";
    std::array<char, 16> text{};
    for (const std::uint8_t byte : properties.pipelineCacheUUID) {
        std::snprintf(text.data(), text.size(), "%02x", byte);
        name += text.data();
    }
    std::snprintf(text.data(), text.size(), "-%08x", properties.driverVersion);
    return folder / "gnomon" / (name + text.data() + ".bin");
}

VkPipelineCache loadPipelineCache(VkDevice device, const std::filesystem::path& file)
{
    const std::string bytes = file.empty() ? std::string() : readPayload(file);
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = bytes.size();
    info.pInitialData = bytes.empty() ? nullptr : bytes.data();
    VkPipelineCache cache = VK_NULL_HANDLE;
    check(vkCreatePipelineCache(device, &info, nullptr, &cache), "making a pipeline cache");
    return cache;
}

void storePipelineCache(VkDevice device, VkPipelineCache cache, const std::filesystem::path& file)
{
    std::size_t size = 0;
    if (file.empty() || vkGetPipelineCacheData(device, cache, &size, nullptr) != VK_SUCCESS || size == 0) {
        return;
    }
    try {
        std::string bytes(sizeof(FileHeader) + size, '\0');
        if (vkGetPipelineCacheData(device, cache, &size, bytes.data() + sizeof(FileHeader)) != VK_SUCCESS) {
            return;
        }
        bytes.resize(sizeof(FileHeader) + size);
        std::error_code error;
        if (std::filesystem::file_size(file, error) == bytes.size() && !error) {
            return; // the same pipelines as before, as far as the size tells
        }
        std::filesystem::create_directories(file.parent_path(), error);
        FileHeader header;
        header.size = size;
        header.checksum = checksumOf(std::string_view(bytes).substr(sizeof header));
        std::memcpy(bytes.data(), &header, sizeof header);
        writeFile(file, bytes);
    } catch (const std::exception&) { // no memory or no disk for them: they are compiled again next time
    }
}

} // namespace gnomon::host
