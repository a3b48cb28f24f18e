// SPDX-License-Identifier: Apache-2.0
// A model in OpenSceneGraph under a sun, with Gnomon's shadows or OSG's own. Usage: gnomon_osg [OPTION ...] [MODEL].
#include "osg_views.h"

#include <gnomon/error.h>

#include <osg/ArgumentParser>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgGA/StateSetManipulator>
#include <osgGA/TrackballManipulator>
#include <osgViewer/ViewerEventHandlers>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <memory>
#include <sstream>
#include <vector>

namespace {

constexpr const char* kUsage = R"(usage: gnomon_osg [OPTION ...] [MODEL]
MODEL: a file that OSG reads; without one, boxes on a ground.
  --technique LIST    Gnomon's, with commas between: auto, hard, pcf, evsm+cascades, ... (auto)
  --compare LIST      also OSG's own: none, shadowmap, lispsm, pssm; the first of both lists is shown
  --map-size N        texels on a side of maps (Gnomon: chosen; OSG: 2048)
  --light-size DEG    how wide the sun is in the sky (0.53)
  --software          auto by the times of a software rasteriser
  --eye, --target, --sun X,Y,Z   --fov DEG   --size WxH
  --screenshot FILE   writes a picture instead of opening a window
  --mask FILE         writes the visibility, 0 in shadow
  --truth FILE        prints the rmse of each technique's visibility against this picture of it
  --counted FILE      ... at pixels that are white here
  --time N            prints each technique's time in N rounds that take turns, nothing in motion
Without a display run it by xvfb-run.
)";

struct Options {
    Look look;
    gnomon_osg::Settings settings;
    std::vector<std::string> techniques; // Gnomon's
    std::vector<std::string> own;        // OSG's
    std::string model, map_size, screenshot, mask, truth, counted;
    int rounds = 0;
};

std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> words;
    std::istringstream in(text);
    for (std::string word; std::getline(in, word, ',');) {
        words.push_back(word);
    }
    return words;
}

osg::Vec3d parsePoint(const std::string& text)
{
    osg::Vec3d p;
    if (std::sscanf(text.c_str(), "%lf,%lf,%lf", &p[0], &p[1], &p[2]) != 3) {
        throw gnomon::Error("read '" + text + "'", "it is not X,Y,Z");
    }
    return p;
}

Options parse(osg::ArgumentParser& arguments)
{
    Options options;
    std::string text;
    while (arguments.read("--technique", text)) {
        options.techniques = split(text);
    }
    while (arguments.read("--compare", text)) {
        options.own = split(text);
    }
    if (options.techniques.empty() && options.own.empty()) {
        options.techniques = {"auto"};
    }
    const auto point = [&](const char* name, osg::Vec3d& value) {
        while (arguments.read(name, text)) {
            value = parsePoint(text);
        }
    };
    point("--eye", options.look.eye);
    point("--target", options.look.target);
    point("--sun", options.look.sun);
    while (arguments.read("--fov", options.look.fov_deg)) {
    }
    while (arguments.read("--size", text)) {
        if (std::sscanf(text.c_str(), "%dx%d", &options.look.width, &options.look.height) != 2) {
            throw gnomon::Error("read '" + text + "'", "it is not WIDTHxHEIGHT");
        }
    }
    while (arguments.read("--map-size", options.map_size)) {
        options.look.map_size = std::atoi(options.map_size.c_str());
    }
    double degrees = 0.0;
    while (arguments.read("--light-size", degrees)) {
        options.settings.sun_diameter_rad = osg::DegreesToRadians(degrees);
    }
    while (arguments.read("--software")) {
        options.settings.rates = gnomon::ratesOf(gnomon::RateSource::software);
    }
    for (auto [name, value] : {std::pair{"--screenshot", &options.screenshot},
                               {"--mask", &options.mask},
                               {"--truth", &options.truth},
                               {"--counted", &options.counted}}) {
        while (arguments.read(name, *value)) {
        }
    }
    while (arguments.read("--time", options.rounds)) {
    }
    for (int i = 1; i < arguments.argc(); ++i) {
        if (arguments.isOption(i)) {
            throw gnomon::Error("read the options", std::string(arguments[i]) + " is unknown", "see --help");
        }
        options.model = arguments[i];
    }
    return options;
}

/// A scene with one technique.
struct Shown {
    std::string name;
    osg::ref_ptr<osgShadow::ShadowedScene> scene;
    osg::ref_ptr<gnomon_osg::GnomonShadowTechnique> technique; // null: OSG's own, or none
};

Shown makeShown(const Options& options, osg::Node& model, const std::string& name, bool is_own, bool shows_mask)
{
    Shown shown{name, new osgShadow::ShadowedScene, nullptr};
    osgShadow::ShadowSettings& settings = *new osgShadow::ShadowSettings;
    settings.setReceivesShadowTraversalMask(kReceives);
    settings.setCastsShadowTraversalMask(kCasts);
    shown.scene->setShadowSettings(&settings);
    osg::ref_ptr<osg::Group> models = new osg::Group;
    models->addChild(&model);
    models->setNodeMask(kReceives | kCasts);
    osg::ref_ptr<osg::LightSource> sun = makeSun(options.look.sun);
    if (is_own) {
        shown.scene->setShadowTechnique(makeOwnTechnique(name, *sun, options.look.map_size, shows_mask));
    } else {
        gnomon_osg::Settings own = options.settings;
        own.options = parseTechnique(name + (options.map_size.empty() ? "" : "+map-size=" + options.map_size));
        own.shades = !shows_mask;
        shown.technique = new gnomon_osg::GnomonShadowTechnique(own);
        shown.scene->setShadowTechnique(shown.technique);
    }
    osg::StateSet& set = *shown.scene->getOrCreateStateSet();
    for (const GLenum mode : {GL_LIGHTING, GL_LIGHT0, GL_NORMALIZE}) {
        set.setMode(mode, osg::StateAttribute::ON);
    }
    if (shows_mask) {
        set.setMode(GL_BLEND, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
        set.addUniform(new osg::Uniform("base", 0));
        set.addUniform(new osg::Uniform("size", osg::Vec2(float(options.look.width), float(options.look.height))));
        if (shown.technique.valid()) {
            showMask(*models);
        }
    }
    shown.scene->addChild(sun);
    shown.scene->addChild(models);
    return shown;
}

std::vector<Shown> makeAll(const Options& options, osg::Node& model, bool shows_mask)
{
    std::vector<Shown> all;
    for (const std::string& name : options.techniques) {
        all.push_back(makeShown(options, model, name, false, shows_mask));
    }
    for (const std::string& name : options.own) {
        all.push_back(makeShown(options, model, name, true, shows_mask));
    }
    return all;
}

osg::ref_ptr<osg::Image> maskOf(const Options& options, const Shown& shown)
{
    Offscreen offscreen(shown.scene.get(), options.look);
    offscreen.viewer().getCamera()->setClearColor({1.0F, 1.0F, 1.0F, 1.0F});
    offscreen.frame();
    osg::ref_ptr<osg::Image> image = offscreen.picture();
    if (shown.technique.valid() && !shown.technique->notice().empty()) {
        throw gnomon::Error("draw shadows by " + shown.name, shown.technique->notice());
    }
    return image;
}

void write(const osg::Image& image, const std::string& file)
{
    if (!osgDB::writeImageFile(image, file)) {
        throw gnomon::Error("write " + file, "OSG cannot", "choose another folder or ending");
    }
}

osg::ref_ptr<osg::Image> readImage(const std::string& file, const Look& look)
{
    osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(file);
    if (!image || image->s() != look.width || image->t() != look.height) {
        throw gnomon::Error("read " + file, "it is no picture of this size");
    }
    return image;
}

void printErrors(const Options& options, osg::Node& model)
{
    const osg::ref_ptr<osg::Image> truth = readImage(options.truth, options.look);
    const osg::ref_ptr<osg::Image> counted =
        options.counted.empty() ? nullptr : readImage(options.counted, options.look);
    for (const Shown& shown : makeAll(options, model, true)) {
        const osg::ref_ptr<osg::Image> mask = maskOf(options, shown);
        double squares = 0.0;
        double sum = 0.0;
        long count = 0;
        for (int y = 0; y < mask->t(); ++y) {
            for (int x = 0; x < mask->s(); ++x) {
                if (!counted || counted->getColor(unsigned(x), unsigned(y)).r() > 0.5F) {
                    const double error =
                        mask->getColor(unsigned(x), unsigned(y)).r() - truth->getColor(unsigned(x), unsigned(y)).r();
                    squares += error * error;
                    sum += error;
                    ++count;
                }
            }
        }
        std::printf("%-28s rmse %.4f, mean error %+.4f\n", shown.name.c_str(), std::sqrt(squares / double(count)),
                    sum / double(count));
    }
}

void printTimes(const Options& options, osg::Node& model)
{
    constexpr int kFrames = 5;
    std::vector<Shown> all = makeAll(options, model, false);
    std::vector<std::unique_ptr<Offscreen>> viewers;
    for (const Shown& shown : all) {
        viewers.push_back(std::make_unique<Offscreen>(shown.scene.get(), options.look));
        for (int i = 0; i < kFrames; ++i) {
            viewers.back()->frame(); // compiles
        }
    }
    std::vector<std::vector<double>> times(all.size());
    std::vector<std::vector<double>> work(all.size()); // of all threads, which other programs do not lengthen
    for (int round = 0; round < options.rounds; ++round) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (int k = 0; k < kFrames; ++k) {
                const std::clock_t start = std::clock();
                const double time_ms = viewers[i]->frame();
                if (k > 0) { // the first comes from another context
                    times[i].push_back(time_ms);
                    work[i].push_back(double(std::clock() - start) * 1000.0 / CLOCKS_PER_SEC);
                }
            }
        }
    }
    std::printf("a frame by %s, medians (quartiles) of %d: ms of time, ms of all processors\n",
                viewers.front()->renderer().c_str(), options.rounds * (kFrames - 1));
    const auto print = [](std::vector<double>& values) {
        std::ranges::sort(values);
        const auto at = [&](double share) {
            return values[std::size_t(share * double(values.size() - 1))];
        };
        std::printf("  %7.1f (%.1f to %.1f)", at(0.5), at(0.25), at(0.75));
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::printf("%-24s", all[i].name.c_str());
        print(times[i]);
        print(work[i]);
        std::printf("\n");
    }
}

int openWindow(const Options& options, const Shown& shown)
{
    osgViewer::Viewer viewer;
    viewer.setSceneData(shown.scene.get());
    viewer.setLightingMode(osg::View::NO_LIGHT);
    viewer.setUpViewInWindow(50, 50, options.look.width, options.look.height);
    osg::ref_ptr<osgGA::TrackballManipulator> hand = new osgGA::TrackballManipulator;
    hand->setHomePosition(options.look.eye, options.look.target, {0.0, 1.0, 0.0});
    viewer.setCameraManipulator(hand);
    viewer.addEventHandler(new osgViewer::StatsHandler);
    viewer.addEventHandler(new osgViewer::WindowSizeHandler);
    viewer.addEventHandler(new osgGA::StateSetManipulator(viewer.getCamera()->getOrCreateStateSet()));
    return viewer.run();
}

int run(const Options& options)
{
    const osg::ref_ptr<osg::Node> model = options.model.empty() ? makeModel() : readModel(options.model);
    if (!options.mask.empty()) {
        write(*maskOf(options, makeAll(options, *model, true).front()), options.mask);
    }
    if (!options.screenshot.empty()) {
        Offscreen offscreen(makeAll(options, *model, false).front().scene.get(), options.look);
        offscreen.frame();
        write(*offscreen.picture(), options.screenshot);
    }
    if (!options.truth.empty()) {
        printErrors(options, *model);
    }
    if (options.rounds > 0) {
        printTimes(options, *model);
    }
    const bool all_done =
        !options.mask.empty() || !options.screenshot.empty() || !options.truth.empty() || options.rounds > 0;
    return all_done ? 0 : openWindow(options, makeAll(options, *model, false).front());
}

} // namespace

int main(int argc, char** argv)
{
    osg::ArgumentParser arguments(&argc, argv);
    if (arguments.read("--help")) {
        std::fputs(kUsage, stdout);
        return 0;
    }
    try {
        return run(parse(arguments));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon_osg: %s\n", error.what());
        return 1;
    }
}
