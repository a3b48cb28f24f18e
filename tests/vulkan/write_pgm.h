// SPDX-License-Identifier: Apache-2.0
// Pictures for people: written where the environment variable GNOMON_TEST_IMAGES says, else not at all.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string>

namespace gnomon::test {

inline void writePgm(const std::string& name, std::span<const std::byte> grey, VkExtent2D extent)
{
    if (const char* folder = std::getenv("GNOMON_TEST_IMAGES")) {
        std::ofstream out(std::string(folder) + "/" + name + ".pgm", std::ios::binary);
        out << "P5\n" << extent.width << ' ' << extent.height << "\n255\n";
        out.write(reinterpret_cast<const char*>(grey.data()), static_cast<std::streamsize>(grey.size()));
    }
}

} // namespace gnomon::test
