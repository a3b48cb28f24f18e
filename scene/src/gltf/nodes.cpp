// SPDX-License-Identifier: Apache-2.0
#include "gltf/casting_extras.h"
#include "gltf/instancing.h"
#include "gltf/scene_part.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene::gltf {

namespace {

void readMatrix(const JsonView& matrix, const JsonView& view, Node& node)
{
    for (const char* key : {"translation", "rotation", "scale"}) {
        if (view.has(key)) {
            view.at(key).fail("a node must not have both a matrix and a " + std::string(key));
        }
    }
    matrix.numbers({glm::value_ptr(node.matrix), 16});
    const glm::mat4& m = node.matrix;
    if (m[0].w != 0.0F || m[1].w != 0.0F || m[2].w != 0.0F || m[3].w != 1.0F) {
        matrix.failFound("the matrix must be affine", "a last row other than 0 0 0 1");
    }
    node.use_matrix = true;
}

void readTransform(const JsonView& view, Node& node)
{
    if (const std::optional<JsonView> matrix = view.find("matrix")) {
        readMatrix(*matrix, view, node);
        return;
    }
    if (const std::optional<JsonView> translation = view.find("translation")) {
        translation->numbers({glm::value_ptr(node.transform.translation), 3});
    }
    if (const std::optional<JsonView> scale = view.find("scale")) {
        scale->numbers({glm::value_ptr(node.transform.scale), 3});
    }
    if (const std::optional<JsonView> rotation = view.find("rotation")) {
        std::array<float, 4> q{};
        rotation->numbers(q, -1.0001, 1.0001);
        const glm::quat value(q[3], q[0], q[1], q[2]); // glm takes w first
        const float length = glm::length(value);
        constexpr float kTolerance = 0.01F;
        if (!(std::abs(length - 1.0F) <= kTolerance)) {
            rotation->failFound("a rotation must be a unit quaternion", std::to_string(length) + " as its length");
        }
        node.transform.rotation = value / length;
    }
}

void readClipPlane(const JsonView& view, glm::vec4& plane)
{
    view.numbers({glm::value_ptr(plane), 4});
    const double length = glm::length(glm::dvec3(plane));
    if (length == 0.0) {
        view.fail("a clip plane's first three numbers must not all be zero");
    }
    const glm::dvec4 unit = glm::dvec4(plane) / length;
    if (!(std::abs(unit.w) <= double{std::numeric_limits<float>::max()})) {
        view.fail("the clip plane is too far away");
    }
    plane = glm::vec4(unit);
}

/// glTF leaves `extras` to applications. Ours: {"clip_planes": [[a, b, c, d]]} keeps the part of the node's mesh with a
/// x + b y + c z + d >= 0, for each of up to two planes.
void readExtras(const JsonView& view, Node& node)
{
    const std::optional<JsonView> extras = view.find("extras");
    if (!extras || !extras->value().is_object()) { // glTF allows any value, and others' are not ours to judge
        return;
    }
    const std::optional<JsonView> planes = extras->find("clip_planes");
    if (!planes || (planes->value().is_array() && planes->value().empty())) {
        return;
    }
    const std::size_t count = planes->size();
    if (count > node.clip_planes.size()) {
        planes->failFound("a node has at most two clip planes", std::to_string(count));
    }
    for (std::size_t i = 0; i < count; ++i) {
        readClipPlane(planes->element(i), node.clip_planes[i]);
    }
}

Node readNode(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::node);
    Node node;
    node.name = view.string("name", "");
    readTransform(view, node);
    node.mesh = view.index("mesh", document.scene.meshes.size());
    node.skin = view.index("skin", topLevelCount(document, "skins"));
    const std::uint32_t camera = view.index("camera", document.cameras.size());
    node.camera = camera == kNone ? kNone : document.cameras[camera];
    if (node.skin != kNone && node.mesh == kNone) {
        view.at("skin").fail("a node with a skin needs a mesh");
    }
    if (const std::optional<JsonView> weights = view.find("weights")) {
        const std::size_t targets = node.mesh == kNone ? 0 : document.scene.meshes[node.mesh].morph_weights.size();
        if (weights->size() != targets) {
            weights->failFound("there must be one weight per morph target, " + std::to_string(targets),
                               std::to_string(weights->size()));
        }
        node.morph_weights.resize(targets);
        weights->numbers(node.morph_weights);
    }
    if (const std::optional<JsonView> light = extension(view, "KHR_lights_punctual")) {
        const std::uint32_t index = light->at("light").index(document.lights.size());
        node.light = document.lights[index];
    }
    node.instances = readInstances(document, view);
    readExtras(view, node);
    return node;
}

/// By KHR_node_visibility, which hides all that is below the node as well.
bool isHidden(const JsonView& view)
{
    const std::optional<JsonView> visibility = extension(view, "KHR_node_visibility");
    return visibility && !visibility->boolean("visible", true);
}

/// Leaves what moves others and what the camera looks from: neither is hidden with a node.
void hide(Node& node)
{
    node.mesh = kNone;
    node.skin = kNone;
    node.light = kNone;
    node.morph_weights.clear();
    node.instances.clear();
}

/// Checks the size of the evaluated scene: a million nodes may share a mesh of a million primitives, and each node of a
/// skinned or morphed mesh gets vertices of its own.
void checkObjects(Document& document, const std::vector<std::uint32_t>& order)
{
    Context& context = document.context();
    std::uint64_t objects = 0;
    for (const std::uint32_t old : order) {
        const Node& node = document.scene.nodes[document.nodes[old]];
        if (node.mesh == kNone) {
            continue;
        }
        const Mesh& mesh = document.scene.meshes[node.mesh];
        const std::uint64_t copies = std::max<std::uint64_t>(node.instances.size(), 1);
        objects += copies * mesh.primitives.size(); // both at most max_count, so far from wrapping
        if (objects > context.limits().max_count) {
            context.failLimit("/nodes/" + std::to_string(old), "the number of objects", "count",
                              context.limits().max_count, objects);
        }
        if (node.skin != kNone || !mesh.morph_weights.empty()) {
            const std::uint64_t vertices = copies * document.vertex_counts[node.mesh];
            context.chargeVertices(vertices, "/nodes/" + std::to_string(old));
            context.chargeBytes(vertices * (2 * sizeof(glm::vec3) + sizeof(glm::vec4)),
                                "/nodes/" + std::to_string(old));
        }
    }
}

} // namespace

void readNodes(Document& document)
{
    const Tree tree = readTree(document);
    std::vector<Node> all;
    std::vector<bool> hidden;
    std::vector<Casting> castings; // the casting that each node itself has
    all.reserve(tree.parents.size());
    for (std::size_t i = 0; i < tree.parents.size(); ++i) {
        all.push_back(readNode(document, nodeView(document, i)));
        hidden.push_back(isHidden(nodeView(document, i)));
        castings.push_back(readCasting(nodeView(document, i)));
    }
    const ScenePart part = pickScene(document, tree, all);
    if (!part.name.empty()) {
        document.scene.name = part.name;
    }
    document.nodes.assign(all.size(), kNone);
    for (const std::uint32_t old : part.nodes) {
        document.nodes[old] = static_cast<std::uint32_t>(document.scene.nodes.size());
        Node& node = all[old];
        const std::uint32_t parent = tree.parents[old];
        node.parent = parent == kNone ? kNone : document.nodes[parent];
        hidden[old] = hidden[old] || (parent != kNone && hidden[parent]);
        castings[old] = parent == kNone ? castings[old] : casting(castings[parent], castings[old]);
        apply(castings[old], node);
        if (hidden[old] || !part.shown[old]) {
            hide(node);
        }
        if (!part.shown[old]) {
            node.camera = kNone;
        }
        document.scene.nodes.push_back(std::move(node));
    }
    checkObjects(document, part.nodes);
}

} // namespace gnomon::scene::gltf
