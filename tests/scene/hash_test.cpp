// SPDX-License-Identifier: Apache-2.0
// A hash is as good as what it notices: every member of a scene, one by one.
#include "scene/hash.h"

#include "every_member.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <map>
#include <new>
#include <set>
#include <string>
#include <vector>

namespace gnomon::scene {
namespace {

/// Applies each change to a fresh sample; hashes must differ from the sample's and from each other.
class Hashes {
public:
    Hashes() { names_[sceneHash(sample())] = "nothing"; }

    template <typename T, typename Find>
    void tryAll(const char* where, const std::vector<Change<T>>& changes, Find find)
    {
        for (const Change<T>& change : changes) {
            Scene scene = sample();
            change.apply(find(scene));
            const std::string name = std::string(where) + "." + change.what;
            const auto [found, fresh] = names_.emplace(sceneHash(scene), name);
            EXPECT_TRUE(fresh) << "a change of " << name << " hashes like a change of " << found->second;
        }
    }

private:
    std::map<Hash128, std::string> names_;
};

TEST(SceneHash, NoticesAChangeOfAnyMember)
{
    Hashes hashes;
    hashes.tryAll(
        "Image", kImageChanges, [](Scene & s) -> auto& { return s.images[0]; });
    hashes.tryAll(
        "Texture", kTextureChanges, [](Scene & s) -> auto& { return s.textures[0]; });
    for (TextureUse Material::*use :
         {&Material::base_colour_texture, &Material::metallic_roughness_texture, &Material::normal_texture,
          &Material::occlusion_texture, &Material::emissive_texture}) {
        hashes.tryAll("texture use", kTextureUseChanges,
                      [use](Scene& s) -> TextureUse& { return s.materials[0].*use; });
    }
    hashes.tryAll(
        "Material", kMaterialChanges, [](Scene & s) -> auto& { return s.materials[0]; });
    hashes.tryAll(
        "MorphTarget", kMorphTargetChanges,
        [](Scene & s) -> auto& { return s.meshes[0].primitives[0].morph_targets[0]; });
    hashes.tryAll(
        "Primitive", kPrimitiveChanges, [](Scene & s) -> auto& { return s.meshes[0].primitives[0]; });
    hashes.tryAll(
        "Aabb", kAabbChanges, [](Scene & s) -> auto& { return s.meshes[0].primitives[0].bounds; });
    hashes.tryAll(
        "Mesh", kMeshChanges, [](Scene & s) -> auto& { return s.meshes[0]; });
    hashes.tryAll(
        "Node", kNodeChanges, [](Scene & s) -> auto& { return s.nodes[1]; });
    hashes.tryAll(
        "Transform", kTransformChanges, [](Scene & s) -> auto& { return s.nodes[1].transform; });
    hashes.tryAll(
        "Skin", kSkinChanges, [](Scene & s) -> auto& { return s.skins[0]; });
    hashes.tryAll(
        "AnimationChannel", kAnimationChannelChanges, [](Scene & s) -> auto& { return s.animations[0].channels[0]; });
    hashes.tryAll(
        "Animation", kAnimationChanges, [](Scene & s) -> auto& { return s.animations[0]; });
    hashes.tryAll(
        "Camera", kCameraChanges, [](Scene & s) -> auto& { return s.cameras[0]; });
    hashes.tryAll(
        "Light", kLightChanges, [](Scene & s) -> auto& { return s.lights[0]; });
    hashes.tryAll(
        "NamedView", kNamedViewChanges, [](Scene & s) -> auto& { return s.views[0]; });
    hashes.tryAll(
        "Environment", kEnvironmentChanges, [](Scene & s) -> auto& { return s.environment; });
    hashes.tryAll(
        "Scene", kSceneChanges, [](Scene & s) -> auto& { return s; });
}

TEST(SceneHash, IsBlindToNamesAndNotices)
{
    Scene scene = sample();
    scene.name = scene.images[0].name = scene.materials[0].name = scene.meshes[0].name = "x";
    scene.nodes[0].name = scene.skins[0].name = scene.animations[0].name = scene.cameras[0].name = "x";
    scene.lights[0].name = scene.views[0].name = "x";
    scene.notices.clear();
    EXPECT_EQ(sceneHash(scene), sceneHash(sample()));
}

TEST(SceneHash, DoesNotDependOnThePaddingOfStructs)
{
    // The same values in memory that held other bytes before.
    const auto hashIn = [](int filler) {
        alignas(Scene) static std::array<unsigned char, sizeof(Scene)> room;
        room.fill(static_cast<unsigned char>(filler));
        Scene* scene = new (room.data()) Scene;
        *scene = sample();
        const Hash128 hash = sceneHash(*scene);
        scene->~Scene();
        return hash;
    };
    EXPECT_EQ(hashIn(0), hashIn(0xFF));
}

TEST(SceneHash, HasAKnownValue)
{
    if constexpr (std::endian::native != std::endian::little) {
        GTEST_SKIP() << "the value is that of little-endian machines";
    }
    // When what is hashed changes on purpose, cached truths and scene hashes of old results become strangers: put the
    // new value here and say so in CHANGELOG.md.
    EXPECT_EQ(toString(sceneHash(sample())), "35e203787fdeae332225888e41a521fd");
}

TEST(StateHash, NoticesWhatMovesButNotTheTime)
{
    const Scene scene = sample();
    const State before = evaluate(scene, 0.0);
    const Hash128 hash = stateHash(before);
    std::set<Hash128> seen{hash};
    const auto tryAll = [&](const auto& changes, auto find) {
        for (const auto& change : changes) {
            State state = before;
            change.apply(find(state));
            EXPECT_TRUE(seen.insert(stateHash(state)).second) << change.what;
        }
    };
    tryAll(
        kObjectChanges, [](State & s) -> auto& { return s.objects[0]; });
    tryAll(
        kAabbChanges, [](State & s) -> auto& { return s.objects[0].bounds_ws; });
    tryAll(
        kDeformedChanges, [](State & s) -> auto& { return s.deformed[0]; });
    tryAll(
        kPlacedLightChanges, [](State & s) -> auto& { return s.lights[0]; });
    tryAll(
        kPlacedCameraChanges, [](State & s) -> auto& { return s.cameras[0]; });
    tryAll(
        kStateChanges, [](State & s) -> auto& { return s; });
    tryAll(
        kAabbChanges, [](State & s) -> auto& { return s.bounds_ws; });
    State later = before;
    later.time_s = 1.0;
    EXPECT_EQ(stateHash(later), hash);
}

TEST(Hasher, PiecesDoNotRunIntoEachOther)
{
    const auto hashOf = [](std::string_view first, std::string_view second) {
        Hasher hasher;
        hasher.addText(first);
        hasher.addText(second);
        return hasher.value();
    };
    EXPECT_EQ(hashOf("ab", "c"), hashOf("ab", "c"));
    EXPECT_NE(hashOf("ab", "c"), hashOf("a", "bc"));
    EXPECT_NE(hashOf("", "c"), hashOf("c", ""));
}

TEST(Hasher, IsXxh3)
{
    // XXH3_128bits of nothing, as the xxHash project publishes it (seed 0).
    EXPECT_EQ(toString(Hasher().value()), "99aa06d3014798d86001c324468d497f");
    EXPECT_EQ(toString({1, 0xFEDCBA9876543210ULL}), "0000000000000001fedcba9876543210");
}

TEST(Hasher, TakesBytesInAnyPieces)
{
    const std::vector<std::uint8_t> bytes(5000, 3);
    const auto all = std::as_bytes(std::span(bytes));
    Hasher at_once;
    at_once.addBytes(all);
    Hasher in_pieces;
    in_pieces.addBytes(all.first(1));
    in_pieces.addBytes({});
    in_pieces.addBytes(all.subspan(1, 1023));
    in_pieces.addBytes(all.subspan(1024));
    EXPECT_EQ(at_once.value(), in_pieces.value());
}

} // namespace
} // namespace gnomon::scene
