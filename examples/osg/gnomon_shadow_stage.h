// SPDX-License-Identifier: Apache-2.0
// The part of GnomonShadowTechnique that draws, by gnomon::gl in OSG's draw thread: maps, the depth pre-pass and the
// mask.
#pragma once

#include "gnomon_shadow_casters.h"

#include <gnomon/gl/shadow_renderer.h>
#include <gnomon/planner.h>

#include <osg/GLExtensions>
#include <osg/Program>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <osg/observer_ptr>
#include <osgUtil/RenderStage>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace gnomon_osg {

constexpr unsigned kMostLights = 8; // as many as gl_LightSource has
/// Variants of the casters' program, added: cut out; writes the metric as depth, at each sample, or as a colour; writes
/// whether it receives.
constexpr unsigned kMasked = 1, kMetric = 2, kSamples = 4, kColour = 8, kIds = 16, kVariants = 32;

osg::ref_ptr<osg::Program> makeProgram(const std::string& vertex, const std::string& fragment);

/// The things of one view in one context. Made and deleted where that context is current.
struct Drawn {
    std::unique_ptr<gnomon::gl::ShadowRenderer> renderer;
    GLuint framebuffer = 0;
    GLuint depth = 0;
    GLuint ids = 0; // R32UI, 0 at what takes no shadow; made where such a thing is
    glm::uvec2 size_px{0};

    Drawn() = default;
    ~Drawn() { (void)renderer.release(); } // release() was not called: its context is gone, with all that was in it
    Drawn(const Drawn&) = delete;
    Drawn& operator=(const Drawn&) = delete;
    void setSize(const osg::GLExtensions& gl, glm::uvec2 size, bool with_ids);
    void release(const osg::GLExtensions& gl);

private:
    void deletePicture(const osg::GLExtensions& gl);
};

/// One camera that looks at the scene.
struct View {
    osg::observer_ptr<osg::Camera> camera;
    gnomon::Planner planner;
    std::map<unsigned, std::shared_ptr<Drawn>> drawn; // by context
};

/// The things that the technique and its frames in flight share.
struct Shared {
    std::mutex mutex; // of all below; culls and draws may be in threads of their own
    CasterScene scene;
    unsigned frame = ~0U; // of the scene
    std::map<const osg::Camera*, View> views;
    std::multimap<unsigned, std::shared_ptr<Drawn>> gone; // by context: to be deleted there
    std::set<unsigned> refused;                           // contexts that cannot draw shadows
    std::string notice;
    std::array<osg::ref_ptr<osg::Program>, kVariants> caster_programs;
    osg::ref_ptr<osg::Program> shade_program;
    osg::ref_ptr<osg::Texture2D> white; // of what has no texture

    Shared();
    /// The view of a camera. Those of cameras that are gone are dropped.
    View& viewOf(osg::Camera& camera, const gnomon::ShadowOptions& options);
    /// Deletes the things of this context, at once where it is current; null: those of all contexts.
    void releaseDrawn(osg::State* state);
    /// Has what the view has drawn deleted.
    void drop(View& view);
    /// Why there are no shadows; empty: there are.
    void setNotice(const std::string& text);
};

/// Binds the mask that a stage has drawn in the same frame.
class MaskTexture : public osg::StateAttribute {
public:
    MaskTexture() = default;
    MaskTexture(const MaskTexture& other, const osg::CopyOp& copy) : StateAttribute(other, copy), name(other.name) {}
    META_StateAttribute(gnomon_osg, MaskTexture, TEXTURE) int compare(const StateAttribute& other) const override
    {
        return this < &other ? -1 : this > &other ? 1 : 0;
    }
    bool isTextureAttribute() const override { return true; }
    void apply(osg::State&) const override { glBindTexture(GL_TEXTURE_2D_ARRAY, name); }

    GLuint name = 0;
};

/// Draws maps and mask of one view in one frame, before the stage that shades by them.
class MaskStage : public osgUtil::RenderStage {
public:
    explicit MaskStage(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {}
    void draw(osg::RenderInfo& info, osgUtil::RenderLeaf*& previous) override;

    const osg::Camera* camera = nullptr; // the view's name
    unsigned traversal_mask = ~0U;
    std::shared_ptr<const Casters> casters;
    gnomon::Plan plan;
    osg::ref_ptr<MaskTexture> mask = new MaskTexture;
    osg::ref_ptr<osg::Uniform> lights = new osg::Uniform(osg::Uniform::FLOAT_VEC3, "gnomonLights", kMostLights);
    osg::ref_ptr<osg::Uniform> light_count = new osg::Uniform("gnomonLightCount", 0);

private:
    std::shared_ptr<Drawn> findDrawn(unsigned context, const osg::GLExtensions& gl);
    void drawAll(osg::RenderInfo& info, const osg::GLExtensions& gl, Drawn& drawn);
    void drawMap(osg::RenderInfo& info, const osg::GLExtensions& gl, const gnomon::gl::MapPass& pass);
    void drawPicture(osg::RenderInfo& info, const osg::GLExtensions& gl, unsigned variant);
    void beginCasters(osg::RenderInfo& info, const osg::GLExtensions& gl);
    void drawCaster(osg::RenderInfo& info, const osg::GLExtensions& gl, const Caster& caster,
                    const std::array<glm::vec4, 5>& rows, unsigned variant);

    std::shared_ptr<Shared> shared_;
    const osg::Program* program_ = nullptr;
};

} // namespace gnomon_osg
