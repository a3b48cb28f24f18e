// SPDX-License-Identifier: Apache-2.0
#include "closed_meshes.h"

#include <gtest/gtest.h>

namespace gnomon::host {
namespace {

/// A tetrahedron whose faces share no vertices, as those with normals of their own do not.
scene::Mesh makeTetrahedron()
{
    const glm::vec3 corners[]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    scene::Primitive primitive;
    for (const std::uint32_t corner : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) {
        primitive.indices.push_back(static_cast<std::uint32_t>(primitive.positions.size()));
        primitive.positions.push_back(corners[corner]);
    }
    scene::Mesh mesh;
    mesh.primitives.push_back(primitive);
    return mesh;
}

TEST(ClosedMeshes, HaveEveryEdgeAsOftenOneWayAsTheOther)
{
    EXPECT_TRUE(isClosed(makeTetrahedron()));
    scene::Mesh open = makeTetrahedron();
    open.primitives[0].indices.resize(9);
    EXPECT_FALSE(isClosed(open));
    scene::Mesh turned = makeTetrahedron();
    std::swap(turned.primitives[0].indices[0], turned.primitives[0].indices[1]);
    EXPECT_FALSE(isClosed(turned)) << "one face looks inward";
    EXPECT_FALSE(isClosed({}));
}

TEST(ClosedMeshes, MayBeOfSeveralMaterials)
{
    scene::Mesh mesh = makeTetrahedron();
    mesh.primitives.push_back(mesh.primitives[0]);
    mesh.primitives[0].indices.resize(6);
    mesh.primitives[1].indices.erase(mesh.primitives[1].indices.begin(), mesh.primitives[1].indices.begin() + 6);
    EXPECT_TRUE(isClosed(mesh));
    scene::Scene scene;
    scene.meshes = {mesh, {}};
    EXPECT_EQ(closedMeshes(scene), (std::vector<bool>{true, false}));
}

} // namespace
} // namespace gnomon::host
