// SPDX-License-Identifier: Apache-2.0
// Gnomon's soft shadows as a technique of OpenSceneGraph's osgShadow. Copy this folder's files
// gnomon_shadow_*.h and gnomon_shadow_*.cpp into a program and link gnomon::gl and osgShadow:
//     scene->setShadowTechnique(new gnomon_osg::GnomonShadowTechnique);
// scene: an osgShadow::ShadowedScene, whose ShadowSettings say by node masks what casts and what receives.
#pragma once

#include <gnomon/device_rates.h>
#include <gnomon/options.h>

#include <osg/Program>
#include <osgShadow/ShadowTechnique>

#include <array>
#include <memory>
#include <string>

namespace gnomon_osg {

class MaskStage;
struct Shared;

/// How GnomonShadowTechnique makes shadows.
struct Settings {
    gnomon::ShadowOptions options; // of all lights; the defaults are automatic
    /// How wide directional lights are in the sky, radians, 0 .. pi/2; 0: hard shadows.
    double sun_diameter_rad = 0.00925025;
    double lamp_radius_m = 0.0; // of spot and point lights, metres, >= 0; 0: hard shadows
    /// Times by which auto weighs error: ratesOf(RateSource::software) for a software rasteriser.
    gnomon::DeviceRates rates = gnomon::ratesOf(gnomon::RateSource::gpu);
    /// The texture unit of the mask while the scene is shaded. No StateSet of the scene may use it.
    unsigned mask_unit = 7;
    /// The technique gives the scene a program that lights by gl_LightSource and gl_FrontMaterial. False: nothing is
    /// shaded but by the scene's own programs, which read visibility by kVisibilityGlsl.
    bool shades = true;
};

/// For fragment shaders of a scene (GLSL 1.30 or newer, after #version): gnomonLightCount lights, and for each of them
/// gnomonLightNumber(i), its index in gl_LightSource, and gnomonVisibility(i), 0 in shadow .. 1 in full light.
extern const char* const kVisibilityGlsl;

/// Shadows of every osg::LightSource (at most 8) in the scene and before it: directional, spot and point lights. Each
/// camera that looks at the scene has its own plan and maps; they go when the camera does.
///
/// In a frame it culls the scene, notes all drawables below it, and plans. In the draw thread, before the camera's own
/// drawing, it draws maps, a depth pre-pass and the mask. Casters are drawn by Drawable::draw() with gl_Vertex, at the
/// finest level of detail. Where a StateSet blends or tests alpha, the texture of unit 0 cuts them out; without one,
/// what blends counts if its alpha is one half or more. Vertex shaders of the scene do not move casters, billboards do
/// not turn, and clip planes do not cut.
///
/// Needs a context of OpenGL 4.5 with compatibility. Another context, or options that gnomon::gl refuses, leave the
/// scene lit: notice() and osg::notify(WARN) say why.
class GnomonShadowTechnique : public osgShadow::ShadowTechnique {
public:
    GnomonShadowTechnique();
    explicit GnomonShadowTechnique(const Settings& settings);
    GnomonShadowTechnique(const GnomonShadowTechnique& other, const osg::CopyOp& copy = osg::CopyOp::SHALLOW_COPY);
    META_Object(gnomon_osg, GnomonShadowTechnique)

        /// From the next frame on. Call it between frames.
        void setSettings(const Settings& settings);
    [[nodiscard]] const Settings& settings() const { return settings_; }
    /// Why the last frames have no shadows, as a sentence; empty: they have.
    [[nodiscard]] std::string notice() const;

    void init() override;
    void update(osg::NodeVisitor& visitor) override;
    void cull(osgUtil::CullVisitor& visitor) override;
    void cleanSceneGraph() override;
    void resizeGLObjectBuffers(unsigned int most) override;
    void releaseGLObjects(osg::State* state = nullptr) const override;

protected:
    ~GnomonShadowTechnique() override;

private:
    osg::ref_ptr<osg::StateSet> makeShading(MaskStage& stage, const osg::Viewport& viewport) const;
    bool planFrame(MaskStage& stage, osgUtil::CullVisitor& visitor); // false: nothing is seen, or nothing shines

    Settings settings_;
    std::shared_ptr<Shared> shared_;
};

} // namespace gnomon_osg
