// SPDX-License-Identifier: Apache-2.0
#include "sides.h"

#include <gnomon/plan_views.h>

#include <algorithm>
#include <cstdlib>

namespace gnomon::test {
namespace {

Light lightCalled(const std::string& name)
{
    if (name == "sun") {
        return makeSun({0.5, -1.0, 0.2});
    }
    Light light = makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5);
    if (name == "lamp") {
        light = {};
        light.type = LightType::point;
        light.position_ws = {0.5, 3.5, 2.5};
        light.range_m = 25.0;
    }
    light.radius_m = 0.2;
    return light;
}

} // namespace

void GlSide::run(const Plan& plan)
{
    (void)renderer.prepare(plan, inputs.size_px);
    renderer.drawMaps(plan, scene.callback());
    renderer.drawMask(plan, inputs);
}

std::vector<std::byte> GlSide::draw(const Plan& plan)
{
    see(plan.made_for.camera);
    run(plan);
    return GlScene::read(renderer.mask(), plan.mask_layers);
}

std::vector<Light> lightsOf(const std::string& names)
{
    std::vector<Light> lights;
    for (std::size_t at = 0; at < names.size();) {
        const std::size_t end = std::min(names.find(' ', at), names.size());
        lights.push_back(lightCalled(names.substr(at, end - at)));
        lights.back().key = static_cast<std::uint32_t>(lights.size());
        at = end + 1;
    }
    return lights;
}

int farthest(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    int most = a.size() == b.size() ? 0 : 256;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        most = std::max(most, std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])));
    }
    return most;
}

ImageF channelOf(const std::vector<std::byte>& mask, VkExtent2D screen, const Plan& plan, const LightPlan& light)
{
    const std::size_t channels = maskChannelCount(plan);
    const std::size_t pixels = std::size_t{screen.width} * screen.height;
    ImageF image(screen.width, screen.height, 1);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t at = (light.mask_layer * pixels + i) * channels + (channels > 1 ? light.mask_channel : 0);
        image.values[i] = std::to_integer<std::uint8_t>(mask[at]) / 255.0F;
    }
    return image;
}

} // namespace gnomon::test
