// SPDX-License-Identifier: Apache-2.0
// Wrong calls of the parts that a host draws its casters by: each is a value or an Error with a sentence.
#include "misuser.h"

#include <gnomon/vulkan/volume_drawer.h>

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

TEST(Misuse, OfTheDrawersSceneIsAnError)
{
    Misuser host;
    EXPECT_THROW(host.drawer.setScene(host.parts, host.objects, std::span(host.batches).first(1)), Error);
    const std::vector<std::vector<vulkan::DrawObject>> wrong{{{0, 3}}, {{3, 0}}, {{0xFFFFFFFFU, 0xFFFFFFFFU}}};
    for (const auto& objects : wrong) {
        EXPECT_THROW(host.drawer.setScene(host.parts, objects, host.batches), Error);
    }
    expectRefused(host, "fewer transforms than objects",
                  [&] { host.drawer.beginFrame(0, host.plan, host.geometry, std::span(host.transforms).first(1)); });
    host.record();
    // Objects that the scene has not draw nothing.
    const std::uint64_t before = host.driver.counts().instances;
    for (std::uint32_t& caster : host.plan.casters) {
        caster += 1000;
    }
    host.plan.views[0].contents.redraw = host.plan.views[1].contents.redraw = true;
    host.record();
    EXPECT_EQ(host.driver.counts().instances, before);
}

TEST(Misuse, OfTheDrawersPassesIsAnError)
{
    Misuser host;
    host.record();
    host.begin();
    std::vector<std::uint32_t> many(5000, 1);
    MapPass pass;
    pass.commands = host.driver.commands();
    pass.plan = &host.plan;
    expectRefused(host, "has no view", [&] { host.drawer.draw(pass); });
    pass.view = &host.plan.views[0];
    pass.formats = vulkan::mapFormats((*host.plan.options)[0], true);
    for (const std::uint32_t count : {0U, 7U, 0xFFFFFFFFU}) {
        pass.view_count = count;
        expectRefused(host, "more than one pass can have", [&] { host.drawer.draw(pass); });
    }
    pass.view_count = 2;
    expectRefused(host, "views that the plan of beginFrame() has not", [&] { host.drawer.draw(pass); });
    pass.view_count = 1;
    pass.casters = many;
    expectRefused(host, "more casters than the plan", [&] { host.drawer.draw(pass); });
    pass.casters = std::span(many).first(1);
    pass.commands = VK_NULL_HANDLE;
    expectRefused(host, "command buffer is null", [&] { host.drawer.draw(pass); });
    host.record();
}

TEST(Misuse, OfTheDrawerOfVolumesIsAnError)
{
    Misuser host;
    vulkan::VolumeDrawer volumes(host.driver.view(), {});
    vulkan::VolumePass pass;
    pass.commands = host.driver.commands();
    const VkBuffer buffer = host.driver.makeBuffer();
    const vulkan::VolumeGeometry geometry{{buffer, 64}, {buffer, 64}, {buffer, 64}};
    const auto draws = [&] {
        (void)volumes.draw(pass);
    };
    expectRefused(host, "call beginFrame() first", draws);
    volumes.beginFrame(0, geometry, host.transforms);
    expectRefused(host, "slot", [&] { volumes.beginFrame(2, geometry, host.transforms); });
    expectRefused(host, "call beginFrame() first", draws); // of what a frame that did not begin has left
    expectRefused(host, "fill in all three", [&] { volumes.beginFrame(0, {}, host.transforms); });
    volumes.beginFrame(0, geometry, host.transforms);
    volumes.setScene(std::vector<vulkan::VolumeMesh>(host.transforms.size() + 1));
    expectRefused(host, "call beginFrame() first", draws); // its transforms are too few now
    expectRefused(host, "give one for each object", [&] { volumes.beginFrame(0, geometry, host.transforms); });
    volumes.setScene({});
    volumes.beginFrame(0, geometry, host.transforms);
    draws();
}

TEST(Misuse, OfTheBatchersRoomIsAnError)
{
    DrawBatcher batcher;
    const std::vector<vulkan::DrawPart> parts{{{0, 3, 0}, 0}, {{3, 3, 0}, 1}};
    const std::vector<vulkan::DrawObject> objects{{0, 2}, {1, 1}};
    batcher.setScene(parts, objects);
    const std::vector<std::uint32_t> list{0, 1, 99};
    std::vector<VkDrawIndexedIndirectCommand> commands(2);
    std::vector<std::uint32_t> instances(3);
    EXPECT_EQ(batcher.build(list, 0, commands, instances).instance_count, 3U);
    EXPECT_THROW(batcher.build(list, 0, std::span(commands).first(1), instances), Error);
    EXPECT_THROW(batcher.build(list, 0, commands, std::span(instances).first(2)), Error);
    EXPECT_EQ(batcher.build(list, 0, commands, instances).instance_count, 3U);
    EXPECT_EQ(DrawBatcher().build(list, 0, {}, {}).command_count, 0U);
}

TEST(Misuse, OfTheProfilersOrderIsAnErrorOrNothing)
{
    Misuser host;
    const VkCommandBuffer commands = host.driver.commands();
    host.profiler.addDraws(3);
    host.profiler.endPass(commands);
    expectRefused(host, "no frame has begun", [&] { host.profiler.beginPass(commands, "early"); });
    host.profiler.beginFrame(commands, 0);
    expectRefused(host, "command buffer is null", [&] { host.profiler.beginPass(VK_NULL_HANDLE, "nowhere"); });
    host.profiler.beginPass(commands, "one");
    expectRefused(host, "they do not nest", [&] { host.profiler.beginPass(commands, "nested"); });
    expectRefused(host, "call endPass() first", [&] { host.profiler.beginFrame(commands, 1); });
    host.profiler.endPass(commands);
    host.profiler.endPass(commands);
    for (int i = 0; i < 20; ++i) { // more than it was made for
        host.profiler.beginPass(commands, "more");
        host.profiler.endPass(commands);
    }
    EXPECT_EQ(host.profiler.results(0).size(), 8U);
}

} // namespace
} // namespace gnomon::test
