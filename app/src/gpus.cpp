// SPDX-License-Identifier: Apache-2.0
// `gnomon gpus`: the devices of this machine, what each can, and what is left out on it and why.
#include "result_json.h"
#include "streams.h"
#include "subcommands.h"

#include "files/files.h"
#include "host/gpu.h"

#include <fmt/format.h>

namespace gnomon::app {
namespace {

std::string versionText(std::uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

Json partJson(const host::GpuPart& part)
{
    return {{"name", part.name}, {"there", part.there}, {"serves", part.serves}, {"without", part.without}};
}

Json gpuJson(const host::GpuReport& gpu)
{
    Json json{{"name", gpu.name},
              {"driver", gpu.driver},
              {"vulkan", versionText(gpu.api_version)},
              {"software", gpu.software},
              {"sub_pixel_bits", gpu.sub_pixel_bits},
              {"refusal", gpu.refusal.empty() ? Json(nullptr) : Json(gpu.refusal)},
              {"taken", gpu.taken}};
    json["parts"] = Json::array();
    for (const host::GpuPart& part : gpu.parts) {
        json["parts"].push_back(partJson(part));
    }
    return json;
}

std::string gpuText(const host::GpuReport& gpu)
{
    std::string text =
        fmt::format("{}{}\n  driver   {}\n  Vulkan   {}{}\n  places   vertices by 1/2^{} of a pixel\n", gpu.name,
                    gpu.taken ? " (taken)" : "", gpu.driver.empty() ? "unknown" : gpu.driver,
                    versionText(gpu.api_version), gpu.software ? ", drawn by the processor" : "", gpu.sub_pixel_bits);
    if (!gpu.refusal.empty()) {
        text += fmt::format("  refused  {}\n", gpu.refusal);
    }
    std::string has;
    std::string lacks;
    for (const host::GpuPart& part : gpu.parts) {
        if (part.there) {
            has += fmt::format("    {}: {}\n", part.name, part.serves);
        } else {
            lacks += fmt::format("    {}, for {}: {}\n", part.name, part.serves, part.without);
        }
    }
    return text + (has.empty() ? "" : "  it has\n" + has) + (lacks.empty() ? "" : "  it lacks\n" + lacks);
}

} // namespace

int runGpus(const Settings& settings)
{
    if (!settings.json.empty() && settings.json != "-") {
        requireWritable(settings.json);
    }
    const std::vector<host::GpuReport> gpus = host::reportGpus({});
    if (!settings.json.empty()) {
        Json json{{"gpus", Json::array()}};
        for (const host::GpuReport& gpu : gpus) {
            json["gpus"].push_back(gpuJson(gpu));
        }
        writeResult(settings.json, jsonText(json));
        return 0;
    }
    std::string text;
    for (const host::GpuReport& gpu : gpus) {
        text += (text.empty() ? "" : "\n") + gpuText(gpu);
    }
    writeStdout(text);
    return 0;
}

} // namespace gnomon::app
