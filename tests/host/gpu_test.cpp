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

namespace fs = std::filesystem;

/// A folder for what is kept between runs, instead of the user's.
class CacheFolder {
public:
    CacheFolder()
    {
        const char* old = std::getenv("XDG_CACHE_HOME");
        before_ = old != nullptr ? old : "";
        use(path_);
    }
    ~CacheFolder()
    {
        fs::remove_all(path_);
        if (before_.empty()) {
            ::unsetenv("XDG_CACHE_HOME");
        } else {
            use(before_);
        }
    }
    CacheFolder(const CacheFolder&) = delete;
    CacheFolder& operator=(const CacheFolder&) = delete;

    static void use(const fs::path& path) { ::setenv("XDG_CACHE_HOME", path.c_str(), 1); }
    [[nodiscard]] fs::directory_iterator files() const { return fs::directory_iterator(path_ / "gnomon"); }

private:
    fs::path path_ = fs::temp_directory_path() / ("gnomon-host-test-" + std::to_string(::getpid()));
    std::string before_;
};

TEST(Gpu, KeepsMeasuredRatesAndIgnoresATornFileOfThem)
{
    const CacheFolder folder;
    DeviceRates rates = ratesOf(RateSource::gpu);
    rates.texel_ns = 0.125;
    fs::path file;
    {
        const Gpu gpu({.gpu = "software"});
        EXPECT_EQ(gpu.rates(), ratesOf(RateSource::software)) << "none were kept";
        file = gpu.keepRates(rates);
    }
    rates.source = RateSource::measured;
    EXPECT_EQ(Gpu({.gpu = "software"}).rates(), rates);
    EXPECT_EQ(Gpu({.gpu = "software", .rates = ratesOf(RateSource::gpu)}).rates(), ratesOf(RateSource::gpu));
    rates.ray_ns = -1.0;
    EXPECT_EQ(Gpu({.gpu = "software"}).keepRates(rates), file);
    EXPECT_EQ(Gpu({.gpu = "software"}).rates(), ratesOf(RateSource::software)) << "no time is below 0";
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_EQ(Gpu({.gpu = "software"}).rates(), ratesOf(RateSource::software));
    CacheFolder::use("/dev/null");
    EXPECT_THROW((void)Gpu({.gpu = "software"}).keepRates(rates), Error);
}

TEST(Gpu, IgnoresATornPipelineCacheAndWritesAWholeOne)
{
    const CacheFolder folder;
    {
        const Gpu gpu({.gpu = "software"});
    }
    std::size_t files = 0;
    for (const fs::directory_entry& entry : folder.files()) {
        ++files;
        EXPECT_GT(entry.file_size(), 24U);
        fs::resize_file(entry.path(), entry.file_size() / 2);
    }
    EXPECT_EQ(files, 1U);
    {
        const Gpu gpu({.gpu = "software", .validate = true});
        EXPECT_TRUE(gpu.messages().empty());
    }
    for (const fs::directory_entry& entry : folder.files()) {
        std::ofstream(entry.path(), std::ios::binary | std::ios::trunc)
            << "not a pipeline cache at all, but long enough";
    }
    EXPECT_NO_THROW(Gpu({.gpu = "software"}));
    // A folder that cannot be made is no reason to fail.
    CacheFolder::use("/dev/null");
    EXPECT_NO_THROW(Gpu({.gpu = "software"}));
}

} // namespace
} // namespace gnomon::host
