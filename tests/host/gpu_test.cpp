// SPDX-License-Identifier: Apache-2.0
// The device: picked by name, refused with reasons; the pipeline cache on disk.
#include "host/gpu.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace gnomon::host {
namespace {

TEST(Gpu, PicksTheSoftwareRasteriserByName)
{
    const Gpu gpu({.gpu = "software"});
    EXPECT_TRUE(gpu.software());
    EXPECT_FALSE(gpu.driver().empty());
    EXPECT_NE(gpu.pipelineCache(), VK_NULL_HANDLE);
}

TEST(Gpu, ListsEveryDeviceThatItRefuses)
{
    try {
        const Gpu gpu({.gpu = "no such device"});
        FAIL() << "a device that is not there was found";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("no such device"), std::string::npos) << text;
        EXPECT_NE(text.find("llvmpipe"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST(Gpu, IgnoresATornPipelineCacheAndWritesAWholeOne)
{
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / ("gnomon-host-test-" + std::to_string(::getpid()));
    const char* old = std::getenv("XDG_CACHE_HOME");
    const std::string before = old != nullptr ? old : "";
    ::setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    {
        const Gpu gpu({.gpu = "software"});
    }
    std::size_t files = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "gnomon")) {
        ++files;
        EXPECT_GT(entry.file_size(), 24U);
        fs::resize_file(entry.path(), entry.file_size() / 2);
    }
    EXPECT_EQ(files, 1U);
    {
        const Gpu gpu({.gpu = "software", .validate = true});
        EXPECT_TRUE(gpu.messages().empty());
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / "gnomon")) {
        std::ofstream(entry.path(), std::ios::binary | std::ios::trunc)
            << "not a pipeline cache at all, but long enough";
    }
    EXPECT_NO_THROW(Gpu({.gpu = "software"}));
    fs::remove_all(folder);
    // A folder that cannot be made is no reason to fail.
    ::setenv("XDG_CACHE_HOME", "/dev/null", 1);
    EXPECT_NO_THROW(Gpu({.gpu = "software"}));
    if (before.empty()) {
        ::unsetenv("XDG_CACHE_HOME");
    } else {
        ::setenv("XDG_CACHE_HOME", before.c_str(), 1);
    }
}

} // namespace
} // namespace gnomon::host
