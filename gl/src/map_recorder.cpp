// SPDX-License-Identifier: Apache-2.0
#include "map_recorder.h"

#include <gnomon/plan_views.h>

namespace gnomon::gl {

pack::ViewWork MapJob::of(std::uint32_t view) const
{
    return optionsIndexOf(plan, plan.views[view]) == options ? work[view] : pack::ViewWork{};
}

void Target::attach(GLenum attachment, const Image* image, std::uint32_t layer) const
{
    if (image != nullptr && image->info().layers > 0) {
        context_.gl.NamedFramebufferTextureLayer(framebuffer_.name(), attachment, image->name(), 0,
                                                 static_cast<GLint>(layer));
    } else {
        context_.gl.NamedFramebufferTexture(framebuffer_.name(), attachment, image != nullptr ? image->name() : 0, 0);
    }
}

void Target::bind(const Image* colour, std::uint32_t colour_layer, const Image* depth, std::uint32_t depth_layer) const
{
    attach(GL_COLOR_ATTACHMENT0, colour, colour_layer);
    attach(GL_DEPTH_ATTACHMENT, depth, depth_layer);
    context_.gl.NamedFramebufferDrawBuffer(framebuffer_.name(), colour != nullptr ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    context_.gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
}

void Target::clearColour(float value) const
{
    const float values[4] = {value, value, value, value};
    context_.gl.ClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, values);
}

void Target::clearDepth() const
{
    const float far = 1.0F;
    context_.gl.ClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &far);
}

void drawCasters(const Context& context, const MapJob& job, std::uint32_t index, pack::CasterShare share)
{
    const View& view = job.plan.views[index];
    MapPass pass;
    pass.formats = mapFormats(optionsOf(job.plan, view), view.projection.orthographic);
    pass.plan = &job.plan;
    pass.view = &view;
    pass.view_index = index;
    pass.casters = pack::castersOf(job.plan, view, share);
    pass.clip_from_world = glm::mat4(view.projection.clip_from_world);
    pass.metric_ws = glm::vec4(view.projection.metric.metric_ws);
    setSwitch(context, GL_DEPTH_TEST, true);
    setSwitch(context, GL_DEPTH_CLAMP, view.projection.clamp_near);
    job.draw(pass);
    setSwitch(context, GL_DEPTH_CLAMP, false);
    setSwitch(context, GL_DEPTH_TEST, false);
}

} // namespace gnomon::gl
