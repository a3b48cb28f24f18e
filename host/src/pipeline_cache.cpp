// SPDX-License-Identifier: Apache-2.0
#include "pipeline_cache.h"

#include "check.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

namespace gnomon::host {
namespace {

// The driver checks its own header but not the rest, so a torn file could reach it; hence a checksum of our own.
struct FileHeader {
    std::array<char, 8> magic{'G', 'N', 'P', 'I', 'P', 'E', '0', '1'};
    std::uint64_t size = 0;
    std::uint64_t checksum = 0;
};

// FNV-1a (Fowler, Noll, Vo 1991).
std::uint64_t checksumOf(const std::vector<char>& bytes)
{
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char c : bytes) {
        hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x100000001b3ULL;
    }
    return hash;
}

std::vector<char> readPayload(const std::filesystem::path& file)
{
    constexpr std::uint64_t kMaxBytes = 256ULL << 20;
    std::ifstream in(file, std::ios::binary);
    FileHeader header;
    const FileHeader expected;
    if (!in.read(reinterpret_cast<char*>(&header), sizeof header) || header.magic != expected.magic ||
        header.size > kMaxBytes) {
        return {};
    }
    std::vector<char> bytes(std::istreambuf_iterator<char>(in), {});
    if (bytes.size() != header.size || checksumOf(bytes) != header.checksum) {
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
    const std::vector<char> bytes = file.empty() ? std::vector<char>{} : readPayload(file);
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
    std::vector<char> bytes(size);
    if (vkGetPipelineCacheData(device, cache, &size, bytes.data()) != VK_SUCCESS) {
        return;
    }
    bytes.resize(size);
    std::error_code error;
    if (std::filesystem::file_size(file, error) == size + sizeof(FileHeader) && !error) {
        return; // the same pipelines as before, as far as the size tells
    }
    std::filesystem::create_directories(file.parent_path(), error);
    std::filesystem::path temporary = file;
    temporary += "." + std::to_string(::getpid());
    FileHeader header;
    header.size = size;
    header.checksum = checksumOf(bytes);
    bool whole = false;
    {
        std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
        out.write(reinterpret_cast<const char*>(&header), sizeof header);
        out.write(bytes.data(), static_cast<std::streamsize>(size));
        out.close();
        whole = out.good();
    }
    if (whole) {
        std::filesystem::rename(temporary, file, error);
    }
    if (!whole || error) {
        std::filesystem::remove(temporary, error);
    }
}

} // namespace gnomon::host
