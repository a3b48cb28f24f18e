// SPDX-License-Identifier: Apache-2.0
#include "gltf/attributes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene::gltf {

namespace {

// Tables of glTF 2.0, 3.7.2.1, and of KHR_mesh_quantization. The formats of core glTF come first, as many as `core`.
struct Formats {
    std::span<const Format> all;
    std::size_t core;
};
constexpr Format kPositions[] = {
    {"VEC3", Component::f32, false}, {"VEC3", Component::i8, false},  {"VEC3", Component::i8, true},
    {"VEC3", Component::u8, false},  {"VEC3", Component::u8, true},   {"VEC3", Component::i16, false},
    {"VEC3", Component::i16, true},  {"VEC3", Component::u16, false}, {"VEC3", Component::u16, true}};
constexpr Format kNormals[] = {
    {"VEC3", Component::f32, false}, {"VEC3", Component::i8, true}, {"VEC3", Component::i16, true}};
constexpr Format kTangents[] = {
    {"VEC4", Component::f32, false}, {"VEC4", Component::i8, true}, {"VEC4", Component::i16, true}};
constexpr Format kTexcoords[] = {
    {"VEC2", Component::f32, false}, {"VEC2", Component::u8, true},  {"VEC2", Component::u16, true},
    {"VEC2", Component::i8, false},  {"VEC2", Component::i8, true},  {"VEC2", Component::u8, false},
    {"VEC2", Component::i16, false}, {"VEC2", Component::i16, true}, {"VEC2", Component::u16, false}};
constexpr Format kColours[] = {{"VEC3", Component::f32, false}, {"VEC3", Component::u8, true},
                               {"VEC3", Component::u16, true},  {"VEC4", Component::f32, false},
                               {"VEC4", Component::u8, true},   {"VEC4", Component::u16, true}};
constexpr Format kJoints[] = {{"VEC4", Component::u8, false}, {"VEC4", Component::u16, false}};
constexpr Format kWeights[] = {
    {"VEC4", Component::f32, false}, {"VEC4", Component::u8, true}, {"VEC4", Component::u16, true}};
constexpr Format kTargetPositions[] = {{"VEC3", Component::f32, false},
                                       {"VEC3", Component::i8, false},
                                       {"VEC3", Component::i8, true},
                                       {"VEC3", Component::i16, false},
                                       {"VEC3", Component::i16, true}};
constexpr Format kTargetVectors[] = {
    {"VEC3", Component::f32, false}, {"VEC3", Component::i8, true}, {"VEC3", Component::i16, true}};

/// Tolerance of a unit vector's length: that of the Khronos validator for floats, and what rounding to 8 bits does.
constexpr float kUnitTolerance = 0.00674F;
constexpr float kQuantizedUnitTolerance = 0.02F;

const Accessor& checked(Document& document, const JsonView& where, const Formats& formats)
{
    const Accessor& accessor = document.accessor(where);
    expectFormat(where, accessor, document.quantization ? formats.all : formats.all.first(formats.core));
    claimView(document, accessor, ViewUse::vertices);
    return accessor;
}

/// The attribute `name`, checked to have `count` elements; null when absent.
const Accessor* findAttribute(Document& document, const JsonView& attributes, const char* name, const Formats& formats,
                              std::size_t count)
{
    const std::optional<JsonView> where = attributes.find(name);
    if (!where) {
        return nullptr;
    }
    const Accessor& accessor = checked(document, *where, formats);
    if (accessor.count != count) {
        where->failFound("the accessor must have as many elements as POSITION, " + std::to_string(count),
                         std::to_string(accessor.count));
    }
    return &accessor;
}

template <typename Vector>
std::vector<Vector> readVectors(Document& document, const Accessor& accessor)
{
    const std::vector<float> flat = readFloats(document.context(), accessor);
    const std::uint32_t n = accessor.components;
    document.context().chargeBytes(std::uint64_t{accessor.count} * sizeof(Vector), accessor.pointer);
    std::vector<Vector> out(accessor.count);
    for (std::size_t i = 0; i < out.size(); ++i) {
        for (std::uint32_t c = 0; c < n && c < static_cast<std::uint32_t>(Vector::length()); ++c) {
            out[i][static_cast<glm::length_t>(c)] = flat[i * n + c];
        }
    }
    return out;
}

/// The faults found in the lengths of vectors that ought to be units.
struct Lengths {
    bool inexact = false;
    std::size_t zeros = 0;
};

/// Makes a vector a unit, which has a direction whatever its length is. One of length 0 stays.
glm::vec3 makeUnit(const Accessor& accessor, const glm::vec3& v, Lengths& found)
{
    const float tolerance = accessor.component == Component::f32 ? kUnitTolerance : kQuantizedUnitTolerance;
    const double length = glm::length(glm::dvec3(v)); // squares of any float fit
    if (length == 0.0) {
        ++found.zeros;
        return v;
    }
    found.inexact = found.inexact || !(std::abs(length - 1.0) <= double{tolerance});
    return glm::vec3(glm::dvec3(v) / length);
}

void noticeLengths(const JsonView& where, const Lengths& found, const char* instead)
{
    if (found.inexact) {
        where.context().notice("vectors of " + where.pointer() + " that are not of unit length were made so");
    }
    if (found.zeros > 0) {
        where.context().notice(std::to_string(found.zeros) + " vectors of " + where.pointer() + " of length 0 " +
                               instead);
    }
}

void readNormals(Document& document, const JsonView& attributes, Primitive& out)
{
    const Accessor* normals = findAttribute(document, attributes, "NORMAL", {kNormals, 1}, out.positions.size());
    if (normals != nullptr && normals->hasContent()) {
        out.normals = readVectors<glm::vec3>(document, *normals);
        Lengths found;
        for (glm::vec3& normal : out.normals) {
            normal = makeUnit(*normals, normal, found);
        }
        noticeLengths(attributes.at("NORMAL"), found, "were taken from the triangles");
        if (found.zeros == out.normals.size()) {
            out.normals.clear(); // as if there were none: flat ones are made
        }
    }
    const Accessor* tangents = findAttribute(document, attributes, "TANGENT", {kTangents, 1}, out.positions.size());
    if (tangents == nullptr || !tangents->hasContent()) {
        return;
    }
    out.tangents = readVectors<glm::vec4>(document, *tangents);
    const JsonView where = attributes.at("TANGENT");
    Lengths found;
    for (std::size_t i = 0; i < out.tangents.size(); ++i) {
        glm::vec4& t = out.tangents[i];
        if (t.w != 1.0F && t.w != -1.0F) {
            where.failFound("w of element " + std::to_string(i) + " must be 1 or -1", std::to_string(t.w));
        }
        t = glm::vec4(makeUnit(*tangents, glm::vec3(t), found), t.w);
    }
    noticeLengths(where, found, "were found, so all tangents of the primitive are derived");
    if (out.normals.empty()) {
        document.context().notice("tangents without normals in " + attributes.pointer() + " were left out");
    }
    if (out.normals.empty() || found.zeros > 0) {
        out.tangents.clear(); // finishScene() derives what a normal map needs
    }
}

void readColours(Document& document, const JsonView& attributes, Primitive& out)
{
    const Accessor* colours = findAttribute(document, attributes, "COLOR_0", {kColours, 6}, out.positions.size());
    if (colours == nullptr || !colours->hasContent()) {
        return;
    }
    out.colours = readVectors<glm::vec4>(document, *colours);
    bool beyond = false;
    for (glm::vec4& colour : out.colours) {
        if (colours->components == 3) {
            colour.w = 1.0F;
        }
        const glm::vec4 clamped = glm::clamp(colour, 0.0F, 1.0F);
        beyond = beyond || clamped != colour;
        colour = clamped;
    }
    if (beyond) { // glTF 2.0, 3.7.2.1, asks for what is clamped
        document.context().notice("colours of " + attributes.pointer() + "/COLOR_0 were clamped to 0 to 1");
    }
}

void readWeights(Document& document, const JsonView& attributes, const Accessor& accessor, Primitive& out)
{
    out.weights = readVectors<glm::vec4>(document, accessor);
    for (std::size_t i = 0; i < out.weights.size(); ++i) {
        glm::vec4& w = out.weights[i];
        if (!(std::min(std::min(w.x, w.y), std::min(w.z, w.w)) >= 0.0F)) {
            attributes.at("WEIGHTS_0")
                .failFound("the weights of element " + std::to_string(i) + " must not be negative",
                           std::to_string(std::min(std::min(w.x, w.y), std::min(w.z, w.w))));
        }
        const float sum = w.x + w.y + w.z + w.w;
        // Nothing to go by (or only further sets of joints): the first joint takes all.
        w = sum > 0.0F && std::isfinite(sum) ? w / sum : glm::vec4(1.0F, 0.0F, 0.0F, 0.0F);
    }
}

void readJoints(Document& document, const JsonView& attributes, Primitive& out)
{
    const std::size_t count = out.positions.size();
    const Accessor* joints = findAttribute(document, attributes, "JOINTS_0", {kJoints, 2}, count);
    const Accessor* weights = findAttribute(document, attributes, "WEIGHTS_0", {kWeights, 3}, count);
    if (joints == nullptr || weights == nullptr) { // checkPairs() has seen to it that both are
        return;
    }
    if (attributes.has("JOINTS_1")) {
        document.context().notice("more than four joints per vertex in " + attributes.pointer() +
                                  "; only the first four act");
    }
    const std::vector<std::uint32_t> flat = readIntegers(document.context(), *joints);
    document.context().chargeBytes(count * sizeof(glm::u16vec4), joints->pointer);
    out.joints.resize(count);
    for (std::size_t i = 0; i < flat.size(); ++i) {
        out.joints[i / 4][static_cast<glm::length_t>(i % 4)] = static_cast<std::uint16_t>(flat[i]);
    }
    readWeights(document, attributes, *weights, out);
}

/// Fails for joints without weights and weights without joints, which have no meaning.
void checkPairs(const JsonView& attributes)
{
    for (const auto& [name, value] : attributes.value().items()) {
        const bool joints = name.starts_with("JOINTS_");
        if (!joints && !name.starts_with("WEIGHTS_")) {
            continue;
        }
        const std::string other = (joints ? "WEIGHTS_" : "JOINTS_") + name.substr(name.find('_') + 1);
        if (!attributes.has(other)) {
            attributes.failFound(escapeKey(name) + " and " + escapeKey(other) + " must come together",
                                 "only " + escapeKey(name));
        }
    }
}

/// Attributes that have no effect are still checked to be there and of the right length.
void checkOther(Document& document, const JsonView& attributes, std::size_t count)
{
    for (const auto& [name, value] : attributes.value().items()) {
        const JsonView where = attributes.at(name);
        checkSemantic(where, name);
        const Accessor& accessor = document.accessor(where);
        if (accessor.count != count) {
            where.failFound("all attributes must have the same number of elements, " + std::to_string(count),
                            std::to_string(accessor.count));
        }
    }
}

} // namespace

void claimView(Document& document, const Accessor& accessor, ViewUse use)
{
    if (accessor.view == kNone) {
        return;
    }
    BufferView& view = document.views[accessor.view];
    if (view.use != ViewUse::none && view.use != use) {
        document.context().notice("buffer view " + std::to_string(accessor.view) +
                                  " holds both vertices and indices, or its target says so");
    }
    view.use = view.use == ViewUse::none ? use : view.use;
}

void checkSemantic(const JsonView& attribute, std::string_view name)
{
    if (name.starts_with('_') || name == "POSITION" || name == "NORMAL" || name == "TANGENT") {
        return;
    }
    for (const std::string_view prefix : {"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"}) {
        const std::string_view digits = name.substr(std::min(prefix.size(), name.size()));
        if (name.starts_with(prefix) && !digits.empty() && digits.size() < 4 &&
            std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; })) {
            return;
        }
    }
    attribute.failFound("the attribute's name is none of glTF's", "'" + escapeKey(name) + "'",
                        "start the names of attributes of your own with an underscore");
}

bool readAttributes(Document& document, const JsonView& attributes, Primitive& out)
{
    attributes.expectObject();
    if (attributes.value().empty()) {
        attributes.fail("attributes must not be empty");
    }
    const auto first = attributes.value().begin();
    checkSemantic(attributes.at(first.key()), first.key());
    const std::optional<JsonView> position = attributes.find("POSITION");
    checkOther(document, attributes, document.accessor(position.value_or(attributes.at(first.key()))).count);
    checkPairs(attributes);
    if (!position) {
        return false;
    }
    out.positions = readVectors<glm::vec3>(document, checked(document, *position, {kPositions, 1}));
    const std::size_t count = out.positions.size();
    readNormals(document, attributes, out);
    for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
        if (const Accessor* uv = findAttribute(document, attributes, name, {kTexcoords, 3}, count)) {
            (name[9] == '0' ? out.uv0 : out.uv1) = readVectors<glm::vec2>(document, *uv);
        }
    }
    readColours(document, attributes, out);
    readJoints(document, attributes, out);
    return true;
}

MorphTarget readMorphTarget(Document& document, const JsonView& target, const JsonView& attributes,
                            std::size_t vertex_count)
{
    target.expectObject();
    if (target.value().empty()) {
        target.fail("a morph target must not be empty");
    }
    for (const auto& [name, value] : target.value().items()) {
        checkSemantic(target.at(name), name);
        if (!attributes.has(name)) {
            target.at(name).failFound("the primitive itself has no such attribute", "'" + escapeKey(name) + "'");
        }
    }
    checkOther(document, target, vertex_count);
    if (target.has("TEXCOORD_0") || target.has("TEXCOORD_1") || target.has("COLOR_0")) {
        document.context().notice("morphing of texture coordinates and colours in " + target.pointer() +
                                  " has no effect");
    }
    MorphTarget out;
    if (const Accessor* positions = findAttribute(document, target, "POSITION", {kTargetPositions, 1}, vertex_count)) {
        out.positions = readVectors<glm::vec3>(document, *positions);
    }
    if (const Accessor* normals = findAttribute(document, target, "NORMAL", {kTargetVectors, 1}, vertex_count)) {
        out.normals = readVectors<glm::vec3>(document, *normals);
    }
    if (const Accessor* tangents = findAttribute(document, target, "TANGENT", {kTargetVectors, 1}, vertex_count)) {
        out.tangents = readVectors<glm::vec3>(document, *tangents);
    }
    return out;
}

} // namespace gnomon::scene::gltf
