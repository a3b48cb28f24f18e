// SPDX-License-Identifier: Apache-2.0
#include "depth_blocks.h"

#include <gnomon/pack/filter_passes.h>
#include <gnomon/pack/filter_rule.h>

#include <algorithm>

namespace gnomon::gl {

DepthBlocks::DepthBlocks(const Context& context, Programs& programs)
    : context_(context), programs_(programs), nearest_(makeSampler(context, false))
{
}

void DepthBlocks::setMaps(const Image& maps)
{
    ImageInfo info;
    info.format = GL_R32UI;
    info.levels = pack::blockLevels(maps.info().size);
    info.size = glm::uvec2(1U << (info.levels - 1));
    info.layers = maps.info().layers;
    image_ = Image(context_, info);
    is_new_ = true;
}

void DepthBlocks::make(const Image& maps, const Tile& part)
{
    const std::uint32_t levels = image_.info().levels;
    const auto bind = [&](GLuint unit, std::uint32_t level, GLenum access) {
        context_.gl.BindImageTexture(unit, image_.name(), static_cast<GLint>(std::min(level, levels - 1)), GL_TRUE, 0,
                                     access, GL_R32UI);
    };
    for (std::uint32_t i = 0; i < pack::blockPassCount(levels); ++i) {
        const pack::BlockPass pass = pack::blockPass(i, maps.info().size, part);
        context_.gl.UseProgram(programs_.compute(i == 0 ? "depth_blocks_map.comp" : "depth_blocks.comp"));
        if (i == 0) {
            context_.gl.BindTextureUnit(0, maps.name());
            context_.gl.BindSampler(0, nearest_.name());
        } else {
            bind(0, pass.first_level - 1, GL_READ_ONLY);
        }
        bind(1, pass.first_level, GL_WRITE_ONLY);
        bind(2, pass.first_level + 1, GL_WRITE_ONLY);
        struct Push {
            std::array<std::int32_t, 4> first;
            std::array<std::int32_t, 4> last;
        };
        programs_.push(Push{pass.first, pass.last});
        context_.gl.DispatchCompute(pass.groups_x, pass.groups_y, 1);
        waitForShaders(context_);
    }
}

void DepthBlocks::draw(const MapJob& job, const Image& maps)
{
    const ImageInfo& info = maps.info();
    for (std::uint32_t layer = 0; is_new_ && layer < info.layers; ++layer) {
        make(maps, {layer, 0, 0, info.size.x, info.size.y});
    }
    for (std::uint32_t i = 0; !is_new_ && i < job.plan.views.size(); ++i) {
        if (job.of(i).draw) {
            const View& view = job.plan.views[i];
            make(maps, pack::redrawnPart(view, job.of(i).whole || view.place.part != TexelPart::whole));
        }
    }
    is_new_ = false;
}

} // namespace gnomon::gl
