// SPDX-License-Identifier: Apache-2.0
// Notes beside each case's result what tools/cases.py asks for: the processor time that it took, with that of its
// threads and processes, and whether it handed work to a driver. Linked into every test binary.
#include "case_costs.h"

#include <gtest/gtest.h>

#include <vulkan/vulkan.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <dlfcn.h>
#include <sys/resource.h>

namespace gnomon::test {
namespace {

std::atomic<bool> has_drawn = false;

double processorSeconds()
{
    double seconds = 0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        ::getrusage(who, &used);
        for (const timeval& time : {used.ru_utime, used.ru_stime}) {
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        }
    }
    return seconds;
}

class CaseCosts : public testing::EmptyTestEventListener {
    // A suite's preparation counts to its first case, and if it draws, all of its cases do.
    void OnTestSuiteStart(const testing::TestSuite& /*suite*/) override
    {
        begin();
        suite_draws_ = false;
    }
    void OnTestStart(const testing::TestInfo& /*test*/) override { suite_draws_ = suite_draws_ || has_drawn; }
    void OnTestEnd(const testing::TestInfo& /*test*/) override
    {
        std::array<char, 32> seconds{};
        std::snprintf(seconds.data(), seconds.size(), "%.2f", processorSeconds() - began_s_);
        testing::Test::RecordProperty("processor_s", seconds.data());
        if (has_drawn || suite_draws_) {
            testing::Test::RecordProperty("drew", "yes");
        }
        begin();
    }

    void begin()
    {
        began_s_ = processorSeconds();
        has_drawn = false;
    }

    double began_s_ = 0;
    bool suite_draws_ = false;
};

[[maybe_unused]] const bool is_listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new CaseCosts);
    return true;
}();

/// The loader's function of this name, which ours stands before.
template <typename Function>
Function* inLoader(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

void noteDrawing()
{
    has_drawn = true;
}

} // namespace gnomon::test

// An executable's functions stand before the loader's. Weak ones leave room for those of tests/faults.
[[gnu::weak]] VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit(VkQueue queue, std::uint32_t count,
                                                           const VkSubmitInfo* submits, VkFence fence)
{
    static auto* const next = gnomon::test::inLoader<decltype(vkQueueSubmit)>("vkQueueSubmit");
    gnomon::test::noteDrawing();
    return next(queue, count, submits, fence);
}

[[gnu::weak]] VKAPI_ATTR VkResult VKAPI_CALL vkQueueSubmit2(VkQueue queue, std::uint32_t count,
                                                            const VkSubmitInfo2* submits, VkFence fence)
{
    static auto* const next = gnomon::test::inLoader<decltype(vkQueueSubmit2)>("vkQueueSubmit2");
    gnomon::test::noteDrawing();
    return next(queue, count, submits, fence);
}
