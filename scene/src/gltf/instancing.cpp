// SPDX-License-Identifier: Apache-2.0
#include "gltf/instancing.h"

#include <glm/gtc/quaternion.hpp>

namespace gnomon::scene::gltf {

namespace {

constexpr Format kVectors[] = {{"VEC3", Component::f32, false}};
constexpr Format kRotations[] = {
    {"VEC4", Component::f32, false}, {"VEC4", Component::i8, true}, {"VEC4", Component::i16, true}};

struct Source {
    std::vector<float> values; // empty: not given
    std::uint32_t count = 0;
};

Source readSource(Document& document, const JsonView& attributes, const char* name, std::span<const Format> formats)
{
    const std::optional<JsonView> where = attributes.find(name);
    if (!where) {
        return {};
    }
    const Accessor& accessor = document.accessor(*where);
    expectFormat(*where, accessor, formats);
    where->context().checkCount(accessor.count, where->pointer());
    if (!accessor.hasContent()) {
        return {{}, accessor.count};
    }
    return {readFloats(document.context(), accessor), accessor.count};
}

} // namespace

std::vector<glm::mat4> readInstances(Document& document, const JsonView& node)
{
    const std::optional<JsonView> instancing = extension(node, "EXT_mesh_gpu_instancing");
    if (!instancing) {
        return {};
    }
    if (!node.has("mesh")) {
        instancing->failFound("instancing needs a mesh on the same node", "none");
    }
    const JsonView attributes = instancing->at("attributes");
    const Source translation = readSource(document, attributes, "TRANSLATION", kVectors);
    const Source rotation = readSource(document, attributes, "ROTATION", kRotations);
    const Source scale = readSource(document, attributes, "SCALE", kVectors);
    const std::uint32_t count = std::max(std::max(translation.count, rotation.count), scale.count);
    for (const Source* source : {&translation, &rotation, &scale}) {
        if (source->count != 0 && source->count != count) {
            attributes.failFound("all attributes must have the same number of elements",
                                 std::to_string(source->count) + " and " + std::to_string(count));
        }
    }
    document.context().chargeBytes(count * sizeof(glm::mat4), attributes.pointer());
    std::vector<glm::mat4> out(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        Transform transform;
        if (!translation.values.empty()) {
            const float* v = &translation.values[i * 3ULL];
            transform.translation = {v[0], v[1], v[2]};
        }
        if (!rotation.values.empty()) {
            const float* v = &rotation.values[i * 4ULL];
            const glm::quat q(v[3], v[0], v[1], v[2]); // glm takes w first
            const float length = glm::length(q);
            if (!(length > 0.5F && length < 1.5F)) {
                attributes.at("ROTATION")
                    .failFound("element " + std::to_string(i) + " must be a unit quaternion",
                               std::to_string(length) + " as its length");
            }
            transform.rotation = q / length;
        }
        if (!scale.values.empty()) {
            const float* v = &scale.values[i * 3ULL];
            transform.scale = {v[0], v[1], v[2]};
        }
        out[i] = transform.matrix();
    }
    return out;
}

} // namespace gnomon::scene::gltf
