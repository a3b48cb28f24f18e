// SPDX-License-Identifier: Apache-2.0
// Holds GnomonShadowTechnique to what the scene's geometry says, and OSG to what it was before. Usage: osg_check.
// Exits with 1 if something is not as it should be, with 77 where there is no display or no OpenGL 4.5.
#include "osg_views.h"

#include <gnomon/error.h>

#include <osg/MatrixTransform>
#include <osgShadow/ShadowMap>

#include <cstdio>
#include <cstring>
#include <memory>

namespace {

bool all_good = true;

void expect(bool good, const std::string& what)
{
    if (!good) {
        std::printf("NOT SO: %s\n", what.c_str());
        all_good = false;
    }
}

/// A ground with a box and a plate in the air, which shows the visibility of the first light.
struct World {
    Look look;
    osg::ref_ptr<osgShadow::ShadowedScene> scene = new osgShadow::ShadowedScene;
    osg::ref_ptr<osg::Group> models = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> plate = new osg::MatrixTransform;
    osg::ref_ptr<osg::LightSource> light;
    osg::ref_ptr<gnomon_osg::GnomonShadowTechnique> technique;

    explicit World(const std::string& options = "auto", bool shows_mask = true)
    {
        look.width = 640;
        look.height = 400;
        gnomon_osg::Settings settings;
        settings.options = parseTechnique(options);
        settings.shades = !shows_mask;
        technique = new gnomon_osg::GnomonShadowTechnique(settings);
        scene->setShadowTechnique(technique);
        scene->getShadowSettings()->setReceivesShadowTraversalMask(kReceives);
        scene->getShadowSettings()->setCastsShadowTraversalMask(kCasts);
        models->addChild(makeBox({-20, -1, -20}, {20, 0, 20}, {0.8F, 0.8F, 0.8F, 1}));
        models->addChild(makeBox({-1, 0, -1}, {1, 2, 1}, {0.8F, 0.5F, 0.5F, 1}));
        plate->addChild(makeBox({-1, -0.1F, -1}, {1, 0.1F, 1}, {0.5F, 0.8F, 0.5F, 1}));
        plate->setMatrix(osg::Matrixd::translate(3, 3, 1));
        models->addChild(plate);
        light = makeSun(look.sun);
        scene->addChild(light);
        scene->addChild(models);
        scene->getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
        scene->getStateSet()->addUniform(new osg::Uniform("base", 0));
        if (shows_mask) {
            showMask(*models);
        }
    }
    [[nodiscard]] std::unique_ptr<Offscreen> show() const
    {
        auto shown = std::make_unique<Offscreen>(scene.get(), look);
        shown->viewer().getCamera()->setClearColor({1, 1, 1, 1});
        return shown;
    }
    /// Where a ray of the light through p meets the ground.
    [[nodiscard]] osg::Vec3d below(const osg::Vec3d& p) const
    {
        const osg::Vec4 place = light->getLight()->getPosition();
        const osg::Vec3d from(place.x(), place.y(), place.z());
        const osg::Vec3d way = place.w() == 0.0F ? -from : p - from;
        return p - way * (p.y() / way.y());
    }
};

int valueAt(const osg::Image& image, const osg::Camera& camera, const osg::Vec3d& p)
{
    const osg::Vec3d seen = p * camera.getViewMatrix() * camera.getProjectionMatrix();
    const int x = int((seen.x() * 0.5 + 0.5) * image.s());
    const int y = int((seen.y() * 0.5 + 0.5) * image.t());
    return *image.data(unsigned(std::clamp(x, 0, image.s() - 1)), unsigned(std::clamp(y, 0, image.t() - 1)));
}

/// The shadows of box and plate lie where the light puts them. `eye`: the camera that sees them; null: the first.
void expectShadows(const World& world, Offscreen& shown, const std::string& when, const osg::Vec3d& plate = {3, 3, 1},
                   const osg::Camera* eye = nullptr)
{
    const osg::Camera& camera = eye != nullptr ? *eye : *shown.viewer().getCamera();
    const osg::ref_ptr<osg::Image> mask = shown.picture(&camera);
    const auto visibility = [&](const osg::Vec3d& p) {
        return valueAt(*mask, camera, world.below(p));
    };
    expect(world.technique->notice().empty(), when + ": " + world.technique->notice());
    expect(visibility(plate) < 3, when + ", below the plate: " + std::to_string(visibility(plate)));
    expect(visibility({0.5, 1.5, 0.5}) < 3, when + ", behind the box");
    expect(visibility(plate + osg::Vec3d(1.6, 0, 0)) > 252, when + ", beside the plate's shadow");
    expect(visibility({-4, 0, 3}) > 252, when + ", on open ground");
    expect(shown.errors() == 0, when + ": errors of OpenGL");
}

bool same(const osg::Image& a, const osg::Image& b)
{
    return a.getTotalSizeInBytes() == b.getTotalSizeInBytes() &&
           std::memcmp(a.data(), b.data(), a.getTotalSizeInBytes()) == 0;
}

void checkTechniques()
{
    for (const char* options :
         {"auto", "hard", "pcf+cascades", "evsm", "msm+soften=blur", "pcf+tsm", "hard+map-format=r32f"}) {
        const World world(options);
        const auto shown = world.show();
        expectShadows(world, *shown, options);
    }
}

void checkLamps()
{
    for (const bool is_spot : {true, false}) {
        const World world;
        osg::Light& light = *world.light->getLight();
        light.setPosition({-4.0F, 9.0F, 5.0F, 1.0F});
        osg::Vec3 way = osg::Vec3(1.0F, 1.0F, 0.5F) - osg::Vec3(-4.0F, 9.0F, 5.0F);
        way.normalize();
        light.setDirection(way);
        light.setSpotCutoff(is_spot ? 50.0F : 180.0F);
        const auto shown = world.show();
        expectShadows(world, *shown, is_spot ? "a spot" : "a point light");
    }
}

/// Things come, move and go while a view is shown, resized and made again.
void checkChanges()
{
    const World world;
    auto shown = world.show();
    expectShadows(world, *shown, "at first");
    for (int i = 0; i < 50; ++i) {
        world.plate->setMatrix(osg::Matrixd::translate(3, 3, 1.0 + 0.12 * i));
        shown->frame();
    }
    expectShadows(world, *shown, "after 50 frames in motion", {3, 3, 1.0 + 0.12 * 49});
    world.plate->setMatrix(osg::Matrixd::translate(3, 3, 1));
    shown->resize(0, 0, 501, 333);
    expectShadows(world, *shown, "smaller");
    shown->resize(101, 53, 502, 301);
    expectShadows(world, *shown, "in a corner");
    const osg::ref_ptr<osg::Node> more = makeBox({-6, 0, 2}, {-5, 3, 3}, {1, 1, 1, 1});
    const auto lit = [&](const osg::Vec3d& p) {
        return valueAt(*shown->picture(), *shown->viewer().getCamera(), world.below(p)) > 252;
    };
    const osg::Vec3d top(-5.3, 2.5, 2.3);
    expect(lit(top), "lit before a box comes");
    world.models->addChild(more);
    expect(!lit(top), "a box that comes casts");
    more->setNodeMask(kReceives);
    expect(lit(top), "a box without the casters' bit does not");
    more->setNodeMask(~0U);
    expect(!lit(top), "and does again");
    world.models->removeChild(more);
    expect(lit(top), "a box that goes leaves no shadow");
    const auto second = world.show(); // a context of its own
    expectShadows(world, *second, "another view");
    expectShadows(world, *shown, "the first beside it");
    shown = world.show(); // the first is gone
    expectShadows(world, *shown, "a view made again");
    expectShadows(world, *second, "the other beside it");
}

/// Two cameras in one context, each with its own plan, and frames that are drawn in a thread of their own.
void checkTwoCameras()
{
    const World world;
    const auto shown = world.show();
    shown->resize(0, 0, 640, 200);
    const osg::Camera& second = shown->addCamera(0, 200, 640, 200, osg::Matrixd::rotate(0.1, 0, 1, 0));
    shown->viewer().setThreadingModel(osgViewer::Viewer::DrawThreadPerContext);
    for (int i = 0; i < 10; ++i) {
        world.plate->setMatrix(osg::Matrixd::translate(3.0 - 0.05 * i, 3, 1));
        shown->frame();
    }
    shown->viewer().setThreadingModel(osgViewer::Viewer::SingleThreaded);
    expectShadows(world, *shown, "the first of two cameras", {2.55, 3, 1});
    expectShadows(world, *shown, "the second of two cameras", {2.55, 3, 1}, &second);
}

void checkReceivers()
{
    const World world;
    const osg::ref_ptr<osg::Node> deaf = makeBox({2, 0, 0}, {4, 0.5F, 2}, {1, 1, 1, 1});
    world.models->addChild(deaf);
    const auto shown = world.show();
    const osg::Vec3d way = world.below({3, 3, 1}) - osg::Vec3d(3, 3, 1);
    const osg::Vec3d on_top = osg::Vec3d(3, 3, 1) + way * (2.5 / 3.0);
    const osg::Vec3d inside(std::clamp(on_top.x(), 2.1, 3.9), 0.5, std::clamp(on_top.z(), 0.1, 1.9));
    const auto visibility = [&] {
        return valueAt(*shown->picture(), *shown->viewer().getCamera(), inside);
    };
    world.plate->setMatrix(osg::Matrixd::translate(inside - way * (2.5 / 3.0)));
    expect(visibility() < 3, "a box that receives is in shadow");
    deaf->setNodeMask(kCasts);
    expect(visibility() > 252, "a box without the receivers' bit is lit");
}

/// OSG draws as before once the technique is gone, its own techniques too.
void checkStates()
{
    const World world("auto", false);
    world.models->addChild(makeModel()); // textured and blended things among them
    const auto shown = world.show();
    for (const char* name : {"none", "shadowmap"}) {
        const osg::ref_ptr<osgShadow::ShadowTechnique> own = makeOwnTechnique(name, *world.light, 1024, false);
        world.scene->setShadowTechnique(own);
        shown->frame();
        const osg::ref_ptr<osg::Image> before = shown->picture();
        world.scene->setShadowTechnique(world.technique);
        shown->frame();
        const osg::ref_ptr<osg::Image> between = shown->picture();
        world.scene->setShadowTechnique(own);
        const osg::ref_ptr<osg::Image> after = shown->picture();
        expect(!same(*before, *between), std::string(name) + ": Gnomon's shadows are seen");
        expect(same(*before, *after), std::string(name) + ": the picture is as before");
        expect(shown->errors() == 0, std::string(name) + ": errors of OpenGL");
    }
}

void checkRefusal()
{
    const World world("pcf+sdsm");
    const auto shown = world.show();
    const int visibility = valueAt(*shown->picture(), *shown->viewer().getCamera(), world.below({3, 3, 1}));
    expect(visibility > 252, "what is refused leaves the scene lit");
    expect(world.technique->notice().find("sdsm") != std::string::npos, "and says why: " + world.technique->notice());
}

int run()
{
    const World world;
    std::unique_ptr<Offscreen> shown;
    try {
        shown = world.show();
    } catch (const gnomon::Error& error) {
        std::printf("%s\n", error.what());
        return 77;
    }
    shown->frame();
    if (world.technique->notice().find("the context") != std::string::npos) {
        std::printf("%s\n", world.technique->notice().c_str());
        return 77;
    }
    checkTechniques();
    checkLamps();
    checkChanges();
    checkTwoCameras();
    checkReceivers();
    checkStates();
    checkRefusal();
    std::printf("%s, drawn by %s\n", all_good ? "all as it should be" : "not all as it should be",
                shown->renderer().c_str());
    return all_good ? 0 : 1;
}

} // namespace

int main()
{
    try {
        return run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "osg_check: %s\n", error.what());
        return 1;
    }
}
