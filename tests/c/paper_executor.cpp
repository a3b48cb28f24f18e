// SPDX-License-Identifier: Apache-2.0
#include "paper_executor.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {
namespace {

bool isDepth(const std::string& format)
{
    return format.starts_with('d');
}

bool isWithin(const std::uint32_t (&range)[2], std::uint32_t count)
{
    return std::uint64_t{range[0]} + range[1] <= count;
}

} // namespace

PaperExecutor::PaperExecutor(std::uint32_t width, std::uint32_t height)
{
    for (std::uint32_t name = GNOMON_IMAGE_CAMERA_DEPTH; name <= GNOMON_IMAGE_CAMERA_IDS; ++name) {
        images_[{name, 0}] = {name == GNOMON_IMAGE_CAMERA_IDS ? "r32ui" : "host", width, height, 0};
    }
}

const PaperExecutor::Image& PaperExecutor::imageOf(const std::uint32_t (&name)[2]) const
{
    static const Image kNone;
    const auto found = images_.find({name[0], name[1]});
    EXPECT_NE(found, images_.end()) << "image " << name[0] << " of options " << name[1];
    return found != images_.end() ? found->second : kNone;
}

std::uint64_t PaperExecutor::bytesOf(const std::uint32_t (&name)[2]) const
{
    const auto found = buffers_.find({name[0], name[1]});
    EXPECT_NE(found, buffers_.end()) << "buffer " << name[0] << " of options " << name[1];
    return found != buffers_.end() ? found->second : 0;
}

std::uint32_t PaperExecutor::ran(GnomonCommandKind kind) const
{
    const auto found = ran_.find(kind);
    return found != ran_.end() ? found->second : 0;
}

void PaperExecutor::forget()
{
    std::erase_if(images_, [](const auto& image) { return image.first.first < GNOMON_IMAGE_CAMERA_DEPTH; });
    buffers_.clear();
}

void PaperExecutor::run(const GnomonCommandList* list)
{
    ASSERT_NE(list, nullptr) << gnomonLastError()->message;
    written_.clear();
    ran_.clear();
    for (std::uint32_t i = 0; i < list->command_count; ++i) {
        SCOPED_TRACE("command " + std::to_string(i) + " of kind " + std::to_string(list->commands[i].kind));
        ++ran_[list->commands[i].kind];
        runOne(*list, list->commands[i]);
    }
}

void PaperExecutor::drop(std::uint32_t options)
{
    std::erase_if(images_, [&](const auto& image) {
        return image.first.second == options && image.first.first < GNOMON_IMAGE_MASK;
    });
    std::erase_if(buffers_, [&](const auto& buffer) {
        return buffer.first.second == options && buffer.first.first < GNOMON_OF_CONSTANTS;
    });
}

void PaperExecutor::make(const GnomonCommand& command)
{
    const Image made{command.format, command.size_px[0], command.size_px[1],
                     command.layers, command.levels,     command.samples};
    EXPECT_GT(made.width, 0U);
    EXPECT_GT(made.height, 0U);
    EXPECT_TRUE(made.levels >= 1 && std::max(made.width, made.height) >> (made.levels - 1) > 0) << made.levels;
    EXPECT_LT(command.image[0], std::uint32_t{GNOMON_IMAGE_CAMERA_DEPTH}) << "the host's own";
    if (command.keeps != 0) {
        const Image& old = imageOf(command.image);
        EXPECT_EQ(old.format, made.format);
        EXPECT_TRUE(old.width <= made.width && old.height <= made.height && old.layers <= made.layers);
    }
    images_[{command.image[0], command.image[1]}] = made;
}

void PaperExecutor::write(const GnomonCommandList& list, const GnomonCommand& command)
{
    EXPECT_TRUE(isWithin(command.data, list.word_count));
    const std::uint64_t end = command.offset + std::uint64_t{4} * command.data[1];
    EXPECT_LE(end, bytesOf(command.buffer));
    std::uint64_t& written = written_[{command.buffer[0], command.buffer[1]}];
    EXPECT_GE(command.offset, written) << "written twice";
    written = end;
}

void PaperExecutor::copy(const GnomonCommand& command) const
{
    const Image& from = imageOf(command.image);
    const Image& to = imageOf(command.to);
    EXPECT_EQ(from.format, to.format);
    EXPECT_EQ(from.samples, to.samples);
    const auto lies = [](const std::uint32_t(&tile)[5], const Image& image) {
        return tile[0] < std::max(image.layers, 1U) && tile[1] + tile[3] <= image.width &&
               tile[2] + tile[4] <= image.height;
    };
    EXPECT_TRUE(lies(command.area, from));
    EXPECT_TRUE(lies(command.place, to));
    EXPECT_TRUE(command.area[3] == command.place[3] && command.area[4] == command.place[4]);
}

void PaperExecutor::aim(const GnomonCommand& command) const
{
    EXPECT_TRUE(command.colour[0] != GNOMON_NO_INDEX || command.depth[0] != GNOMON_NO_INDEX);
    const auto fits = [&](const std::uint32_t(&name)[2], std::uint32_t layer, bool depth) {
        if (name[0] == GNOMON_NO_INDEX) {
            return;
        }
        const Image& image = imageOf(name);
        EXPECT_EQ(isDepth(image.format), depth) << image.format;
        EXPECT_LT(layer, std::max(image.layers, 1U));
        EXPECT_TRUE(command.viewport[0] + command.viewport[2] <= image.width &&
                    command.viewport[1] + command.viewport[3] <= image.height);
        EXPECT_TRUE(command.scissor[0] + command.scissor[2] <= image.width &&
                    command.scissor[1] + command.scissor[3] <= image.height);
    };
    fits(command.colour, command.colour_layer, false);
    fits(command.depth, command.depth_layer, true);
    EXPECT_TRUE(command.scissor[2] > 0 && command.scissor[3] > 0);
    EXPECT_NE(command.channels, 0U);
}

void PaperExecutor::bind(const GnomonCommandList& list, const GnomonCommand& command)
{
    modules_.insert(command.module);
    EXPECT_TRUE(isWithin(command.constants, list.word_count) && isWithin(command.push, list.word_count) &&
                isWithin(command.bindings, list.binding_count));
    std::set<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < command.bindings[1]; ++i) {
        const GnomonBinding& binding = list.bindings[command.bindings[0] + i];
        SCOPED_TRACE("binding " + std::to_string(binding.binding));
        EXPECT_TRUE(numbers.insert(binding.binding).second) << "bound twice";
        if (binding.kind == GNOMON_TEXTURE || binding.kind == GNOMON_STORAGE_IMAGE) {
            const Image& image = imageOf(binding.image);
            const bool all = binding.kind == GNOMON_TEXTURE && binding.level == GNOMON_NO_INDEX;
            EXPECT_TRUE(all || binding.level < image.levels) << binding.level;
            const bool is_target = command.kind == GNOMON_DRAW_TRIANGLE && binding.image[0] == command.colour[0] &&
                                   binding.image[1] == command.colour[1];
            EXPECT_FALSE(is_target) << "drawn to and read at once";
        } else {
            EXPECT_LE(binding.offset + binding.bytes, bytesOf(binding.buffer));
        }
    }
}

void PaperExecutor::runOne(const GnomonCommandList& list, const GnomonCommand& command)
{
    switch (command.kind) {
    case GNOMON_DROP_OPTIONS:
        drop(command.options);
        break;
    case GNOMON_MAKE_IMAGE:
        make(command);
        break;
    case GNOMON_MAKE_BUFFER:
        EXPECT_TRUE(command.bytes > 0 && command.bytes % 16 == 0);
        EXPECT_TRUE(command.copies == 0 || command.copies <= bytesOf(command.buffer));
        buffers_[{command.buffer[0], command.buffer[1]}] = command.bytes;
        break;
    case GNOMON_WRITE_BUFFER:
        write(list, command);
        break;
    case GNOMON_ZERO_BUFFER:
        EXPECT_GT(bytesOf(command.buffer), 0U);
        break;
    case GNOMON_COPY_TEXELS:
        copy(command);
        break;
    case GNOMON_CLEAR_TARGET:
    case GNOMON_DRAW_CASTERS:
        aim(command);
        break;
    case GNOMON_DRAW_TRIANGLE:
        aim(command);
        modules_.insert(command.vertex);
        bind(list, command);
        break;
    case GNOMON_RUN_COMPUTE:
        EXPECT_TRUE(command.groups[0] > 0 && command.groups[1] > 0 && command.groups[2] > 0);
        bind(list, command);
        break;
    default:
        ADD_FAILURE() << "no such kind";
    }
}

} // namespace gnomon::test
