// SPDX-License-Identifier: Apache-2.0
// Wrong calls of classic techniques, and of a renderer that has none.
#include "misuser.h"

#include <memory>

namespace gnomon::test {
namespace {

TEST(Misuse, OfFinsIsAnError)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::smoothies;
    Misuser host(options);
    expectRefused(host, "give the edges of casters to a FinDrawer", [&] { host.prepare(); });
    vulkan::FinDrawer fins(host.driver.view(), {});
    vulkan::FinPass pass;
    pass.map.commands = host.driver.commands();
    expectRefused(host, "call beginFrame() first", [&] { (void)fins.draw(pass); });
    const VkBuffer buffer = host.driver.makeBuffer();
    const vulkan::VolumeGeometry geometry{{buffer, 64}, {buffer, 64}, {buffer, 64}};
    expectRefused(host, "slot", [&] { fins.beginFrame(2, geometry, host.transforms); });
    expectRefused(host, "fill in all three", [&] { fins.beginFrame(0, {}, host.transforms); });
    fins.setScene(std::vector<vulkan::VolumeMesh>(host.transforms.size() + 1));
    expectRefused(host, "give one for each object", [&] { fins.beginFrame(0, geometry, host.transforms); });
    fins.setScene({});
    fins.beginFrame(0, geometry, host.transforms);
    expectRefused(host, "hand in passes of DrawFins", [&] { (void)fins.draw(pass); }); // of no plan
    fins.setScene({}); // for whose objects there may be too few transforms
    expectRefused(host, "call beginFrame() first", [&] { (void)fins.draw(pass); });
}

TEST(Misuse, OfVolumesWithoutACallbackIsAnError)
{
    Misuser host;
    host.plan.lights[0].volume_count = 1;
    expectRefused(host, "give the edges of casters to a VolumeDrawer", [&] { host.prepare(); });
    host.plan.lights[0].volume_count = 0;
    host.record();
}

// One technique of each kind.
TEST(Misuse, OfClassicTechniquesWithoutTheirLibraryIsAnError)
{
    Misuser host;
    host.giveIds();
    vulkan::ShadowRenderer plain(host.driver.view(), {});
    (void)plain.prepare(host.plan, kPicture);
    const auto expectNamed = [&](const ShadowOptions& options, const std::string& name) {
        const ResolvedOptions resolved = resolvedOrThrow(options);
        Plan plan = host.plan;
        plan.options = std::make_shared<const std::vector<ResolvedOptions>>(1, resolved);
        const std::string said = "draw " + name +
                                 ": it is a classic technique, and ShadowRendererOptions::classics is null; link "
                                 "gnomon::vulkan_classics and set it to makeClassics()";
        expectRefused(host, said.c_str(), [&] { (void)plain.prepare(plan, kPicture); });
        expectRefused(host, said.c_str(), [&] { plain.warmUp(resolved, {}); });
    };
    for (const Filter filter : {Filter::id, Filter::depth_id, Filter::smoothies, Filter::volumes}) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.filter = filter;
        expectNamed(options, "filter " + std::string(nameOf(filter)));
    }
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.soften = Soften::smoothies;
    expectNamed(options, "soften smoothies");
    options = {.technique = kPlainTechnique};
    options.technique.partition = Partition::paraboloid;
    expectNamed(options, "partition paraboloid");
    options = {.technique = kPlainTechnique};
    options.technique.motion = Motion::step_alternate;
    expectNamed(options, "motion step-alternate");
    expectNamed({.technique = kPlainTechnique, .faces = CasterFaces::midpoint}, "caster-faces midpoint");
    Plan stepping = host.plan; // whatever the options say
    stepping.lights[0].steps.paired = true;
    stepping.lights[0].steps.alternate = true;
    expectRefused(host, "draw motion step-alternate", [&] { (void)plain.prepare(stepping, kPicture); });
    (void)plain.prepare(host.plan, kPicture);
}

} // namespace
} // namespace gnomon::test
