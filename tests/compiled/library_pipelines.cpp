// SPDX-License-Identifier: Apache-2.0
#include "library_pipelines.h"

#include "null_driver.h"
#include "option_steps.h"

#include <gnomon/vulkan/caster_drawer.h>
#include <gnomon/vulkan/classics.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::compiled {
namespace {

using vulkan::CasterBatch;
using vulkan::CasterDrawer;
using vulkan::ShadowRenderer;

/// Each filter, for any number of lights.
constexpr const char* kFilters[] = {"filter=hard", "filter=pcf",     "filter=pcss",     "filter=raymarch",
                                    "filter=vsm",  "filter=lvsm",    "filter=esm",      "filter=evsm",
                                    "filter=msm",  "filter=volumes", "filter=smoothies"};
constexpr const char* kFiltersOfIds[] = {"filter=id", "filter=depth-id"}; // and of one light, for the rest is the same
/// Pipelines that other choices add, for one light; for several lights they differ as those of kFilters do.
constexpr const char* kFurther[] = {"filter=pcf pcf.kernel=2x2",
                                    "filter=pcf pcf.kernel=7x7",
                                    "filter=pcf pcf.kernel=vogel",
                                    "filter=pcf pcf.kernel=3x3-box",
                                    "filter=pcf bias.constant=1",
                                    "filter=pcf map-format=d16",
                                    "filter=pcf map-format=r32f",
                                    "filter=hard partition=cascades",
                                    "filter=pcf partition=cascades cascades.pass=layered",
                                    "filter=raymarch partition=cascades",
                                    "filter=pcf partition=cascades cascades.pass=layered map-format=r32f",
                                    "filter=pcf partition=sdsm cascades.pass=layered",
                                    "filter=pcf partition=sdsm cascades.pass=layered map-format=r32f",
                                    "filter=id partition=sdsm",
                                    "filter=smoothies partition=sdsm",
                                    "filter=raymarch partition=cube",
                                    "filter=pcf partition=paraboloid",
                                    "filter=hard partition=paraboloid map-format=r32f",
                                    "filter=raymarch partition=multi",
                                    "filter=raymarch partition=virtual",
                                    "filter=pcf motion=snap keep-still=always",
                                    "filter=pcf motion=step-blend map-format=rg16 keep-still=always",
                                    "filter=pcf motion=step-alternate",
                                    "filter=pcf soften=blur",
                                    "filter=pcf soften=blur soften.edges=plain",
                                    "filter=pcf soften=blur soften.kernel=poisson soften.size=half",
                                    "filter=pcf soften=smoothies",
                                    "filter=pcf soften=converge",
                                    "filter=raymarch soften=converge",
                                    "filter=raymarch mask-size=half",
                                    "filter=pcf translucent=colour",
                                    "filter=pcf translucent=colour partition=paraboloid",
                                    "filter=pcf caster-faces=back",
                                    "filter=pcf caster-faces=midpoint",
                                    "filter=id id.of=face",
                                    "filter=vsm msaa=1",
                                    "filter=vsm msaa=1 blur=none",
                                    "filter=vsm blur.path=fragment",
                                    "filter=vsm blur.path=fragment msaa=1",
                                    "filter=evsm blur.path=fragment msaa=1",
                                    "filter=vsm map-sampling=trilinear",
                                    "filter=vsm map-sampling=anisotropic",
                                    "filter=vsm penumbra=light",
                                    "filter=msm penumbra=light",
                                    "filter=lvsm lvsm.placement=lloyd msaa=1",
                                    "filter=lvsm lvsm.placement=lloyd",
                                    "filter=lvsm lvsm.placement=gaps msaa=1"};

std::vector<CasterBatch> batches(VkDescriptorSet texture)
{
    std::vector<CasterBatch> all(7);
    all[1].texture = texture;
    all[2].clip_planes[0] = {1.0F, 0.0F, 0.0F, 0.5F};
    all[3] = all[2];
    all[3].texture = texture;
    all[4].texture = texture;
    all[4].blended = true;
    all[5].texture = texture;
    all[5].vertex_colours = true;
    all[6] = all[5];
    all[6].blended = true;
    return all;
}

void warmUp(const vulkan::DeviceView& view, VkDescriptorSet texture, const char* line, const vulkan::WarmUp& what)
{
    const std::string sized = line + std::string(" map-size=64");
    const ResolvedOptions options = resolvedOrThrow(test::optionsFrom(sized));
    const vulkan::ClassicCallbacks none{.fins = [](const vulkan::FinPass&) {},
                                        .volumes =
                                            [](const vulkan::VolumePass&) {
                                            }};
    ShadowRenderer renderer(view, {.classics = vulkan::makeClassics(none)});
    renderer.warmUp(options, what);
    if (options.hasMaps()) {
        CasterDrawer drawer(
            view, {.vertices = {.colour = {VK_FORMAT_R8G8B8A8_UNORM, 4, 0}, .piece = {VK_FORMAT_R32_UINT, 4, 0}}});
        drawer.setScene({}, {}, batches(texture));
        drawer.warmUp(options, what.perspective);
    }
}

/// Its pipelines are made when it draws.
void drawVolumes(const vulkan::DeviceView& view, test::NullDriver& driver)
{
    vulkan::VolumeDrawer drawer(view, {});
    const vulkan::BufferRef buffer{driver.makeBuffer(), 64};
    drawer.beginFrame(0, {buffer, buffer, buffer}, {});
    vulkan::VolumePass pass;
    pass.commands = driver.commands();
    pass.colour = VK_FORMAT_R8_UNORM;
    (void)drawer.draw(pass);
}

} // namespace

void makeLibraryPipelines(const vulkan::DeviceView& view, test::NullDriver& driver)
{
    const auto texture = reinterpret_cast<VkDescriptorSet>(driver.makeBuffer()); // nobody looks at it
    for (const char* line : kFilters) {
        warmUp(view, texture, line, {.inputs = {.normals = true}});
    }
    for (const char* line : kFiltersOfIds) {
        warmUp(view, texture, line, {.inputs = {.normals = true, .ids = true}, .several_lights = false});
    }
    for (const char* line : kFurther) {
        const bool ids = std::string_view(line).starts_with("filter=id");
        warmUp(view, texture, line, {.inputs = {.normals = true, .ids = ids}, .several_lights = false});
    }
    warmUp(view, texture, "filter=volumes", {.inputs = {.normals = true, .ids = true}, .several_lights = false});
    warmUp(view, texture, "filter=pcf", {.several_lights = false}); // normals from depth
    drawVolumes(view, driver);
    const vulkan::FinDrawer fins(view, {});
}

} // namespace gnomon::compiled
