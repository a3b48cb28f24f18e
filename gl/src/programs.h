// SPDX-License-Identifier: Apache-2.0
// Programs from the GLSL that spirv-cross makes of the library's passes, with values for their specialization
// constants. They stay once they are made.
#pragma once

#include "context.h"

#include <cstring>
#include <string_view>
#include <vector>

namespace gnomon::gl {

/// The uniform block that stands for push constants has this binding.
inline constexpr GLuint kPushBinding = 13;

/// The words of a struct of constants, four bytes each, in the order of their constant_ids.
template <class Constants> [[nodiscard]] std::vector<std::uint32_t> wordsOf(const Constants& constants)
{
    static_assert(sizeof(Constants) % 4 == 0);
    std::vector<std::uint32_t> words(sizeof(Constants) / 4);
    std::memcpy(words.data(), &constants, sizeof(Constants));
    return words;
}

class Programs {
public:
    explicit Programs(const Context& context) : context_(context), push_(makeBuffer(context)) {}

    /// Modules by name ("mask_pcf.frag"). Throws Error where the driver does not compile them.
    [[nodiscard]] GLuint draw(std::string_view vertex, std::string_view fragment, std::vector<std::uint32_t> words);
    [[nodiscard]] GLuint compute(std::string_view module, std::vector<std::uint32_t> words = {});
    /// Uploads and binds push constants.
    template <class Push> void push(const Push& push) const
    {
        upload(context_, push_, std::span(&push, 1));
        context_.gl.BindBufferBase(GL_UNIFORM_BUFFER, kPushBinding, push_.name());
    }
    /// Is there a module of this name?
    [[nodiscard]] static bool has(std::string_view module);

private:
    struct Made {
        std::string_view first; // of the list of modules, so that it lasts
        std::string_view second;
        std::vector<std::uint32_t> words;
        Program program;
    };
    [[nodiscard]] GLuint get(std::string_view first, std::string_view second, std::vector<std::uint32_t>&& words);

    const Context& context_;
    Buffer push_;
    std::vector<Made> made_;
};

} // namespace gnomon::gl
