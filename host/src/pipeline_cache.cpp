// SPDX-License-Identifier: Apache-2.0
#include "pipeline_cache.h"

#include "cache_file.h"
#include "check.h"

#include <exception>
#include <string>

namespace gnomon::host {

VkPipelineCache loadPipelineCache(VkDevice device, const std::filesystem::path& file)
{
    const std::string bytes = readCached(file);
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
        std::string bytes(size, '\0');
        if (vkGetPipelineCacheData(device, cache, &size, bytes.data()) != VK_SUCCESS) {
            return;
        }
        bytes.resize(size);
        if (readCached(file).size() != size) { // else the same pipelines as before, as far as the size tells
            writeCached(file, bytes);
        }
    } catch (const std::exception&) { // no memory or no disk for them: they are compiled again next time
    }
}

} // namespace gnomon::host
