// SPDX-License-Identifier: Apache-2.0
#include "osg_views.h"

#include <gnomon/error.h>
#include <gnomon/option_table.h>

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>
#include <osgDB/ReadFile>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowMap>

#include <chrono>
#include <map>

namespace {

// ---- Masks. The picture is the visibility: 0 where a surface faces away from the light, else by the technique.

constexpr const char* kMaskEnd = R"(
uniform sampler2D base;
uniform vec2 size;
float shown(float visibility)
{
    if (texture2D(base, gl_TexCoord[0].xy).a < 0.5) discard;
    vec4 p = gl_ProjectionMatrixInverse * vec4(vec3(gl_FragCoord.xy / size, gl_FragCoord.z) * 2.0 - 1.0, 1.0);
    vec3 n = cross(dFdx(p.xyz / p.w), dFdy(p.xyz / p.w)); // towards the eye
    return dot(n, gl_LightSource[0].position.xyz) > 0.0 ? visibility : 0.0;
}
)";
constexpr const char* kShadowMapMask = R"(
uniform sampler2DShadow osgShadow_shadowTexture;
void main() { gl_FragColor = vec4(vec3(shown(shadow2DProj(osgShadow_shadowTexture, gl_TexCoord[1]).r)), 1.0); }
)";
constexpr const char* kStandardMask = R"(
float DynamicShadow();
void main() { gl_FragColor = vec4(vec3(shown(DynamicShadow())), 1.0); }
)";
constexpr const char* kGnomonVertex = R"(#version 130
out vec2 uv;
void main()
{
    uv = gl_MultiTexCoord0.xy;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
constexpr const char* kGnomonMask = R"(
in vec2 uv;
uniform sampler2D base;
void main()
{
    if (texture(base, uv).a < 0.5) discard;
    gl_FragColor = vec4(vec3(gnomonVisibility(0)), 1.0);
})";

osg::ref_ptr<osg::Geode> makeShape(osg::Shape* shape, const osg::Vec4& colour)
{
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(new osg::ShapeDrawable(shape));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, colour);
    material->setAmbient(osg::Material::FRONT_AND_BACK, colour);
    geode->getOrCreateStateSet()->setAttribute(material);
    return geode;
}

// A sheet whose texture has holes.
osg::ref_ptr<osg::Node> makeSheet()
{
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(64, 64, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            unsigned char* texel = image->data(x, y);
            texel[0] = texel[1] = texel[2] = 220;
            texel[3] = (x / 8 + y / 8) % 2 == 0 ? 255 : 0;
        }
    }
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry({-4.0F, 0.5F, -2.0F}, {2.5F, 0.0F, 0.0F}, {0.0F, 2.5F, 0.0F}));
    osg::StateSet& set = *geode->getOrCreateStateSet();
    set.setTextureAttributeAndModes(0, new osg::Texture2D(image.get()));
    set.setMode(GL_BLEND, osg::StateAttribute::ON);
    set.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return geode;
}

} // namespace

gnomon::ShadowOptions parseTechnique(std::string_view text)
{
    gnomon::ShadowOptions options;
    const std::string whole(text);
    const auto fail = [&](std::string_view word, const std::string& todo) {
        throw gnomon::Error("read the technique '" + whole + "'", "'" + std::string(word) + "' is unknown", todo);
    };
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('+'), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t equals = word.find('=');
        std::string_view key = word.substr(0, equals);
        std::string_view value = equals == word.npos ? word : word.substr(equals + 1);
        if (equals == word.npos) {
            for (const gnomon::ChoiceValue& choice : gnomon::choiceValues()) {
                key = choice.name == word && choice.choice != "light" ? choice.choice : key;
            }
        }
        const gnomon::OptionRow* row = gnomon::findOption(key);
        if (row == nullptr && word == "auto") {
            continue; // as it is by default
        }
        if (row == nullptr) {
            fail(word, "take words of 'gnomon list'");
            return options;
        }
        const gnomon::OptionReading reading = gnomon::readOption(*row, value);
        if (!reading.value) {
            fail(word, "write " + reading.expected);
            return options;
        }
        row->set(options, *reading.value);
    }
    return gnomon::resolvedOrThrow(options).asked();
}

osg::ref_ptr<osg::Node> readModel(const std::string& file)
{
    osg::ref_ptr<osgDB::Options> keep_axes = new osgDB::Options("noRotation"); // OBJ: y stays up
    osg::ref_ptr<osg::Node> model = osgDB::readRefNodeFile(file, keep_axes.get());
    if (!model) {
        throw gnomon::Error("read " + file, "OSG has no reader for it, or cannot open it");
    }
    return model;
}

osg::ref_ptr<osg::Node> makeBox(const osg::Vec3& low, const osg::Vec3& high, const osg::Vec4& colour)
{
    const osg::Vec3 size = high - low;
    return makeShape(new osg::Box((low + high) * 0.5F, size.x(), size.y(), size.z()), colour);
}

osg::ref_ptr<osg::Node> makeModel()
{
    osg::ref_ptr<osg::Group> model = new osg::Group;
    model->addChild(makeBox({-20, -1, -20}, {20, 0, 20}, {0.75F, 0.75F, 0.7F, 1}));
    model->addChild(makeBox({-1, 0, -1}, {1, 2, 1}, {0.8F, 0.4F, 0.3F, 1}));
    model->addChild(makeBox({-3.5F, 0, 1.5F}, {-2.5F, 1.5F, 2.5F}, {0.4F, 0.6F, 0.8F, 1}));
    model->addChild(makeBox({1.5F, 2.9F, 0}, {3.5F, 3.1F, 2}, {0.6F, 0.7F, 0.4F, 1}));
    model->addChild(makeShape(new osg::Sphere({3.5F, 0.8F, -2}, 0.8F), {0.9F, 0.8F, 0.4F, 1}));
    model->addChild(makeSheet());
    return model;
}

osg::ref_ptr<osg::LightSource> makeSun(const osg::Vec3d& travels)
{
    osg::Vec3 to_light = -travels;
    to_light.normalize();
    osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
    osg::Light& light = *sun->getLight();
    light.setPosition({to_light, 0.0F});
    light.setDirection(-to_light);
    light.setAmbient({0.25F, 0.25F, 0.25F, 1.0F});
    light.setDiffuse({0.75F, 0.75F, 0.75F, 1.0F});
    light.setSpecular({0.0F, 0.0F, 0.0F, 1.0F});
    return sun;
}

osg::ref_ptr<osgShadow::ShadowTechnique> makeOwnTechnique(const std::string& name, osg::LightSource& sun, int map_size,
                                                          bool shows_mask)
{
    const osg::Vec2s size(static_cast<short>(map_size), static_cast<short>(map_size));
    const std::string mask_begin = kMaskEnd;
    if (name == "none") {
        return nullptr;
    }
    if (name == "shadowmap") {
        osg::ref_ptr<osgShadow::ShadowMap> map = new osgShadow::ShadowMap;
        map->setTextureSize(size);
        map->setTextureUnit(1);
        map->setLight(&sun);
        if (shows_mask) {
            map->addShader(new osg::Shader(osg::Shader::FRAGMENT, mask_begin + kShadowMapMask));
        }
        return map;
    }
    if (name == "lispsm") {
        osg::ref_ptr<osgShadow::LightSpacePerspectiveShadowMapDB> map = new osgShadow::LightSpacePerspectiveShadowMapDB;
        map->setTextureSize(size);
        map->setLight(sun.getLight());
        map->setBaseTextureUnit(0);
        map->setShadowTextureUnit(1);
        map->setBaseTextureCoordIndex(0);
        map->setShadowTextureCoordIndex(1);
        map->setMinLightMargin(10);
        map->setMaxFarPlane(0); // no limit
        if (shows_mask) {
            map->setMainFragmentShader(new osg::Shader(osg::Shader::FRAGMENT, mask_begin + kStandardMask));
        }
        return map;
    }
    if (name == "pssm" && !shows_mask) {
        osg::ref_ptr<osgShadow::ParallelSplitShadowMap> map = new osgShadow::ParallelSplitShadowMap(nullptr, 3);
        map->setTextureResolution(unsigned(map_size));
        map->setUserLight(sun.getLight());
        return map;
    }
    throw gnomon::Error("take OSG's technique " + name, shows_mask ? "there is no mask of it" : "there is none",
                        "take none, shadowmap, lispsm or pssm");
}

void showMask(osg::Node& node)
{
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, kGnomonVertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       std::string("#version 130\n") + gnomon_osg::kVisibilityGlsl + kGnomonMask));
    node.getOrCreateStateSet()->setAttribute(program);
}

// ---- The viewer

struct Offscreen::Finish : osg::Camera::DrawCallback {
    void operator()(osg::RenderInfo& info) const override
    {
        glFinish();
        for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
            ++errors;
        }
        renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        if (wanted) {
            const osg::Viewport& area = *info.getCurrentCamera()->getViewport();
            osg::ref_ptr<osg::Image>& image = images[info.getCurrentCamera()];
            image = new osg::Image;
            image->readPixels(int(area.x()), int(area.y()), int(area.width()), int(area.height()), GL_RGB,
                              GL_UNSIGNED_BYTE);
        }
    }
    bool wanted = false;
    mutable std::map<const osg::Camera*, osg::ref_ptr<osg::Image>> images;
    mutable std::string renderer;
    mutable int errors = 0;
};

Offscreen::Offscreen(osg::Node* scene, const Look& look) : finish_(new Finish)
{
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->setUndefinedScreenDetailsToDefaultScreen();
    traits->width = look.width;
    traits->height = look.height;
    traits->depth = 24;
    traits->stencil = 8;
    traits->pbuffer = true;
    traits->doubleBuffer = false;
    traits->vsync = false;
    osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits.get());
    if (!context) {
        throw gnomon::Error("make a picture without a window", "OSG makes no context", "run it by xvfb-run");
    }
    osg::Camera& camera = *viewer_.getCamera();
    camera.setGraphicsContext(context);
    camera.setViewport(0, 0, look.width, look.height);
    camera.setDrawBuffer(GL_FRONT);
    camera.setReadBuffer(GL_FRONT);
    camera.setProjectionMatrixAsPerspective(look.fov_deg, double(look.width) / look.height, 0.1, 1000.0);
    camera.setViewMatrixAsLookAt(look.eye, look.target, {0.0, 1.0, 0.0});
    camera.setFinalDrawCallback(finish_);
    viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer_.setLightingMode(osg::View::NO_LIGHT); // the scene has its own
    viewer_.setSceneData(scene);
    viewer_.realize();
}

Offscreen::~Offscreen() = default;

double Offscreen::frame()
{
    const auto start = std::chrono::steady_clock::now();
    viewer_.frame();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

osg::ref_ptr<osg::Image> Offscreen::picture(const osg::Camera* camera)
{
    finish_->wanted = true;
    viewer_.frame();
    finish_->wanted = false;
    return finish_->images[camera != nullptr ? camera : viewer_.getCamera()];
}

const std::string& Offscreen::renderer() const
{
    return finish_->renderer;
}

int Offscreen::errors() const
{
    return finish_->errors;
}

osg::Camera& Offscreen::addCamera(int x, int y, int width, int height, const osg::Matrixd& turn)
{
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setGraphicsContext(viewer_.getCamera()->getGraphicsContext());
    camera->setViewport(x, y, width, height);
    camera->setDrawBuffer(GL_FRONT);
    camera->setReadBuffer(GL_FRONT);
    camera->setClearColor(viewer_.getCamera()->getClearColor());
    camera->setFinalDrawCallback(finish_);
    viewer_.addSlave(camera, osg::Matrixd(), turn);
    return *camera;
}

void Offscreen::resize(int x, int y, int width, int height)
{
    osg::Camera& camera = *viewer_.getCamera();
    double fov_deg = 0.0;
    double ratio = 0.0;
    double near_m = 0.0;
    double far_m = 0.0;
    camera.getProjectionMatrixAsPerspective(fov_deg, ratio, near_m, far_m);
    camera.setProjectionMatrixAsPerspective(fov_deg, double(width) / height, near_m, far_m);
    camera.setViewport(x, y, width, height);
}
