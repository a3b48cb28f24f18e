// SPDX-License-Identifier: Apache-2.0
// The blur of a layer of the mask, to images of its own and back.
#include "commands/mask_commands.h"

#include <gnomon/shared/gpu_structs.h>
#include <gnomon/shared/screen_blur.h>

namespace gnomon::pack {
namespace {

// Specialization constants of soften.frag and soften_spread.frag.
struct Constants {
    std::int32_t scale;
    std::uint32_t edge_aware;
    std::uint32_t has_normals;
    std::int32_t kernel;
    std::uint32_t in_software;
};

// Their push constants.
struct Push {
    glm::ivec4 sizes;
    glm::ivec4 how;
    glm::vec4 along;
};

bool passesTwice(const ScreenBlurOptions& blur)
{
    return blur.kernel != ScreenKernel::poisson && blur.passes == 2;
}

std::int32_t kernelNumber(const ScreenBlurOptions& blur)
{
    const bool published = blur.kernel == ScreenKernel::gaussian && blur.taps == ScreenTaps::published;
    return published ? shared::kScreenPublished : static_cast<std::int32_t>(blur.kernel);
}

} // namespace

void MaskCommands::soften(const RecorderInputs& inputs, const SoftenDraw& draw)
{
    const auto scale = static_cast<std::uint32_t>(pixelsPerTexel(draw.blur.size));
    const glm::uvec2 full = mask().size_px;
    const glm::uvec2 small((full.x + scale - 1) / scale, (full.y + scale - 1) / scale);
    const ImageRef depth{ImageName::camera_depth};
    DrawTriangle triangle;
    triangle.vertex = "mask.vert";
    triangle.constants =
        recording_.words(Constants{static_cast<std::int32_t>(scale), draw.blur.edges == ScreenEdges::aware ? 1U : 0U,
                                   inputs.normals ? 1U : 0U, kernelNumber(draw.blur), traits_.in_software ? 1U : 0U});
    const auto pass = [&](ImageName to, ImageName from, const glm::vec2& direction, bool spreads) {
        const bool of_mask = from == ImageName::mask;
        const bool to_mask = to == ImageName::mask;
        const glm::uvec2 read = of_mask ? full : small;
        const glm::uvec2 drawn = to_mask ? full : small;
        Push push{};
        push.sizes = {read.x, read.y, full.x, full.y};
        push.how = {of_mask ? 1U : scale, of_mask ? draw.layer : 0U, draw.blur.points, 0};
        push.along = {direction.x, direction.y, draw.blur.strength_px, 0.0F};
        triangle.target.colour = ImageRef{to};
        triangle.target.colour_layer = to_mask ? draw.layer : 0;
        triangle.target.viewport = {0, 0, 0, drawn.x, drawn.y};
        triangle.target.scissor = triangle.target.viewport;
        triangle.target.channels = !to_mask || draw.whole ? 0xF : draw.channels;
        triangle.fragment = spreads ? "soften_spread.frag" : "soften.frag";
        triangle.push = recording_.words(push);
        triangle.bindings = recording_.bindings(
            {uniform(0, {BufferName::constants}, 0, sizeof(shared::GpuConstants)), texture(1, depth),
             texture(2, inputs.normals ? ImageRef{ImageName::camera_normal} : depth), texture(3, {from}, true),
             uniform(4, {BufferName::points})});
        recording_.add(triangle);
    };
    constexpr glm::vec2 kAcross(1.0F, 0.0F);
    constexpr glm::vec2 kDown(0.0F, 1.0F);
    const bool twice = passesTwice(draw.blur);
    pass(ImageName::blurred, ImageName::mask, kAcross, false);
    if (twice && draw.blur.size == ScreenSize::full) {
        pass(ImageName::mask, ImageName::blurred, kDown, false);
        return;
    }
    if (twice) {
        pass(ImageName::blurred_twice, ImageName::blurred, kDown, false);
    }
    pass(ImageName::mask, twice ? ImageName::blurred_twice : ImageName::blurred, kAcross, true);
}

} // namespace gnomon::pack
