// SPDX-License-Identifier: Apache-2.0
#include "view/drawing.h"

#include "debug_views.h"
#include "view/edits.h"

namespace gnomon::app::view {

Drawing::Drawing(host::Gpu& gpu, const Scenery& scenery, const Settings& settings)
    : gpu_(gpu), scenery_(scenery), settings_(settings), canvas_(gpu)
{
    make(true);
}

void Drawing::make(bool shadows)
{
    renderer_.reset(); // its images first, so that both need not have room
    host::RenderOptions options = renderOptions(settings_);
    options.shadows = shadows;
    renderer_ = std::make_unique<host::FrameRenderer>(scenery_.on_gpu, options);
    fresh_ = true;
}

void Drawing::take(const Settings& settings)
{
    const bool other_renderer = !renderer_ || !renderer_->options().shadows || changesRenderer(settings_, settings);
    settings_ = settings;
    if (other_renderer) {
        make(true);
    } else if (renderer_->options().width != settings.size_px.x || renderer_->options().height != settings.size_px.y) {
        renderer_->resize(settings.size_px.x, settings.size_px.y);
    }
}

/// A debug view is painted of the frame that was drawn, so the canvas takes either.
void Drawing::showFrame()
{
    const Shot& shot = scenery_.shot;
    const bool debugs = settings_.debug != "none";
    renderer_->submit(shot.state, shot.eye, shot.lights, debugs ? nullptr : &canvas_);
    times_ = renderer_->finish();
    painted_.reset();
    if (debugs) {
        painted_ = debugPicture(*renderer_, shot, settings_, lightIndex(shot, settings_));
        canvas_.paint(*painted_);
    }
}

void Drawing::draw()
{
    const bool is_still = fresh_ && settings_.converge == 1;
    still_ = false;
    fresh_ = false;
    showFrame();
    still_ = is_still;
}

void Drawing::drawOnce()
{
    showFrame();
}

void Drawing::drawStill()
{
    if (!fresh_) {
        make(true);
    }
    still_ = false;
    fresh_ = false;
    const Shot& shot = scenery_.shot;
    for (std::uint32_t frame = 1; frame < settings_.converge; ++frame) {
        renderer_->draw(shot.state, shot.eye, shot.lights);
    }
    showFrame();
    still_ = true;
}

void Drawing::drawWith(const std::vector<ImageF>& masks)
{
    if (renderer_->options().shadows) {
        make(false);
    }
    const Shot& shot = scenery_.shot;
    renderer_->submit(shot.state, shot.eye, shot.lights, &canvas_, &masks);
    times_ = renderer_->finish();
    painted_.reset();
    fresh_ = false;
    still_ = true;
}

Image8 Drawing::picture()
{
    return painted_ ? *painted_ : renderer_->read({.colour = true}).colour;
}

} // namespace gnomon::app::view
