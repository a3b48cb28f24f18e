// SPDX-License-Identifier: Apache-2.0
#include "gnomon_shadow_technique.h"

#include "gnomon_shadow_stage.h"

#include <osg/LightSource>
#include <osg/Texture2D>
#include <osgShadow/ShadowedScene>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <optional>

namespace gnomon_osg {

const char* const kVisibilityGlsl = R"(
uniform sampler2DArray gnomonMask;
uniform int gnomonLightCount;
uniform vec3 gnomonLights[8]; // index in gl_LightSource, layer and channel of the mask; layer -1: casts no shadow
uniform vec2 gnomonOrigin;    // of the viewport
int gnomonLightNumber(int i) { return int(gnomonLights[i].x); }
float gnomonVisibility(int i)
{
    vec3 light = gnomonLights[i];
    return light.y < 0.0 ? 1.0 : texelFetch(gnomonMask, ivec3(gl_FragCoord.xy - gnomonOrigin, light.y), 0)[int(light.z)];
}
)";

namespace {

constexpr const char* kShadeVertex = R"(#version 130
out vec3 point;
out vec3 normal;
out vec2 uv;
void main()
{
    point = vec3(gl_ModelViewMatrix * gl_Vertex);
    normal = gl_NormalMatrix * gl_Normal;
    uv = vec2(gl_TextureMatrix[0] * gl_MultiTexCoord0);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
// The lighting of OpenGL's fixed functions, at each pixel, both sides of a surface alike.
constexpr const char* kShadeFragment = R"(
in vec3 point;
in vec3 normal;
in vec2 uv;
uniform sampler2D gnomonBase;
void main()
{
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 sum = gl_FrontLightModelProduct.sceneColor.rgb;
    for (int i = 0; i < gnomonLightCount; ++i) {
        int k = gnomonLightNumber(i);
        vec3 to = gl_LightSource[k].position.xyz - point * gl_LightSource[k].position.w;
        float d = gl_LightSource[k].position.w == 0.0 ? 0.0 : length(to);
        vec3 l = normalize(to);
        float axis = dot(-l, normalize(gl_LightSource[k].spotDirection));
        float cone = gl_LightSource[k].spotCutoff > 90.0 ? 1.0
            : axis < gl_LightSource[k].spotCosCutoff ? 0.0 : pow(axis, gl_LightSource[k].spotExponent);
        float fall = cone / (gl_LightSource[k].constantAttenuation + d * (gl_LightSource[k].linearAttenuation
                             + d * gl_LightSource[k].quadraticAttenuation));
        float facing = max(dot(n, l), 0.0);
        float shine = facing > 0.0
            ? pow(max(dot(n, normalize(l - normalize(point))), 1e-6), gl_FrontMaterial.shininess) : 0.0;
        sum += fall * (gl_FrontLightProduct[k].ambient.rgb + gnomonVisibility(i)
               * (facing * gl_FrontLightProduct[k].diffuse.rgb + shine * gl_FrontLightProduct[k].specular.rgb));
    }
    vec4 base = texture(gnomonBase, uv);
    gl_FragColor = vec4(min(sum, 1.0) * base.rgb, gl_FrontMaterial.diffuse.a * base.a);
})";

// ---- The contents of a frame

/// The lights that CullVisitor has met, with their numbers in OpenGL. Those that hang on the camera cast nothing.
struct Lights {
    std::vector<gnomon::Light> lights;
    std::vector<int> numbers;
};

Lights findLights(osgUtil::CullVisitor& visitor, const osg::Matrixd& world_from_eye, const Settings& settings)
{
    Lights found;
    for (const auto& [attribute, eye_from_own] :
         visitor.getRenderStage()->getPositionalStateContainer()->getAttrMatrixList()) {
        const auto* light = dynamic_cast<const osg::Light*>(attribute.get());
        if (light == nullptr || found.lights.size() == kMostLights) {
            continue;
        }
        const osg::Matrixd world =
            (eye_from_own.valid() ? osg::Matrixd(*eye_from_own) : osg::Matrixd()) * world_from_eye;
        const osg::Vec4d place = osg::Vec4d(light->getPosition()) * world;
        osg::Vec3d way = osg::Matrixd::transform3x3(osg::Vec3d(light->getDirection()), world);
        gnomon::Light one;
        one.key = std::uint32_t(light->getLightNum());
        one.casts_shadow = eye_from_own.valid();
        if (place.w() == 0.0) {
            way = -osg::Vec3d(place.x(), place.y(), place.z());
            one.angular_diameter_rad = settings.sun_diameter_rad;
        } else {
            one.type = light->getSpotCutoff() <= 90.0F ? gnomon::LightType::spot : gnomon::LightType::point;
            one.position_ws = glm::dvec3(place.x(), place.y(), place.z()) / place.w();
            one.outer_half_angle_rad = osg::DegreesToRadians(double(light->getSpotCutoff()));
            one.radius_m = settings.lamp_radius_m;
        }
        way.normalize();
        one.direction_ws = {way.x(), way.y(), way.z()};
        const osg::Vec4& colour = light->getDiffuse();
        one.brightness = std::max(0.0, 0.2126 * colour.r() + 0.7152 * colour.g() + 0.0722 * colour.b());
        found.lights.push_back(one);
        found.numbers.push_back(light->getLightNum());
    }
    return found;
}

/// The camera as it sees the scene, near and far as CullVisitor has computed them by now. z is turned over, to 1 near
/// and 0 far: the pre-pass has its own depth. Nothing: it sees nothing.
std::optional<gnomon::Camera> findCamera(osgUtil::CullVisitor& visitor, const osg::Matrixd& eye_from_world,
                                         const osg::Matrixd& world_from_eye)
{
    osg::Matrixd projection = *visitor.getProjectionMatrix();
    if (visitor.getComputeNearFarMode() != osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) {
        visitor.computeNearPlane();
        double near_m = visitor.getCalculatedNearPlane();
        double far_m = visitor.getCalculatedFarPlane();
        if (near_m > far_m) {
            return {};
        }
        visitor.clampProjectionMatrix(projection, near_m, far_m);
    }
    gnomon::Camera camera;
    const osg::Vec3d eye = world_from_eye.getTrans();
    camera.eye_ws = {eye.x(), eye.y(), eye.z()};
    camera.clip_from_world = toGlm(eye_from_world * projection);
    for (int column = 0; column < 4; ++column) {
        glm::dvec4& c = camera.clip_from_world[column];
        c.z = 0.5 * (c.w - c.z); // from -w .. w
    }
    return camera;
}

} // namespace

View& Shared::viewOf(osg::Camera& camera, const gnomon::ShadowOptions& options)
{
    for (auto one = views.begin(); one != views.end();) {
        const bool stays = one->second.camera.valid();
        if (!stays) {
            drop(one->second);
        }
        one = stays ? std::next(one) : views.erase(one);
    }
    const auto [place, added] = views.try_emplace(&camera);
    if (added) {
        place->second.camera = &camera;
        place->second.planner = gnomon::Planner(options);
    }
    return place->second;
}

void Shared::releaseDrawn(osg::State* state)
{
    const std::lock_guard lock(mutex);
    for (auto& [camera, view] : views) {
        if (state == nullptr) {
            drop(view);
        } else if (auto drawn = view.drawn.extract(state->getContextID())) {
            gone.emplace(drawn.key(), std::move(drawn.mapped()));
        }
    }
    if (state != nullptr && state->getGraphicsContext() != nullptr && state->getGraphicsContext()->isCurrent()) {
        refused.erase(state->getContextID());
        const auto [first, last] = gone.equal_range(state->getContextID());
        std::for_each(first, last, [&](auto& one) { one.second->release(*state->get<osg::GLExtensions>()); });
        gone.erase(first, last);
    }
}

void Shared::drop(View& view)
{
    gone.insert(view.drawn.begin(), view.drawn.end());
    view.drawn.clear();
}

void Shared::setNotice(const std::string& text)
{
    const std::lock_guard lock(mutex);
    if (!text.empty() && text != notice) {
        OSG_WARN << "GnomonShadowTechnique: no shadows: " << text << std::endl;
    }
    notice = text;
}

// ---- The technique

GnomonShadowTechnique::GnomonShadowTechnique() : GnomonShadowTechnique(Settings{}) {}

GnomonShadowTechnique::GnomonShadowTechnique(const Settings& settings)
    : settings_(settings), shared_(std::make_shared<Shared>())
{
    shared_->shade_program =
        makeProgram(kShadeVertex, std::string("#version 130\n") + kVisibilityGlsl + kShadeFragment);
}

GnomonShadowTechnique::GnomonShadowTechnique(const GnomonShadowTechnique& other, const osg::CopyOp&)
    : GnomonShadowTechnique(other.settings_)
{
}

GnomonShadowTechnique::~GnomonShadowTechnique() = default;

void GnomonShadowTechnique::setSettings(const Settings& settings)
{
    settings_ = settings;
    const std::lock_guard lock(shared_->mutex);
    for (auto& [camera, view] : shared_->views) {
        view.planner = gnomon::Planner(settings.options);
    }
}

std::string GnomonShadowTechnique::notice() const
{
    const std::lock_guard lock(shared_->mutex);
    return shared_->notice;
}

void GnomonShadowTechnique::init()
{
    _dirty = false;
}

void GnomonShadowTechnique::update(osg::NodeVisitor& visitor)
{
    getShadowedScene()->osg::Group::traverse(visitor);
}

void GnomonShadowTechnique::cull(osgUtil::CullVisitor& visitor)
{
    osgShadow::ShadowedScene& scene = *getShadowedScene();
    {
        const std::lock_guard lock(shared_->mutex);
        if (visitor.getViewport() == nullptr || shared_->refused.contains(visitor.getState()->getContextID())) {
            scene.osg::Group::traverse(visitor);
            return;
        }
    }
    osg::ref_ptr<MaskStage> stage = new MaskStage(shared_);
    osg::ref_ptr<osg::StateSet> shading = makeShading(*stage, *visitor.getViewport());
    visitor.pushStateSet(shading.get());
    scene.osg::Group::traverse(visitor);
    visitor.popStateSet();
    if (planFrame(*stage, visitor)) {
        visitor.getRenderStage()->addPreRenderStage(stage.get(), -1);
    }
}

osg::ref_ptr<osg::StateSet> GnomonShadowTechnique::makeShading(MaskStage& stage, const osg::Viewport& viewport) const
{
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setTextureAttribute(settings_.mask_unit, stage.mask.get());
    set->addUniform(new osg::Uniform("gnomonMask", int(settings_.mask_unit)));
    set->addUniform(new osg::Uniform("gnomonOrigin", osg::Vec2(float(viewport.x()), float(viewport.y()))));
    set->addUniform(stage.lights.get());
    set->addUniform(stage.light_count.get());
    if (settings_.shades) {
        set->setAttribute(shared_->shade_program.get());
        set->setTextureAttribute(0, shared_->white.get());
        set->addUniform(new osg::Uniform("gnomonBase", 0));
    }
    return set;
}

bool GnomonShadowTechnique::planFrame(MaskStage& stage, osgUtil::CullVisitor& visitor)
{
    const osg::Matrixd world_from_scene = osg::computeLocalToWorld(visitor.getNodePath());
    const osg::Matrixd eye_from_world = osg::Matrixd::inverse(world_from_scene) * *visitor.getModelViewMatrix();
    const osg::Matrixd world_from_eye = osg::Matrixd::inverse(eye_from_world);
    const std::optional<gnomon::Camera> camera = findCamera(visitor, eye_from_world, world_from_eye);
    const Lights lights = findLights(visitor, world_from_eye, settings_);
    if (!camera || lights.lights.empty()) {
        return false;
    }
    const osg::FrameStamp* stamp = visitor.getFrameStamp();
    const std::lock_guard lock(shared_->mutex);
    if (stamp == nullptr || shared_->frame != stamp->getFrameNumber()) { // else another camera's cull was here
        shared_->frame = stamp != nullptr ? stamp->getFrameNumber() : ~0U;
        shared_->scene.collect(*getShadowedScene(), *getShadowedScene()->getShadowSettings(), visitor.getNodePath());
    }
    gnomon::Frame frame;
    frame.index = stamp != nullptr ? stamp->getFrameNumber() : 0;
    frame.time_s = stamp != nullptr ? stamp->getReferenceTime() : 0.0;
    frame.camera = *camera;
    frame.size_px = {unsigned(visitor.getViewport()->width()), unsigned(visitor.getViewport()->height())};
    frame.lights = lights.lights;
    frame.objects = &shared_->scene.objects();
    frame.rates = settings_.rates;
    stage.camera = visitor.getCurrentCamera();
    stage.traversal_mask = visitor.getTraversalMask();
    stage.casters = shared_->scene.casters();
    stage.plan = shared_->viewOf(*visitor.getCurrentCamera(), settings_.options).planner.plan(frame);
    for (unsigned i = 0; i < lights.numbers.size(); ++i) {
        const gnomon::LightPlan& plan = stage.plan.lights[i];
        const float layer = plan.outcome.hasMap() ? float(plan.mask_layer) : -1.0F;
        stage.lights->setElement(i, osg::Vec3(float(lights.numbers[i]), layer, float(plan.mask_channel)));
    }
    stage.light_count->set(int(lights.numbers.size()));
    return true;
}

void GnomonShadowTechnique::cleanSceneGraph()
{
    const std::lock_guard lock(shared_->mutex);
    for (auto& [camera, view] : shared_->views) {
        shared_->drop(view);
    }
    shared_->views.clear();
}

void GnomonShadowTechnique::resizeGLObjectBuffers(unsigned most)
{
    for (const auto& program : shared_->caster_programs) {
        program->resizeGLObjectBuffers(most);
    }
    shared_->shade_program->resizeGLObjectBuffers(most);
    shared_->white->resizeGLObjectBuffers(most);
}

void GnomonShadowTechnique::releaseGLObjects(osg::State* state) const
{
    for (const auto& program : shared_->caster_programs) {
        program->releaseGLObjects(state);
    }
    shared_->shade_program->releaseGLObjects(state);
    shared_->white->releaseGLObjects(state);
    shared_->releaseDrawn(state);
}

} // namespace gnomon_osg
