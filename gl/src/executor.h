// SPDX-License-Identifier: Apache-2.0
// Carries out the commands of a frame (gnomon/pack/frame_commands.h). Its units and bindings are those of the modules.
#pragma once

#include "programs.h"

#include <gnomon/pack/frame_commands.h>

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace gnomon::gl {

/// The host's part in a list of commands.
struct Host {
    const Plan& plan;
    const MaskInputs* inputs = nullptr; // for a list that draws the mask
    const DrawCasters* draw = nullptr;  // for a list that draws maps
};

class Executor {
public:
    explicit Executor(const Context& context);

    /// Throws Error where memory is gone or a limit is too low, and what the callback throws.
    void run(const pack::CommandList& list, const Host& host);
    /// Deletes all images and buffers.
    void forget();
    /// Empty: there is none.
    [[nodiscard]] TextureRef image(const pack::ImageRef& image) const;

private:
    struct ImageSlot {
        Image image;
        std::vector<Texture> levels; // each as a texture of its own, once it was asked for
    };
    struct BufferSlot {
        Buffer buffer;
        std::uint64_t bytes = 0;
    };
    [[nodiscard]] ImageSlot& slot(const pack::ImageRef& image);
    [[nodiscard]] BufferSlot& slot(const pack::BufferRef& buffer);
    [[nodiscard]] GLuint textureOf(const pack::CommandBinding& binding);
    /// The words of a range of the list that is run.
    [[nodiscard]] std::span<const std::uint32_t> words(const pack::CommandRange& range) const;

    void carryOut(const pack::DropOptions& command);
    void carryOut(const pack::MakeImage& command);
    void carryOut(const pack::MakeBuffer& command);
    void carryOut(const pack::WriteBuffer& command);
    void carryOut(const pack::ZeroBuffer& command);
    void carryOut(const pack::CopyTexels& command);
    void carryOut(const pack::ClearTarget& command);
    void carryOut(const pack::DrawMapCasters& command);
    void carryOut(const pack::DrawTriangle& command);
    void carryOut(const pack::RunCompute& command);
    void aim(const pack::CommandTarget& target);
    void unbindSamplers();
    void attach(GLenum attachment, const std::optional<pack::ImageRef>& image, std::uint32_t layer);
    void bind(const pack::CommandBinding& binding);
    void use(GLuint program, const pack::CommandRange& push, const pack::CommandRange& bindings);

    const Context& context_;
    Programs programs_;
    Framebuffer framebuffer_;
    Sampler nearest_;
    Sampler linear_;
    VertexArray no_vertices_;
    std::vector<ImageSlot> images_;   // by options and name
    std::vector<BufferSlot> buffers_; // by options and name
    const pack::CommandList* list_ = nullptr;
    const Host* host_ = nullptr;
    std::optional<pack::CommandTarget> target_; // that the framebuffer has
    pack::CommandRange bound_;                  // that this list has bound last
};

} // namespace gnomon::gl
