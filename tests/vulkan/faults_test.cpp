// SPDX-License-Identifier: Apache-2.0
// Every call of Vulkan that may fail fails once, and every allocation: what comes out is a typed error, nothing is left
// behind, nothing is freed that a frame in flight may use, and planner and renderer go on as new ones would.
#include "allocation_count.h"
#include "changing_host.h"
#include "option_steps.h"
#include "sweep.h"

#include <gnomon/error.h>
#include <gnomon/vulkan/profiler.h>

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <new>
#include <optional>
#include <tuple>

namespace gnomon::test {
namespace {

/// The counts of a frame's commands that tell whether all of its maps were drawn.
struct Drawn {
    std::uint64_t passes = 0;
    std::uint64_t draws = 0;
    std::uint64_t dispatches = 0;
    std::uint64_t indirect_draws = 0;
    std::uint64_t instances = 0;

    friend bool operator==(const Drawn&, const Drawn&) = default;
};

std::ostream& operator<<(std::ostream& out, const Drawn& d)
{
    return out << d.passes << " passes, " << d.draws << " draws, " << d.dispatches << " dispatches, "
               << d.indirect_draws << " indirect draws of " << d.instances << " instances";
}

/// The same frames each time, from the making of renderer, drawer, profiler and planner on.
class Walk {
public:
    explicit Walk(const ShadowOptions& options) : options_(options) {}
    ~Walk()
    {
        if (driver_ != nullptr) {
            driver_->finishAll(); // a host waits before it destroys
        }
    }
    Walk(const Walk&) = delete;
    Walk& operator=(const Walk&) = delete;

    static constexpr std::uint32_t kFrames = 4;

    /// Makes all objects on a device, and draws frames. After an exception half way frame() can go on.
    void run(NullDriver& driver)
    {
        driver_ = &driver;
        host_.emplace(driver, vulkan::ShadowRendererOptions{.mask_shape = vulkan::MaskShape{.normals = true}});
        profiler_.emplace(driver.view(), 2, 8);
        planner_.emplace(options_);
        host_->renderer.warmUp(resolvedOrThrow(options_), {.inputs = {.normals = true}});
        host_->drawer.warmUp(resolvedOrThrow(options_), true);
        for (std::uint32_t i = 0; i < kFrames; ++i) {
            frame();
        }
    }
    /// The next frame, with more lights and another screen in each.
    void frame()
    {
        const std::uint32_t slot = host_->frameIndex() % 2;
        profiler_->beginFrame(driver_->commands(), slot);
        profiler_->beginPass(driver_->commands(), "all");
        profiler_->endPass(driver_->commands());
        (void)profiler_->results(slot);
        (void)host_->frame(*planner_, setupOf(host_->frameIndex()));
    }
    /// Is there all that frame() needs?
    [[nodiscard]] bool made() const { return planner_.has_value(); }
    [[nodiscard]] std::uint32_t frameIndex() const { return host_->frameIndex(); }
    [[nodiscard]] Drawn drawnInFrame()
    {
        // A pass that something was thrown out of is not ended.
        profiler_.emplace(driver_->view(), 2, 8);
        driver_->clearEvents();
        const NullCounts before = driver_->counts();
        frame();
        const NullCounts& after = driver_->counts();
        Drawn drawn;
        for (const NullEvent& event : driver_->events()) {
            drawn.passes += event.kind == NullEvent::Kind::begin_rendering ? 1 : 0;
        }
        drawn.draws = after.draws - before.draws;
        drawn.dispatches = after.dispatches - before.dispatches;
        drawn.indirect_draws = after.indirect_draws - before.indirect_draws;
        drawn.instances = after.instances - before.instances;
        return drawn;
    }
    /// Where it ended, if within a frame.
    [[nodiscard]] ChangingHost::At at() const { return host_->at; }
    /// The draws of the frame of this index when the last one ended at `at`. A renderer that threw acts as a new one, a
    /// planner as if that frame had not been; its maps may be forgotten.
    [[nodiscard]] static Drawn drawnAfter(const ShadowOptions& options, std::uint32_t index, ChangingHost::At at,
                                          bool forgotten)
    {
        using At = ChangingHost::At;
        // How far that frame had come, by the step that threw.
        constexpr std::array kUntil{At::record, At::nothing, At::plan, At::prepare, At::plan};
        NullDriver driver;
        Walk walk(options);
        walk.driver_ = &driver;
        walk.host_.emplace(driver, vulkan::ShadowRendererOptions{.mask_shape = vulkan::MaskShape{.normals = true}});
        walk.profiler_.emplace(driver.view(), 2, 8);
        walk.planner_.emplace(options);
        while (walk.frameIndex() < index) {
            const bool last = walk.frameIndex() + 1 == index;
            const bool renderer_goes_on = at == At::drawer || (at == At::plan && !forgotten);
            if (at == At::nothing || (renderer_goes_on && !last)) {
                walk.frame();
            } else {
                const At until = !last ? At::plan : kUntil.at(static_cast<std::size_t>(at));
                walk.host_->skipFrame(setupOf(walk.frameIndex()), *walk.planner_, until);
            }
        }
        if (forgotten) {
            walk.planner_->reset();
        }
        return walk.drawnInFrame();
    }

private:
    static FrameSetup setupOf(std::uint32_t index)
    {
        FrameSetup setup;
        setup.lights = 1 + index * 2 % 7;
        setup.screen = {64 + 16 * (index % 3), 40};
        setup.inputs.normals = true;
        setup.inputs.ids = index % 4 == 3; // pipelines that nobody could know of are made while recording
        return setup;
    }

    ShadowOptions options_{.technique = kPlainTechnique};
    NullDriver* driver_ = nullptr;
    std::optional<ChangingHost> host_;
    std::optional<vulkan::Profiler> profiler_;
    std::optional<Planner> planner_;
};

void expectNothingLeft(const NullDriver& driver)
{
    const NullCounts& counts = driver.counts();
    EXPECT_EQ(counts.created, counts.destroyed);
    EXPECT_EQ(counts.allocations, counts.frees);
    EXPECT_EQ(counts.bytes, 0U);
    EXPECT_EQ(counts.freed_in_use, 0U);
    EXPECT_EQ(counts.written_in_use, 0U);
    EXPECT_EQ(counts.used_after_free, 0U);
}

/// The result of a walk in which something failed.
struct End {
    bool error = false;
    ErrorKind kind = ErrorKind::other;
    bool bad_alloc = false;
};

End endOf(const std::function<void()>& work)
{
    try {
        work();
    } catch (const Error& error) {
        return {.error = true, .kind = error.kind()};
    } catch (const std::bad_alloc&) {
        return {.bad_alloc = true};
    }
    return {};
}

constexpr std::array kMoreBases{
    "filter=pcf partition=cascades cascades.pass=layered map-size=64",
    "filter=hard partition=sdsm cascades.pass=layered map-size=64",
    "filter=vsm blur.path=fragment map-size=64",
    "filter=hard partition=cascades fit=lispsm map-format=r32f keep-still=always map-size=64",
};

std::vector<const char*> allBases()
{
    std::vector<const char*> bases(kBases.begin(), kBases.end());
    bases.insert(bases.end(), kMoreBases.begin(), kMoreBases.end());
    return bases;
}

class Faults : public testing::TestWithParam<const char*> {
protected:
    /// Once nothing fails any more, what threw in a walk goes on as if it were new, and the rest as it was.
    void expectGoesOn(Walk& walk)
    {
        if (!walk.made()) {
            return;
        }
        const std::uint32_t index = walk.frameIndex();
        const ChangingHost::At at = walk.at();
        const Drawn drawn = walk.drawnInFrame();
        if (at != ChangingHost::At::plan || drawn != drawnAfter(index, at, true)) {
            EXPECT_EQ(drawn, drawnAfter(index, at, false)) << "frame " << index << " after " << static_cast<int>(at);
        }
    }
    [[nodiscard]] const Drawn& drawnAfter(std::uint32_t index, ChangingHost::At at, bool forgotten)
    {
        const std::tuple key(index, at, forgotten);
        const auto found = known_.find(key);
        return found != known_.end()
                   ? found->second
                   : known_.emplace(key, Walk::drawnAfter(options_, index, at, forgotten)).first->second;
    }
    [[nodiscard]] std::string name(const char* what) const { return nameOfBase(GetParam()) + ", " + what; }

    ShadowOptions options_ = optionsFrom(GetParam());
    std::map<std::tuple<std::uint32_t, ChangingHost::At, bool>, Drawn> known_;
};

TEST_P(Faults, ofVulkanCallsAreTypedAndLeaveNothing)
{
    std::uint64_t calls = 0;
    {
        NullDriver driver;
        {
            Walk walk(options_);
            walk.run(driver);
        }
        calls = driver.fallibleCalls();
        expectNothingLeft(driver);
    }
    ASSERT_GT(calls, 100U);
    for (const auto& [result, kind] : {std::pair{VK_ERROR_OUT_OF_DEVICE_MEMORY, ErrorKind::out_of_memory},
                                       std::pair{VK_ERROR_OUT_OF_HOST_MEMORY, ErrorKind::out_of_memory},
                                       std::pair{VK_ERROR_DEVICE_LOST, ErrorKind::device_lost}}) {
        for (const std::uint64_t point : sweepPoints(name("calls"), calls, 80)) {
            SCOPED_TRACE("call " + std::to_string(point) + ", result " + std::to_string(result));
            NullDriver driver;
            driver.failCall(point, result);
            {
                Walk walk(options_);
                const End end = endOf([&] { walk.run(driver); });
                ASSERT_TRUE(end.error);
                EXPECT_EQ(end.kind, kind);
                if (kind != ErrorKind::device_lost) {
                    expectGoesOn(walk);
                }
            }
            expectNothingLeft(driver);
            if (HasFailure()) {
                return;
            }
        }
    }
}

// A lost device: the same program makes all of it again on a new one.
TEST_P(Faults, ofALostDeviceEndWithIt)
{
    NullDriver lost;
    std::optional<Walk> walk(options_);
    walk->run(lost);
    lost.failCall(1, VK_ERROR_DEVICE_LOST);
    EXPECT_EQ(endOf([&] { walk->frame(); }).kind, ErrorKind::device_lost);
    NullDriver next;
    Walk again(options_);
    again.run(next);
    walk.reset();
    expectNothingLeft(lost);
}

TEST_P(Faults, ofAllocationsComeOutAndLeaveNothing)
{
    std::uint64_t allocations = 0;
    {
        NullDriver driver;
        const std::uint64_t before = heapAllocations();
        Walk walk(options_);
        walk.run(driver);
        allocations = heapAllocations() - before;
    }
    ASSERT_GT(allocations, 100U);
    for (const std::uint64_t point : sweepPoints(name("allocations"), allocations, 160)) {
        SCOPED_TRACE("allocation " + std::to_string(point));
        NullDriver driver;
        {
            Walk walk(options_);
            End end;
            {
                const FailingAllocation failing(point);
                end = endOf([&] { walk.run(driver); });
            }
            EXPECT_TRUE(end.bad_alloc || end.error || !FailingAllocation::failed() ||
                        walk.frameIndex() == Walk::kFrames);
            expectGoesOn(walk);
        }
        expectNothingLeft(driver);
        if (HasFailure()) {
            return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bases, Faults, testing::ValuesIn(allBases()),
                         [](const auto& base) { return nameOfBase(base.param); });

} // namespace
} // namespace gnomon::test
