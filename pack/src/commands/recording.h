// SPDX-License-Identifier: Apache-2.0
// Appends commands to a list, and knows which images and buffers they have made.
#pragma once

#include <gnomon/pack/frame_commands.h>

#include <array>
#include <cstring>
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace gnomon::pack {

class Recording {
public:
    /// Commands go to this list from now on.
    void to(CommandList& out) { out_ = &out; }

    [[nodiscard]] const ImageShape& shapeOf(const ImageRef& image) const;
    [[nodiscard]] bool covers(const ImageRef& image, glm::uvec2 size_px, std::uint32_t layers) const;
    /// In place of another one, whose texels are lost.
    void make(const ImageRef& image, const ImageShape& shape);
    /// Makes it larger where it does not cover these. True when it was made anew.
    bool grow(const ImageRef& image, ImageShape shape);
    void makeBuffer(const BufferRef& buffer, std::uint64_t bytes, std::uint64_t copies = 0);
    /// Writes all of a buffer, which is made where it is too small.
    template <class T>
    void upload(const BufferRef& buffer, std::span<const T> elements);
    template <class T>
    void write(const BufferRef& buffer, std::uint64_t offset, const T& element)
    {
        out_->commands.emplace_back(WriteBuffer{buffer, offset, words(element), false});
    }
    /// The options' images and buffers are gone.
    void drop(std::uint32_t options);
    /// So are all.
    void forget();

    void add(const Command& command) { out_->commands.push_back(command); }
    /// A range of words with these bytes.
    template <class T>
    CommandRange words(const T& bytes)
    {
        static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
        return copied(&bytes, sizeof(T));
    }
    CommandRange bindings(std::initializer_list<CommandBinding> list);
    /// The text, for as long as this lives.
    std::string_view module(std::string_view name);

private:
    static constexpr std::size_t kImages = static_cast<std::size_t>(ImageName::camera_ids) + 1;
    static constexpr std::size_t kBuffers = static_cast<std::size_t>(BufferName::points) + 1;
    struct Made { // of one of the plan's options
        std::array<ImageShape, kImages> images;
        std::array<std::uint64_t, kBuffers> buffers{}; // bytes
    };
    [[nodiscard]] Made& madeFor(std::uint32_t options);
    CommandRange copied(const void* bytes, std::size_t size);

    CommandList* out_ = nullptr;
    std::vector<Made> made_; // by options; those of the frame are the first ones'
    std::set<std::string, std::less<>> modules_;
};

template <class T>
void Recording::upload(const BufferRef& buffer, std::span<const T> elements)
{
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 4 == 0);
    if (elements.empty()) {
        return;
    }
    if (madeFor(buffer.options).buffers[static_cast<std::size_t>(buffer.name)] < elements.size_bytes()) {
        makeBuffer(buffer, elements.size_bytes());
    }
    out_->commands.emplace_back(WriteBuffer{buffer, 0, copied(elements.data(), elements.size_bytes()), true});
}

/// The image as a texture of all levels, or one level.
[[nodiscard]] CommandBinding texture(std::uint32_t binding, const ImageRef& image, bool linear = false,
                                     std::uint32_t level = kNoIndex);
[[nodiscard]] CommandBinding storageImage(std::uint32_t binding, const ImageRef& image, std::uint32_t level);
[[nodiscard]] CommandBinding storage(std::uint32_t binding, const BufferRef& buffer);
[[nodiscard]] CommandBinding uniform(std::uint32_t binding, const BufferRef& buffer, std::uint64_t offset = 0,
                                     std::uint64_t bytes = 0);

} // namespace gnomon::pack
