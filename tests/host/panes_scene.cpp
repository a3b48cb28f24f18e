// SPDX-License-Identifier: Apache-2.0
#include "panes_scene.h"

#include "small_scene.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <utility>

namespace gnomon::host::test {

glm::vec3 through(const glm::vec3& colour)
{
    return 1.0F - kPaneAlpha * (1.0F - colour);
}

float luminance(const glm::vec3& light)
{
    return glm::dot(light, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

void addLevel(scene::Scene& scene, float left_m, float right_m, float y, std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.positions = {{left_m, y, -4}, {left_m, y, 4}, {right_m, y, 4}, {right_m, y, -4}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    addMesh(scene, std::move(primitive));
}

scene::Scene panes(const std::vector<Pane>& panes)
{
    scene::Scene scene;
    scene.materials.resize(1);
    addLevel(scene, -4.0F, 4.0F, 0.0F, 0);
    for (const Pane& pane : panes) {
        scene::Material& glass = scene.materials.emplace_back();
        glass.alpha_mode = scene::AlphaMode::blend;
        glass.stained = true;
        glass.double_sided = true;
        glass.base_colour = glm::vec4(pane.colour, kPaneAlpha);
        addLevel(scene, 0.0F, 4.0F, pane.height_m, static_cast<std::uint32_t>(scene.materials.size() - 1));
    }
    scene.lights.resize(2);
    scene.lights[1].type = scene::LightType::spot;
    scene.lights[1].outer_cone_rad = 0.7F;
    scene.lights[1].range_m = 20.0F;
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = {0.0F, 7.0F, 0.0F};
        node.transform.rotation = glm::angleAxis(-1.5707964F, glm::vec3(1, 0, 0)); // -z becomes down
        scene.nodes.push_back(node);
    }
    finishScene(scene);
    return scene;
}

Eye panesEye()
{
    return {.position_ws = {0.0, 6.5, 0.01}, .target_ws = {0, 0, 0}};
}

ShadowOptions plainWith(Filter filter, Partition partition)
{
    ShadowOptions shadow{.technique = kPlainTechnique};
    shadow.technique.filter = filter;
    shadow.technique.partition = partition;
    shadow.map_size = 128;
    return shadow;
}

std::vector<ShadowOptions> plainWithAll()
{
    std::vector<ShadowOptions> all;
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch, Filter::vsm, Filter::lvsm,
                                Filter::esm, Filter::evsm, Filter::msm}) {
        all.push_back(plainWith(filter));
    }
    all.push_back(plainWith(Filter::pcf, Partition::cascades));
    all.push_back(plainWith(Filter::pcf, Partition::sdsm));
    return all;
}

} // namespace gnomon::host::test
