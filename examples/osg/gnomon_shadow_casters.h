// SPDX-License-Identifier: Apache-2.0
// The drawables below an osgShadow::ShadowedScene, as Gnomon plans with them and GnomonShadowTechnique draws them.
#pragma once

#include <gnomon/object_set.h>

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/Texture>
#include <osgShadow/ShadowSettings>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <map>
#include <memory>
#include <vector>

namespace gnomon_osg {

/// The same matrix in glm, for column vectors.
glm::dmat4 toGlm(const osg::Matrixd& matrix);

/// One place of a drawable.
struct Caster {
    osg::ref_ptr<osg::Drawable> drawable; // null: no object has this index
    glm::dmat4 world_from_object{1.0};
    osg::ref_ptr<const osg::Texture> cutout; // null: not cut out
    glm::vec2 cut{1.0F};                     // the factor of alpha, and where it is cut
    GLenum culls = GL_NONE;                  // faces that the camera does not see
    std::vector<unsigned> masks;             // of the nodes on its path, all ones left out
    bool receives = true;                    // else it is lit

    /// CullVisitor with this traversal mask sees it.
    [[nodiscard]] bool isSeenWith(unsigned traversal_mask) const;
};
using Casters = std::vector<Caster>; // by the index of the object

/// All drawables below a scene, from frame to frame.
class CasterScene {
public:
    /// Visits the scene and takes over what was added, moved, deformed, removed or set otherwise. `masks`: who casts
    /// and who receives. `path`: from the root to the scene, as CullVisitor has it.
    void collect(osg::Group& scene, const osgShadow::ShadowSettings& masks, const osg::NodePath& path);
    [[nodiscard]] const gnomon::ObjectSet& objects() const { return objects_; }
    /// From the last collect(); a frame that is drawn later keeps them.
    [[nodiscard]] std::shared_ptr<const Casters> casters() const { return casters_; }

private:
    friend class Collector;
    struct Known {
        gnomon::ObjectId id;
        osg::ref_ptr<osg::Drawable> drawable; // so its address is not used again
        glm::dmat4 world_from_object{1.0};
        unsigned revision = 0;
        unsigned visit = 0; // the last one
    };
    void note(const osg::NodePath& path, Caster caster, const gnomon::Aabb& bounds, const gnomon::ObjectFlags& flags);

    gnomon::ObjectSet objects_;
    std::map<osg::NodePath, Known> known_; // a path tells the places of one drawable apart
    std::shared_ptr<Casters> casters_;
    unsigned visit_ = 0;
};

} // namespace gnomon_osg
