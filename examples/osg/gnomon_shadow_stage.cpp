// SPDX-License-Identifier: Apache-2.0
#include "gnomon_shadow_stage.h"

#include <gnomon/error.h>
#include <gnomon/pack/caster_rows.h>

#include <osg/ClipControl>
#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/Notify>
#include <osg/PolygonMode>
#include <osg/StateSet>

namespace gnomon_osg {
namespace {

// Rows take an object's own points to clip space and to the map's metric (gnomon::pack::CasterRows).
constexpr const char* kCasterVertex = R"(
layout(location = 0) uniform vec4 rows[5];
#ifdef SAMPLES
sample
#endif
out float metric;
out vec2 uv;
void main()
{
    vec4 p = gl_Vertex;
    metric = dot(rows[4], p);
    uv = gl_MultiTexCoord0.xy;
    gl_Position = vec4(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p), dot(rows[3], p));
})";
constexpr const char* kCasterFragment = R"(
layout(location = 5) uniform vec2 cut; // the factor of alpha, and where it is cut
layout(binding = 0) uniform sampler2D base;
#ifdef SAMPLES
sample
#endif
in float metric;
in vec2 uv;
#ifdef COLOUR
layout(location = 0) out vec4 texel;
#endif
#ifdef IDS
layout(location = 6) uniform uint receives;
layout(location = 0) out uint id;
#endif
void main()
{
#ifdef MASKED
    if (texture(base, uv).a * cut.x < cut.y) discard;
#endif
#ifdef METRIC
    gl_FragDepth = clamp(metric, 0.0, 1.0);
#endif
#ifdef COLOUR
    texel = vec4(clamp(metric, 0.0, 1.0));
#endif
#ifdef IDS
    id = receives;
#endif
})";
osg::ref_ptr<osg::Program> makeCasterProgram(unsigned variant)
{
    std::string head = "#version 430 compatibility\n";
    constexpr std::array<const char*, 5> kNames{"MASKED", "METRIC", "SAMPLES", "COLOUR", "IDS"};
    for (unsigned i = 0; i < kNames.size(); ++i) {
        head += (variant >> i & 1U) != 0 ? std::string("#define ") + kNames[i] + "\n" : "";
    }
    return makeProgram(head + kCasterVertex, head + kCasterFragment);
}

/// Depth reversed, 1 near: as precise as a float can be. Nothing of the scene's own state has a say.
osg::StateSet& passState()
{
    static const osg::ref_ptr<osg::StateSet> kState = [] {
        osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
        constexpr auto kAlways = osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED;
        set->setAttributeAndModes(new osg::Depth(osg::Depth::GREATER, 0.0, 1.0, true),
                                  osg::StateAttribute::ON | kAlways);
        set->setAttribute(new osg::ClipControl(osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE), kAlways);
        set->setAttribute(new osg::ColorMask, kAlways);
        set->setAttribute(new osg::PolygonMode, kAlways);
        for (const GLenum mode :
             {GL_ALPHA_TEST, GL_BLEND, GL_CULL_FACE, GL_POLYGON_STIPPLE, GL_SCISSOR_TEST, GL_STENCIL_TEST}) {
            set->setMode(mode, osg::StateAttribute::OFF | kAlways);
        }
        return set;
    }();
    return *kState;
}

/// Asks by OSG, since old contexts know none of the numbers.
void requireContext(const osg::GLExtensions& gl)
{
    GLint profile = 0;
    if (gl.glVersion >= 4.5F) {
        glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    }
    if (gl.glVersion < 4.5F || (profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0) {
        throw gnomon::Error("make shadow maps by OpenGL",
                            "the context is " + std::string(reinterpret_cast<const char*>(glGetString(GL_VERSION))),
                            "make a context of OpenGL 4.5 or newer with the compatibility profile");
    }
}

/// Gives OSG its state back, also when something throws.
struct RestoredState {
    osg::State& state;
    const osg::GLExtensions& gl;
    GLint draw = 0, read = 0;

    RestoredState(osg::State& of, const osg::GLExtensions& functions) : state(of), gl(functions)
    {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
        glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read);
        state.unbindVertexArrayObject();
        state.apply(&passState());
    }
    ~RestoredState()
    {
        gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(draw));
        gl.glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read));
        state.dirtyAllVertexArrays();
        state.dirtyAllModes();
        state.dirtyAllAttributes();
        state.apply();
    }
};

} // namespace

osg::ref_ptr<osg::Program> makeProgram(const std::string& vertex, const std::string& fragment)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return program;
}

Shared::Shared()
{
    for (unsigned i = 0; i < kVariants; ++i) {
        caster_programs[i] = makeCasterProgram(i);
    }
    osg::ref_ptr<osg::Image> texel = new osg::Image;
    texel->allocateImage(1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    std::fill_n(texel->data(), 4, 255);
    white = new osg::Texture2D(texel.get());
    white->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT); // CLAMP mixes in a black border
    white->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
}

// ---- A view's own depth

namespace {

GLuint makePicture(const osg::GLExtensions& gl, GLenum format, glm::uvec2 size)
{
    GLint bound = 0;
    GLuint name = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    gl.glTexStorage2D(GL_TEXTURE_2D, 1, format, GLsizei(size.x), GLsizei(size.y));
    glBindTexture(GL_TEXTURE_2D, GLuint(bound));
    return name;
}

} // namespace

void Drawn::setSize(const osg::GLExtensions& gl, glm::uvec2 size, bool with_ids)
{
    if (size == size_px && with_ids == (ids != 0)) {
        return;
    }
    deletePicture(gl);
    size_px = size;
    depth = makePicture(gl, GL_DEPTH_COMPONENT32F, size);
    gl.glGenFramebuffers(1, &framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    if (with_ids) {
        ids = makePicture(gl, GL_R32UI, size);
        gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, ids, 0);
    }
    glDrawBuffer(with_ids ? GL_COLOR_ATTACHMENT0 : GL_NONE);
    glReadBuffer(GL_NONE);
}

void Drawn::deletePicture(const osg::GLExtensions& gl)
{
    const std::array<GLuint, 2> textures{depth, ids};
    gl.glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(GLsizei(textures.size()), textures.data());
    depth = ids = 0;
    size_px = {};
}

void Drawn::release(const osg::GLExtensions& gl)
{
    renderer.reset();
    deletePicture(gl);
}

// ---- A frame

void MaskStage::draw(osg::RenderInfo& info, osgUtil::RenderLeaf*&)
{
    if (_stageDrawnThisFrame) {
        return;
    }
    _stageDrawnThisFrame = true;
    osg::State& state = *info.getState();
    const osg::GLExtensions& gl = *state.get<osg::GLExtensions>();
    std::string notice;
    try {
        const std::shared_ptr<Drawn> drawn = findDrawn(state.getContextID(), gl);
        const RestoredState restored(state, gl);
        drawAll(info, gl, *drawn);
    } catch (const std::exception& error) {
        notice = error.what();
        for (unsigned i = 0; i < kMostLights; ++i) {
            osg::Vec3 light;
            lights->getElement(i, light);
            lights->setElement(i, osg::Vec3(light.x(), -1.0F, 0.0F));
        }
    }
    shared_->setNotice(notice);
}

std::shared_ptr<Drawn> MaskStage::findDrawn(unsigned context, const osg::GLExtensions& gl)
{
    std::shared_ptr<Drawn> drawn;
    std::multimap<unsigned, std::shared_ptr<Drawn>> gone;
    {
        const std::lock_guard lock(shared_->mutex);
        const auto [first, last] = shared_->gone.equal_range(context);
        gone.insert(first, last);
        shared_->gone.erase(first, last);
        drawn = std::make_shared<Drawn>();
        if (const auto view = shared_->views.find(camera); view != shared_->views.end()) {
            drawn = view->second.drawn.try_emplace(context, drawn).first->second;
        } else { // dropped after this frame was culled
            shared_->gone.emplace(context, drawn);
        }
    }
    for (const auto& [number, one] : gone) {
        one->release(gl);
    }
    if (drawn->renderer == nullptr) {
        try {
            requireContext(gl);
            drawn->renderer = std::make_unique<gnomon::gl::ShadowRenderer>(
                gnomon::gl::ShadowRendererOptions{osg::getGLExtensionFuncPtr, {}});
        } catch (...) {
            const std::lock_guard lock(shared_->mutex);
            shared_->refused.insert(context);
            throw;
        }
    }
    return drawn;
}

void MaskStage::drawAll(osg::RenderInfo& info, const osg::GLExtensions& gl, Drawn& drawn)
{
    const glm::uvec2 size = plan.made_for.size_px;
    gnomon::gl::ShadowRenderer& renderer = *drawn.renderer;
    renderer.prepare(plan, size);
    renderer.drawMaps(plan, [&](const gnomon::gl::MapPass& pass) { drawMap(info, gl, pass); });
    const bool with_ids = !std::ranges::all_of(*casters, [](const Caster& caster) { return caster.receives; });
    drawn.setSize(gl, size, with_ids);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, drawn.framebuffer);
    glViewport(0, 0, GLsizei(size.x), GLsizei(size.y));
    glClearDepth(0.0);
    glClear(GL_DEPTH_BUFFER_BIT); // ids may be anything where nothing is
    drawPicture(info, gl, with_ids ? kIds : 0);
    renderer.drawMask(plan, {.size_px = size, .depth = drawn.depth, .object_id = drawn.ids});
    mask->name = renderer.mask().texture;
}

void MaskStage::drawMap(osg::RenderInfo& info, const osg::GLExtensions& gl, const gnomon::gl::MapPass& pass)
{
    unsigned variant = pass.formats.colour != 0 ? kColour : 0;
    variant |= pass.formats.write_frag_depth ? kMetric : 0;
    variant |= pass.formats.samples > 1 ? kSamples : 0;
    const gnomon::pack::CasterRows view(*pass.view);
    beginCasters(info, gl);
    for (const std::uint32_t object : pass.casters) {
        const Caster& caster = (*casters)[object];
        const glm::mat4 place(glm::transpose(caster.world_from_object));
        std::array<glm::vec4, 5> rows{};
        view.write({place[0], place[1], place[2]}, rows.data());
        if (pass.view->projection.orthographic) { // x, y and the metric, which is z
            rows[4] = rows[2];
            rows[3] = {0.0F, 0.0F, 0.0F, 1.0F};
        }
        drawCaster(info, gl, caster, rows, variant);
    }
    info.getState()->unbindVertexArrayObject();
}

void MaskStage::drawPicture(osg::RenderInfo& info, const osg::GLExtensions& gl, unsigned variant)
{
    beginCasters(info, gl);
    const auto draw = [&](const Caster& caster) {
        if (!caster.drawable.valid() || !caster.isSeenWith(traversal_mask)) {
            return;
        }
        (caster.culls != GL_NONE ? glEnable : glDisable)(GL_CULL_FACE);
        glCullFace(caster.culls != GL_NONE ? caster.culls : GL_BACK);
        const glm::mat4 rows(glm::transpose(plan.made_for.camera.clip_from_world * caster.world_from_object));
        drawCaster(info, gl, caster, {rows[0], rows[1], rows[2], rows[3], {}}, variant);
    };
    for (const std::uint32_t object : plan.receivers) {
        draw((*casters)[object]);
    }
    for (const Caster& caster : *casters) { // these hide receivers, and are lit
        if (!caster.receives) {
            draw(caster);
        }
    }
    glDisable(GL_CULL_FACE);
    info.getState()->unbindVertexArrayObject();
}

/// OSG draws with vertex array 0 where it uses none of its own.
void MaskStage::beginCasters(osg::RenderInfo& info, const osg::GLExtensions& gl)
{
    info.getState()->unbindVertexArrayObject();
    gl.glBindVertexArray(0);
    info.getState()->dirtyAllVertexArrays();
    program_ = nullptr;
}

void MaskStage::drawCaster(osg::RenderInfo& info, const osg::GLExtensions& gl, const Caster& caster,
                           const std::array<glm::vec4, 5>& rows, unsigned variant)
{
    osg::State& state = *info.getState();
    const osg::Program* program = shared_->caster_programs[variant | (caster.cutout.valid() ? kMasked : 0)].get();
    if (program != program_) {
        program->apply(state);
        if (state.getLastAppliedProgramObject() == nullptr) {
            throw gnomon::Error("draw shadow maps", "the program of casters does not link", "see OSG's notices");
        }
        program_ = program;
    }
    if (caster.cutout.valid()) {
        state.setActiveTextureUnit(0);
        caster.cutout->apply(state);
        gl.glUniform2f(5, caster.cut.x, caster.cut.y);
    }
    if ((variant & kIds) != 0) {
        gl.glUniform1ui(6, caster.receives ? 1 : 0);
    }
    gl.glUniform4fv(0, 5, &rows[0].x);
    caster.drawable->draw(info);
}

} // namespace gnomon_osg
