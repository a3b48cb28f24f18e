// SPDX-License-Identifier: Apache-2.0
// Programs from the GLSL that spirv-cross makes of the library's passes, with values for their specialization
// constants. They stay once they are made.
#pragma once

#include "context.h"

#include <span>
#include <string_view>
#include <vector>

namespace gnomon::gl {

/// The uniform block that stands for push constants has this binding.
inline constexpr GLuint kPushBinding = 13;

class Programs {
public:
    explicit Programs(const Context& context) : context_(context), push_(makeBuffer(context)) {}

    /// Modules by name ("mask_pcf.frag"). Throws Error where the driver does not compile them.
    [[nodiscard]] GLuint draw(std::string_view vertex, std::string_view fragment,
                              std::span<const std::uint32_t> words);
    [[nodiscard]] GLuint compute(std::string_view module, std::span<const std::uint32_t> words);
    /// Uploads and binds push constants.
    void push(std::span<const std::uint32_t> words) const;

private:
    struct Made {
        std::string_view first; // of the list of modules, so that it lasts
        std::string_view second;
        std::vector<std::uint32_t> words;
        Program program;
    };
    [[nodiscard]] GLuint get(std::string_view first, std::string_view second,
                             std::span<const std::uint32_t> words);

    const Context& context_;
    Buffer push_;
    std::vector<Made> made_;
};

} // namespace gnomon::gl
