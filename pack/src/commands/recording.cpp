// SPDX-License-Identifier: Apache-2.0
#include "commands/recording.h"

#include <algorithm>

namespace gnomon::pack {

Recording::Made& Recording::madeFor(std::uint32_t options)
{
    if (options >= made_.size()) {
        made_.resize(options + 1);
    }
    return made_[options];
}

const ImageShape& Recording::shapeOf(const ImageRef& image) const
{
    static constexpr ImageShape kNone;
    return image.options < made_.size() ? made_[image.options].images[static_cast<std::size_t>(image.name)] : kNone;
}

bool Recording::covers(const ImageRef& image, glm::uvec2 size_px, std::uint32_t layers) const
{
    const ImageShape& shape = shapeOf(image);
    return shape.size_px.x >= size_px.x && shape.size_px.y >= size_px.y && shape.layers >= layers &&
           shape.size_px.x > 0;
}

void Recording::make(const ImageRef& image, const ImageShape& shape)
{
    madeFor(image.options).images[static_cast<std::size_t>(image.name)] = shape;
    out_->commands.emplace_back(MakeImage{image, shape, false});
}

bool Recording::grow(const ImageRef& image, ImageShape shape)
{
    ImageShape& have = madeFor(image.options).images[static_cast<std::size_t>(image.name)];
    if (covers(image, shape.size_px, shape.layers) && have.levels >= shape.levels) {
        return false;
    }
    const bool is_there = have.size_px.x > 0;
    if (is_there) {
        shape.size_px = {std::max(shape.size_px.x, have.size_px.x), std::max(shape.size_px.y, have.size_px.y)};
        shape.layers = std::max(shape.layers, have.layers);
    }
    have = shape;
    out_->commands.emplace_back(MakeImage{image, shape, is_there});
    return true;
}

void Recording::makeBuffer(const BufferRef& buffer, std::uint64_t bytes, std::uint64_t copies)
{
    constexpr std::uint64_t kStep = 16;
    const std::uint64_t rounded = (bytes + kStep - 1) / kStep * kStep;
    madeFor(buffer.options).buffers[static_cast<std::size_t>(buffer.name)] = rounded;
    out_->commands.emplace_back(MakeBuffer{buffer, rounded, copies});
}

void Recording::drop(std::uint32_t options)
{
    Made& made = madeFor(options);
    const auto first_of_frame = static_cast<std::size_t>(ImageName::mask);
    std::fill_n(made.images.begin(), first_of_frame, ImageShape{});
    std::fill_n(made.buffers.begin(), static_cast<std::size_t>(BufferName::constants), 0);
    out_->commands.emplace_back(DropOptions{options});
}

void Recording::forget()
{
    made_.clear();
}

CommandRange Recording::copied(const void* bytes, std::size_t size)
{
    const std::size_t first = out_->words.size();
    const std::size_t count = size / 4;
    out_->words.resize(first + count);
    std::memcpy(out_->words.data() + first, bytes, size);
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)};
}

CommandRange Recording::bindings(std::initializer_list<CommandBinding> list)
{
    const auto first = static_cast<std::uint32_t>(out_->bindings.size());
    out_->bindings.insert(out_->bindings.end(), list);
    return {first, static_cast<std::uint32_t>(list.size())};
}

std::string_view Recording::module(std::string_view name)
{
    const auto found = modules_.find(name);
    return found != modules_.end() ? *found : *modules_.emplace(name).first;
}

CommandBinding texture(std::uint32_t binding, const ImageRef& image, bool linear, std::uint32_t level)
{
    CommandBinding made;
    made.binding = binding;
    made.image = image;
    made.linear = linear;
    made.level = level;
    return made;
}

CommandBinding storageImage(std::uint32_t binding, const ImageRef& image, std::uint32_t level)
{
    CommandBinding made = texture(binding, image, false, level);
    made.kind = BindingKind::storage_image;
    return made;
}

CommandBinding storage(std::uint32_t binding, const BufferRef& buffer)
{
    CommandBinding made;
    made.binding = binding;
    made.kind = BindingKind::storage;
    made.buffer = buffer;
    return made;
}

CommandBinding uniform(std::uint32_t binding, const BufferRef& buffer, std::uint64_t offset, std::uint64_t bytes)
{
    CommandBinding made = storage(binding, buffer);
    made.kind = BindingKind::uniform;
    made.offset = offset;
    made.bytes = bytes;
    return made;
}

} // namespace gnomon::pack
