// SPDX-License-Identifier: Apache-2.0
#include "allocation_count.h"

#include <gnomon/vulkan/draw_batcher.h>

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <utility>

namespace gnomon::test {
namespace {

using namespace vulkan;

struct Built {
    std::vector<VkDrawIndexedIndirectCommand> commands;
    std::vector<std::uint32_t> instances;
    std::vector<BatchDraws> batches;
    std::uint64_t indices = 0;
};

Built build(DrawBatcher& batcher, std::span<const std::uint32_t> list, std::uint32_t first = 0)
{
    Built b;
    b.commands.resize(batcher.maxCommands());
    b.instances.resize(batcher.instanceCount(list));
    const DrawLists lists = batcher.build(list, first, b.commands, b.instances);
    b.commands.resize(lists.command_count);
    EXPECT_LE(lists.instance_count, b.instances.size());
    b.batches.assign(lists.batches.begin(), lists.batches.end());
    b.indices = lists.index_count;
    return b;
}

TEST(DrawBatcher, equalMeshesBecomeInstances)
{
    DrawBatcher batcher;
    const std::array<DrawPart, 3> parts{{{{0, 3, 0}, 1}, {{3, 6, 5}, 0}, {{9, 12, 7}, 1}}};
    const std::array<DrawObject, 4> objects{{{0, 1}, {1, 2}, {0, 1}, {1, 2}}};
    batcher.setScene(parts, objects);
    const std::array<std::uint32_t, 4> list{0, 1, 2, 3};
    const Built b = build(batcher, list, 100);
    ASSERT_EQ(b.commands.size(), 3U);
    ASSERT_EQ(b.batches.size(), 2U);
    EXPECT_EQ(b.batches[0].batch, 0U);
    EXPECT_EQ(b.batches[0].command_count, 1U);
    EXPECT_EQ(b.batches[1].first_command, 1U);
    EXPECT_EQ(b.batches[1].command_count, 2U);
    EXPECT_EQ(b.commands[0].firstIndex, 3U);
    EXPECT_EQ(b.commands[0].vertexOffset, 5);
    EXPECT_EQ(b.commands[0].instanceCount, 2U);
    EXPECT_EQ(b.commands[0].firstInstance, 100U);
    EXPECT_EQ(b.commands[1].firstInstance, 102U);
    EXPECT_EQ(b.instances, (std::vector<std::uint32_t>{1, 3, 0, 2, 1, 3}));
    EXPECT_EQ(b.indices, 2U * (6 + 3 + 12));
}

TEST(DrawBatcher, emptyMeshesAndUnknownHandlesDrawNothing)
{
    DrawBatcher batcher;
    const std::array<DrawPart, 2> parts{{{{0, 0, 0}, 0}, {{0, 3, 0}, 0}}};
    const std::array<DrawObject, 3> objects{{{0, 1}, {1, 1}, {0, 0}}};
    batcher.setScene(parts, objects);
    const std::array<std::uint32_t, 4> list{0, 1, 2, 77};
    const Built b = build(batcher, list);
    ASSERT_EQ(b.commands.size(), 1U);
    EXPECT_EQ(b.commands[0].instanceCount, 1U);
    EXPECT_EQ(b.instances[0], 1U);
    EXPECT_TRUE(build(batcher, {}).commands.empty());
}

// Every (object, part) pair of the list is drawn exactly once, whatever the scene.
TEST(DrawBatcher, drawsEachPartOfEachObjectOnce)
{
    std::mt19937 rng(7);
    for (int round = 0; round < 50; ++round) {
        std::vector<DrawPart> parts(1 + rng() % 40);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            parts[i] = {{static_cast<std::uint32_t>(i), 3, 0}, static_cast<std::uint32_t>(rng() % 5)};
        }
        std::vector<DrawObject> objects(1 + rng() % 60);
        for (DrawObject& object : objects) {
            object.first_part = static_cast<std::uint32_t>(rng() % parts.size());
            object.part_count = static_cast<std::uint32_t>(rng() % (parts.size() - object.first_part + 1));
        }
        std::vector<std::uint32_t> list;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> wanted;
        for (std::uint32_t i = 0; i < objects.size(); ++i) {
            if (rng() % 2 == 0) {
                list.push_back(i);
                for (std::uint32_t p = 0; p < objects[i].part_count; ++p) {
                    ++wanted[{objects[i].first_part + p, i}];
                }
            }
        }
        DrawBatcher batcher;
        batcher.setScene(parts, objects);
        const Built b = build(batcher, list);
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> drawn;
        for (const BatchDraws& batch : b.batches) {
            for (std::uint32_t c = 0; c < batch.command_count; ++c) {
                const auto& command = b.commands[batch.first_command + c];
                EXPECT_EQ(parts[command.firstIndex].batch, batch.batch);
                for (std::uint32_t k = 0; k < command.instanceCount; ++k) {
                    ++drawn[{command.firstIndex, b.instances[command.firstInstance + k]}];
                }
            }
        }
        EXPECT_EQ(drawn, wanted);
    }
}

TEST(DrawBatcher, buildAllocatesNothing)
{
    DrawBatcher batcher;
    const std::vector<DrawPart> parts(100, {{0, 3, 0}, 2});
    const std::vector<DrawObject> objects(1000, {10, 50});
    batcher.setScene(parts, objects);
    std::vector<std::uint32_t> list(1000);
    std::vector<VkDrawIndexedIndirectCommand> commands(batcher.maxCommands());
    std::vector<std::uint32_t> instances(50000);
    const auto before = heapAllocations();
    (void)batcher.build(list, 0, commands, instances);
    EXPECT_EQ(heapAllocations(), before);
}

} // namespace
} // namespace gnomon::test
