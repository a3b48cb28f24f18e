// SPDX-License-Identifier: Apache-2.0
#include "draw_table.h"

#include "closed_meshes.h"
#include "host/view.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon::host {

namespace {

// Indices into caster_batches: opaque casters, and those that may be drawn without the triangles of one side.
constexpr std::uint32_t kOpaque = 0;
constexpr std::uint32_t kOpaqueClosed = 1;

/// Batches of casters that are cut or mirrored, made when the first one is.
class OtherBatches {
public:
    OtherBatches(std::vector<vulkan::CasterBatch>& batches, const std::vector<scene::ClipPlanes>& cuts)
        : batches_(batches), cuts_(cuts)
    {
    }

    /// As `batch`, by the planes of `cut`, mirrored or not.
    std::uint32_t of(std::uint32_t batch, std::uint32_t cut, bool mirrored)
    {
        if (cut == 0 && !mirrored) {
            return batch;
        }
        const auto [found, fresh] =
            ids_.emplace(std::tuple(batch, cut, mirrored), static_cast<std::uint32_t>(batches_.size()));
        if (fresh) {
            vulkan::CasterBatch made = batches_[batch];
            made.clip_planes = cuts_[cut];
            made.mirrored = mirrored;
            batches_.push_back(made);
        }
        return found->second;
    }

private:
    std::vector<vulkan::CasterBatch>& batches_;
    const std::vector<scene::ClipPlanes>& cuts_;
    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, std::uint32_t> ids_; // by batch, cut and mirrored
};

/// For each material: do vertex colours change where it casts, or the light that it lets through?
std::vector<bool> colouredMaterials(const Materials& materials, const scene::Scene& scene)
{
    std::vector<bool> coloured(materials.all().size(), false);
    for (const scene::Mesh& mesh : scene.meshes) {
        for (const scene::Primitive& primitive : mesh.primitives) {
            const std::uint32_t material = materials.indexOf(primitive.material);
            const bool whole = materials.all()[material].blended;
            coloured[material] = coloured[material] || std::ranges::any_of(primitive.colours, [&](const glm::vec4& c) {
                                     return c.a != 1.0F || (whole && c != glm::vec4(1.0F));
                                 });
        }
    }
    return coloured;
}

} // namespace

vulkan::Rows3x4 rowsOf(const glm::mat4& m)
{
    return {glm::vec4{m[0].x, m[1].x, m[2].x, m[3].x}, glm::vec4{m[0].y, m[1].y, m[2].y, m[3].y},
            glm::vec4{m[0].z, m[1].z, m[2].z, m[3].z}};
}

DrawTable::DrawTable(const Geometry& geometry, const Materials& materials, const scene::Scene& scene,
                     const scene::State& state, const std::vector<scene::MeshClosure>& closed_meshes)
{
    using Key = std::tuple<Batch, std::uint32_t, std::uint32_t, std::uint32_t>; // batch, mesh, primitive, deformed
    std::map<Batch, std::uint32_t> batch_ids;
    std::vector<Key> keys;
    keys.reserve(state.objects.size());
    const std::vector<std::uint32_t> cut_ids = numberCuts(state);
    for (std::size_t i = 0; i < state.objects.size(); ++i) {
        const scene::Object& object = state.objects[i];
        const std::uint32_t material = materials.indexOf(object.material);
        const MaterialFacts& facts = materials.all()[material];
        const bool mirrored = glm::determinant(glm::mat3(object.world_from_object)) < 0.0F;
        const Batch batch{facts.kind, facts.two_sided, mirrored, material, cut_ids[i]};
        batch_ids.emplace(batch, 0);
        keys.emplace_back(batch, object.mesh, object.primitive, object.deformed);
    }
    for (auto& [batch, id] : batch_ids) {
        id = static_cast<std::uint32_t>(batches.size());
        batches.push_back(batch);
    }
    const std::vector<std::uint32_t> caster_ids = makeCasterBatches(materials, scene);
    closed = closedObjects(scene, state, closed_meshes);
    joined = joinedObjects(scene, state);
    outlined = outlinedObjects(scene, state);
    OtherBatches other_batches(caster_batches, cuts);
    std::map<Key, std::uint32_t> part_ids;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const Batch& batch = std::get<0>(keys[i]);
        const auto [part, fresh] = part_ids.emplace(keys[i], static_cast<std::uint32_t>(parts.size()));
        if (fresh) {
            const vulkan::MeshRange range = geometry.range(state.objects[i]);
            parts.push_back({range, batch_ids[batch]});
            const bool one_sided =
                caster_ids[batch.material] == kOpaque && closed_meshes[state.objects[i].mesh].closed();
            const std::uint32_t caster_batch = one_sided ? kOpaqueClosed : caster_ids[batch.material];
            caster_parts.push_back({range, other_batches.of(caster_batch, batch.cut, batch.mirrored)});
        }
        objects.push_back({part->second, 1U});
        pieces.push_back(geometry.pieces(state.objects[i]));
        sources.push_back({state.objects[i].mesh, state.objects[i].primitive});
        // Maps of averages draw receivers, too, and what is blended is none.
        const bool is_blended = materials.all()[batch.material].blended;
        caster_objects.push_back({part->second, is_blended && !state.objects[i].casts ? 0U : 1U});
        blended.push_back(is_blended && state.objects[i].casts ? 1 : 0);
        biases_m.push_back(state.objects[i].bias_m);
        all_receive = all_receive && (is_blended || state.objects[i].receives);
        any_smooth = any_smooth || (!is_blended && geometry.isSmooth(state.objects[i]));
        transforms.push_back(rowsOf(state.objects[i].world_from_object));
    }
}

/// One number for each object.
std::vector<std::uint32_t> DrawTable::numberCuts(const scene::State& state)
{
    using Numbers = std::array<float, 8>; // which have an order
    std::map<Numbers, std::uint32_t> known;
    std::vector<std::uint32_t> ids;
    ids.reserve(state.objects.size());
    const auto number = [&](const scene::ClipPlanes& planes) {
        const auto [found, fresh] =
            known.emplace(std::bit_cast<Numbers>(planes), static_cast<std::uint32_t>(cuts.size()));
        if (fresh) {
            cuts.push_back(planes);
        }
        return found->second;
    };
    (void)number(scene::kNoClipPlanes);
    for (const scene::Object& object : state.objects) {
        ids.push_back(number(object.clip_planes));
    }
    return ids;
}

/// Two for everything opaque, one for each masked or blended material. Returns each material's.
std::vector<std::uint32_t> DrawTable::makeCasterBatches(const Materials& materials, const scene::Scene& scene)
{
    std::vector<std::uint32_t> ids(materials.all().size(), kOpaque);
    const std::vector<bool> coloured = colouredMaterials(materials, scene);
    caster_batches.resize(2);
    caster_batches[kOpaqueClosed].two_sided = false;
    for (std::uint32_t i = 0; i < materials.all().size(); ++i) {
        if (materials.all()[i].caster_set != VK_NULL_HANDLE) {
            const scene::Material& material = scene.materials[i];
            const scene::TextureUse& use = material.base_colour_texture;
            ids[i] = static_cast<std::uint32_t>(caster_batches.size());
            const float cutoff = material.alpha_cutoff / std::max(material.base_colour.a, 1e-6F);
            caster_batches.push_back({true, materials.all()[i].caster_set, cutoff, use.scale, use.offset,
                                      use.rotation_rad, materials.all()[i].blended, material.base_colour, coloured[i],
                                      material.stained});
        }
    }
    return ids;
}

} // namespace gnomon::host
