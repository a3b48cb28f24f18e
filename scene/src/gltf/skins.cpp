// SPDX-License-Identifier: Apache-2.0
#include "gltf/document.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene::gltf {

namespace {

constexpr Format kInverseBindFormats[] = {{"MAT4", Component::f32, false}};

std::vector<glm::mat4> readInverseBind(Document& document, const JsonView& skin, std::size_t joint_count)
{
    std::vector<glm::mat4> out(joint_count, glm::mat4(1.0F));
    const std::optional<JsonView> where = skin.find("inverseBindMatrices");
    if (!where) {
        return out;
    }
    const Accessor& accessor = document.accessor(*where);
    expectFormat(*where, accessor, kInverseBindFormats);
    if (accessor.count < joint_count) {
        where->failFound("there must be a matrix for every joint, " + std::to_string(joint_count),
                         std::to_string(accessor.count));
    }
    noticeStride(document, accessor, "inverse bind matrices");
    if (!accessor.hasContent()) {
        document.context().notice("skin " + skin.pointer() + " has no inverse bind matrices; identity was taken");
        return out;
    }
    const std::vector<float> values = readFloats(document.context(), accessor);
    for (std::size_t i = 0; i < joint_count; ++i) {
        glm::mat4 m = glm::make_mat4(&values[i * 16]);
        constexpr float kRounding = 1e-5F; // exporters invert in single precision
        if (std::abs(m[0].w) + std::abs(m[1].w) + std::abs(m[2].w) + std::abs(m[3].w - 1.0F) > kRounding) {
            where->failFound("matrix " + std::to_string(i) + " must be affine", "a last row other than 0 0 0 1");
        }
        m[0].w = m[1].w = m[2].w = 0.0F;
        m[3].w = 1.0F;
        out[i] = m;
    }
    return out;
}

/// Joints keep their glTF indices until all skins are checked against the scene.
Skin readSkin(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::other);
    Skin skin;
    skin.name = view.string("name", "");
    const JsonView joints = view.at("joints");
    const std::size_t count = joints.size();
    std::set<std::uint32_t> seen;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t joint = joints.element(i).index(document.nodes.size());
        if (!seen.insert(joint).second) {
            joints.element(i).fail("a skin names a joint twice");
        }
        skin.joints.push_back(joint);
    }
    static_cast<void>(view.index("skeleton", document.nodes.size())); // a hint that nothing here needs
    document.context().chargeBytes(count * sizeof(glm::mat4), view.pointer());
    skin.inverse_bind = readInverseBind(document, view, count);
    return skin;
}

bool allInScene(const Document& document, const Skin& skin)
{
    return std::all_of(skin.joints.begin(), skin.joints.end(),
                       [&](std::uint32_t joint) { return document.nodes[joint] != kNone; });
}

} // namespace

void readSkins(Document& document)
{
    const std::size_t count = topLevelCount(document, "skins");
    for (std::size_t i = 0; i < count; ++i) {
        document.scene.skins.push_back(readSkin(document, document.root.at("skins").element(i)));
    }
    // Nodes know skins only by number, so what joins both is checked here.
    for (std::size_t i = 0; i < document.nodes.size(); ++i) {
        const JsonView view = document.root.at("nodes").element(i);
        const std::uint32_t index = view.index("skin", count);
        if (index == kNone) {
            continue;
        }
        const Skin& skin = document.scene.skins[index];
        const std::uint32_t mesh = view.at("mesh").index(document.scene.meshes.size());
        if (!document.meshes_skinned[mesh]) {
            view.failFound("a node with a skin needs a mesh with joints", "a mesh without JOINTS_0");
        }
        if (document.joint_limits[mesh] > skin.joints.size()) {
            document.context().fail("/meshes/" + std::to_string(mesh),
                                    "a vertex names a joint that skin " + std::to_string(index) + " of " +
                                        std::to_string(skin.joints.size()) + " joints does not have",
                                    "joint " + std::to_string(document.joint_limits[mesh] - 1));
        }
    }
    // A skin that the scene does not use may have joints elsewhere; it is emptied rather than left dangling.
    for (Skin& skin : document.scene.skins) {
        if (!allInScene(document, skin)) {
            skin.joints.clear();
            skin.inverse_bind.clear();
            continue;
        }
        for (std::uint32_t& joint : skin.joints) {
            joint = document.nodes[joint];
        }
    }
}

} // namespace gnomon::scene::gltf
