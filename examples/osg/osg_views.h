// SPDX-License-Identifier: Apache-2.0
// The pictures of gnomon_osg and of its check: a scene under lights, in a viewer without a window, with any technique.
#pragma once

#include "gnomon_shadow_technique.h"

#include <osg/LightSource>
#include <osgShadow/ShadowedScene>
#include <osgViewer/Viewer>

#include <string>
#include <string_view>

/// Node masks of the scene.
constexpr unsigned kReceives = 1;
constexpr unsigned kCasts = 2;

/// The thing that is looked at, and how.
struct Look {
    osg::Vec3d eye{6.0, 8.0, 12.0};
    osg::Vec3d target{0.0, 0.5, 0.0};
    double fov_deg = 45.0;
    osg::Vec3d sun{0.6, -1.0, -0.35}; // the way its light travels
    int width = 1280;
    int height = 720;
    int map_size = 2048; // of OSG's own techniques
};

/// Gnomon's options of a text such as "pcf", "evsm+cascades" or "auto+map-size=1024": values of choices, and keys of
/// gnomon/option_table.h. Throws gnomon::Error with the word that is neither.
gnomon::ShadowOptions parseTechnique(std::string_view text);

/// A model from a file, as it stands there. Throws gnomon::Error where OSG cannot read it.
osg::ref_ptr<osg::Node> readModel(const std::string& file);
/// A ground with boxes, a ball and a cut-out sheet on it.
osg::ref_ptr<osg::Node> makeModel();
/// A box between two corners.
osg::ref_ptr<osg::Node> makeBox(const osg::Vec3& low, const osg::Vec3& high, const osg::Vec4& colour);
/// A parallel light that travels this way.
osg::ref_ptr<osg::LightSource> makeSun(const osg::Vec3d& travels);

/// One of OSG's own techniques, shadowmap, lispsm or pssm, and null for none. `shows_mask`: the picture is the
/// visibility (not pssm). Throws gnomon::Error for another name.
osg::ref_ptr<osgShadow::ShadowTechnique> makeOwnTechnique(const std::string& name, osg::LightSource& sun, int map_size,
                                                          bool shows_mask);
/// Has every surface below the node show the visibility of the first light instead of its own colours, by a technique
/// of Gnomon that does not shade.
void showMask(osg::Node& node);

/// A viewer with a picture that nobody sees, of all frames but one unread.
class Offscreen {
public:
    /// Throws gnomon::Error without a display.
    Offscreen(osg::Node* scene, const Look& look);
    ~Offscreen();
    /// Draws a frame, and waits for it. Milliseconds.
    double frame();
    /// Draws a frame and reads what a camera shows; null: the first one. Row 0 is the lowest.
    osg::ref_ptr<osg::Image> picture(const osg::Camera* camera = nullptr);
    /// A second camera in the same context, that looks as the first one does, turned.
    osg::Camera& addCamera(int x, int y, int width, int height, const osg::Matrixd& turn);
    [[nodiscard]] osgViewer::Viewer& viewer() { return viewer_; }
    /// GL_RENDERER, after a frame.
    [[nodiscard]] const std::string& renderer() const;
    /// Errors of OpenGL after frames so far.
    [[nodiscard]] int errors() const;
    /// Another part of the first size, from its lower left corner, as when a window is resized or divided.
    void resize(int x, int y, int width, int height);

private:
    struct Finish;
    osgViewer::Viewer viewer_;
    osg::ref_ptr<Finish> finish_;
};
