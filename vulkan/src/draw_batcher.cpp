// SPDX-License-Identifier: Apache-2.0
// A counting sort of (part, object) pairs: linear in the list and in the number of parts.
#include <gnomon/error.h>
#include <gnomon/vulkan/draw_batcher.h>

#include <algorithm>
#include <numeric>

namespace gnomon::vulkan {
namespace {

constexpr const char* kBuilding = "list draws of objects";

} // namespace

void DrawBatcher::setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects)
{
    for (const DrawObject& object : objects) {
        if (object.first_part > parts.size() || object.part_count > parts.size() - object.first_part) {
            throw Error("list what objects draw", "an object names parts that there are not",
                        "keep first_part + part_count within the parts");
        }
    }
    parts_.assign(parts.begin(), parts.end());
    objects_.assign(objects.begin(), objects.end());
    order_.resize(parts.size());
    std::iota(order_.begin(), order_.end(), 0U);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return parts_[a].batch < parts_[b].batch; });
    cursor_.assign(parts.size(), 0U);
    batches_.clear();
    batches_.reserve(parts.size());
}

std::uint32_t DrawBatcher::instanceCount(std::span<const std::uint32_t> list) const
{
    std::uint32_t count = 0;
    for (const std::uint32_t handle : list) {
        count += handle < objects_.size() ? objects_[handle].part_count : 0U;
    }
    return count;
}

DrawLists DrawBatcher::build(std::span<const std::uint32_t> list, std::uint32_t first_instance,
                             std::span<VkDrawIndexedIndirectCommand> commands, std::span<std::uint32_t> instances,
                             bool places)
{
    std::fill(cursor_.begin(), cursor_.end(), 0U);
    for (const std::uint32_t handle : list) {
        if (handle < objects_.size()) {
            const DrawObject object = objects_[handle];
            for (std::uint32_t i = 0; i < object.part_count; ++i) {
                ++cursor_[object.first_part + i];
            }
        }
    }

    DrawLists result;
    batches_.clear();
    for (const std::uint32_t part : order_) {
        const std::uint32_t count = cursor_[part];
        cursor_[part] = result.instance_count;
        if (count == 0 || parts_[part].mesh.index_count == 0) {
            continue;
        }
        if (batches_.empty() || batches_.back().batch != parts_[part].batch) {
            batches_.push_back({parts_[part].batch, result.command_count, 0});
        }
        ++batches_.back().command_count;
        if (result.command_count >= commands.size()) {
            throw Error(kBuilding, "there is no room for the draw commands", "give as many as maxCommands() says");
        }
        const MeshRange mesh = parts_[part].mesh;
        commands[result.command_count++] = {mesh.index_count, count, mesh.first_index, mesh.vertex_offset,
                                            first_instance + result.instance_count};
        result.instance_count += count;
        result.index_count += std::uint64_t{mesh.index_count} * count;
    }
    if (result.instance_count > instances.size()) {
        throw Error(kBuilding, "there is no room for the instances", "give as many as instanceCount() says");
    }

    for (std::uint32_t place = 0; place < list.size(); ++place) {
        const std::uint32_t handle = list[place];
        if (handle < objects_.size()) {
            const DrawObject object = objects_[handle];
            for (std::uint32_t i = 0; i < object.part_count; ++i) {
                const std::uint32_t part = object.first_part + i;
                if (parts_[part].mesh.index_count != 0) {
                    instances[cursor_[part]++] = places ? place : handle;
                }
            }
        }
    }
    result.batches = batches_;
    return result;
}

} // namespace gnomon::vulkan
