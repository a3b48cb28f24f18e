// SPDX-License-Identifier: Apache-2.0
#include "gnomon_shadow_casters.h"

#include <osg/AlphaFunc>
#include <osg/Camera>
#include <osg/CullFace>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/StateSet>
#include <osg/Transform>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace gnomon_osg {
namespace {

unsigned revisionOf(const osg::Drawable& drawable)
{
    const osg::Geometry* geometry = drawable.asGeometry();
    unsigned sum = 0;
    if (geometry != nullptr && geometry->getVertexArray() != nullptr) {
        sum += geometry->getVertexArray()->getModifiedCount();
    }
    for (unsigned i = 0; geometry != nullptr && i < geometry->getNumPrimitiveSets(); ++i) {
        sum += geometry->getPrimitiveSet(i)->getModifiedCount();
    }
    return sum;
}

/// How a drawable is cut out and culled, by the StateSets on its path, the innermost first. False: it is too
/// transparent to count.
bool findLook(const osg::NodePath& path, Caster& caster)
{
    using Attribute = osg::StateAttribute;
    const Attribute* texture = nullptr;
    const Attribute* test = nullptr;
    const Attribute* material = nullptr;
    const Attribute* faces = nullptr;
    unsigned blends = Attribute::INHERIT;
    unsigned tests = Attribute::INHERIT;
    unsigned culls = Attribute::INHERIT;
    for (auto node = path.rbegin(); node != path.rend(); ++node) {
        if (const osg::StateSet* set = (*node)->getStateSet()) {
            texture = texture != nullptr ? texture : set->getTextureAttribute(0, Attribute::TEXTURE);
            test = test != nullptr ? test : set->getAttribute(Attribute::ALPHAFUNC);
            material = material != nullptr ? material : set->getAttribute(Attribute::MATERIAL);
            faces = faces != nullptr ? faces : set->getAttribute(Attribute::CULLFACE);
            blends = (blends & Attribute::INHERIT) == 0 ? blends : set->getMode(GL_BLEND);
            tests = (tests & Attribute::INHERIT) == 0 ? tests : set->getMode(GL_ALPHA_TEST);
            culls = (culls & Attribute::INHERIT) == 0 ? culls : set->getMode(GL_CULL_FACE);
        }
    }
    const auto on = [](unsigned mode) {
        return (mode & Attribute::INHERIT) == 0 && (mode & Attribute::ON) != 0;
    };
    if (on(culls)) {
        caster.culls = faces != nullptr ? GLenum(static_cast<const osg::CullFace*>(faces)->getMode()) : GL_BACK;
    }
    caster.cut.y = 0.5F;
    if (on(blends) && material != nullptr) {
        caster.cut.x = static_cast<const osg::Material*>(material)->getDiffuse(osg::Material::FRONT).a();
    }
    if (on(tests) && test != nullptr) {
        caster.cut.y = static_cast<const osg::AlphaFunc*>(test)->getReferenceValue();
    }
    if (on(blends) || on(tests)) {
        caster.cutout = dynamic_cast<const osg::Texture*>(texture);
    }
    return caster.cutout.valid() || !on(blends) || caster.cut.x >= caster.cut.y;
}

} // namespace

glm::dmat4 toGlm(const osg::Matrixd& matrix)
{
    return glm::make_mat4(matrix.ptr()); // rows of row vectors are columns of column vectors
}

bool Caster::isSeenWith(unsigned traversal_mask) const
{
    return std::ranges::all_of(masks, [&](unsigned mask) { return (mask & traversal_mask) != 0; });
}

class Collector : public osg::NodeVisitor {
public:
    Collector(CasterScene& scene, const osgShadow::ShadowSettings& masks, const osg::Matrixd& world)
        : NodeVisitor(NODE_VISITOR, TRAVERSE_ACTIVE_CHILDREN), scene_(scene), masks_(masks), places_{world}
    {
    }
    void apply(osg::Transform& node) override
    {
        osg::Matrixd place = places_.back();
        node.computeLocalToWorldMatrix(place, this);
        places_.push_back(place);
        traverse(node);
        places_.pop_back();
    }
    void apply(osg::Camera& node) override
    {
        if (node.getRenderOrder() == osg::Camera::NESTED_RENDER) {
            apply(static_cast<osg::Transform&>(node));
        }
    }
    void apply(osg::Drawable& drawable) override
    {
        const osg::BoundingBox& box = drawable.getBoundingBox();
        Caster caster;
        caster.drawable = &drawable;
        caster.world_from_object = toGlm(places_.back());
        if (!box.valid() || !findLook(getNodePath(), caster)) {
            return;
        }
        bool casts = true;
        gnomon::ObjectFlags flags;
        for (const osg::Node* node : getNodePath()) {
            casts = casts && (node->getNodeMask() & masks_.getCastsShadowTraversalMask()) != 0;
            flags.receives = flags.receives && (node->getNodeMask() & masks_.getReceivesShadowTraversalMask()) != 0;
            flags.dynamic = flags.dynamic || node->getDataVariance() == osg::Object::DYNAMIC;
            if (node->getNodeMask() != ~0U) {
                caster.masks.push_back(node->getNodeMask());
            }
        }
        caster.receives = flags.receives;
        flags.groups = casts ? gnomon::kCommonGroup : 0;
        const gnomon::Aabb own{{box.xMin(), box.yMin(), box.zMin()}, {box.xMax(), box.yMax(), box.zMax()}};
        const gnomon::Aabb bounds = gnomon::transform(glm::mat4(caster.world_from_object), own);
        scene_.note(getNodePath(), std::move(caster), bounds, flags);
    }

private:
    CasterScene& scene_;
    const osgShadow::ShadowSettings& masks_;
    std::vector<osg::Matrixd> places_;
};

void CasterScene::collect(osg::Group& scene, const osgShadow::ShadowSettings& masks, const osg::NodePath& path)
{
    ++visit_;
    casters_ = std::make_shared<Casters>();
    Collector collector(*this, masks, osg::computeLocalToWorld(path));
    collector.pushOntoNodePath(&scene);
    scene.osg::Group::traverse(collector);
    std::erase_if(known_,
                  [&](const auto& one) { return one.second.visit != visit_ && objects_.remove(one.second.id); });
}

void CasterScene::note(const osg::NodePath& path, Caster caster, const gnomon::Aabb& bounds,
                       const gnomon::ObjectFlags& flags)
{
    Known& known = known_[path];
    const unsigned revision = revisionOf(*caster.drawable);
    if (!known.id) {
        known.id = objects_.add(bounds, flags);
        known.drawable = caster.drawable;
    } else {
        objects_.update(known.id, bounds);
        objects_.setFlags(known.id, flags);
        // Turned inside its bounds, or deformed.
        if (caster.world_from_object != known.world_from_object || revision != known.revision ||
            caster.drawable->getDataVariance() == osg::Object::DYNAMIC) {
            objects_.touch(known.id);
        }
    }
    known.world_from_object = caster.world_from_object;
    known.revision = revision;
    known.visit = visit_;
    casters_->resize(std::max<std::size_t>(casters_->size(), known.id.index + 1));
    (*casters_)[known.id.index] = std::move(caster);
}

} // namespace gnomon_osg
