// SPDX-License-Identifier: Apache-2.0
#include "gltf/instancing.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene::gltf {

namespace {

/// The node tree of the whole file, before a scene is picked.
struct Tree {
    std::vector<std::vector<std::uint32_t>> children;
    std::vector<std::uint32_t> parents;
};

JsonView nodeView(const Document& document, std::size_t i)
{
    return document.root.at("nodes").element(i);
}

Tree readTree(const Document& document)
{
    const std::size_t count = topLevelCount(document, "nodes");
    Tree tree{std::vector<std::vector<std::uint32_t>>(count), std::vector<std::uint32_t>(count, kNone)};
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<JsonView> children = nodeView(document, i).find("children");
        const std::size_t child_count = children ? children->size() : 0;
        for (std::size_t k = 0; k < child_count; ++k) {
            const JsonView where = children->element(k);
            const std::uint32_t child = where.index(count);
            if (tree.parents[child] != kNone) {
                where.failFound("node " + std::to_string(child) + " has two parents",
                                std::to_string(tree.parents[child]) + " and " + std::to_string(i));
            }
            tree.parents[child] = static_cast<std::uint32_t>(i);
            tree.children[i].push_back(child);
        }
    }
    return tree;
}

/// Nodes below `roots`, parents first, and no deeper than the limit.
std::vector<std::uint32_t> parentsFirst(const Document& document, const Tree& tree,
                                        const std::vector<std::uint32_t>& roots)
{
    const std::uint32_t limit = document.context().limits().max_node_depth;
    std::vector<std::uint32_t> order = roots;
    std::size_t level_end = order.size();
    std::uint32_t depth = 1;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == level_end) {
            level_end = order.size();
            ++depth;
        }
        if (depth > limit) {
            document.context().failLimit(nodeView(document, order[i]).pointer(), "the depth of the node tree",
                                         "node-depth", limit, depth);
        }
        order.insert(order.end(), tree.children[order[i]].begin(), tree.children[order[i]].end());
    }
    return order;
}

/// Every node has at most one parent here, so a loop is what no root leads to.
void refuseLoops(const Document& document, const Tree& tree)
{
    std::vector<std::uint32_t> roots;
    for (std::uint32_t i = 0; i < tree.parents.size(); ++i) {
        if (tree.parents[i] == kNone) {
            roots.push_back(i);
        }
    }
    std::vector<bool> reached(tree.parents.size(), false);
    for (const std::uint32_t node : parentsFirst(document, tree, roots)) {
        reached[node] = true;
    }
    for (std::uint32_t i = 0; i < reached.size(); ++i) {
        if (reached[i]) {
            continue;
        }
        std::uint32_t node = i; // walk up for long enough to be on the loop itself
        for (std::size_t step = 0; step < reached.size(); ++step) {
            node = tree.parents[node];
        }
        nodeView(document, node).failFound("the node is part of a loop", "its own descendant as its parent");
    }
}

/// Roots of the scene to show: `scene`, else the first, else every node without a parent.
std::vector<std::uint32_t> sceneRoots(const Document& document, const Tree& tree, std::string& name)
{
    const std::size_t scene_count = topLevelCount(document, "scenes");
    const std::uint32_t shown = document.root.index("scene", scene_count);
    std::vector<std::uint32_t> roots;
    if (scene_count == 0) {
        for (std::uint32_t i = 0; i < tree.parents.size(); ++i) {
            if (tree.parents[i] == kNone) {
                roots.push_back(i);
            }
        }
        return roots;
    }
    for (std::size_t s = 0; s < scene_count; ++s) {
        const JsonView view = document.root.at("scenes").element(s);
        checkExtensions(view, Place::other);
        const std::string scene_name = view.string("name", "");
        const std::optional<JsonView> nodes = view.find("nodes");
        const std::size_t count = nodes ? nodes->size() : 0;
        std::set<std::uint32_t> seen;
        for (std::size_t i = 0; i < count; ++i) {
            const JsonView where = nodes->element(i);
            const std::uint32_t node = where.index(tree.parents.size());
            if (tree.parents[node] != kNone) {
                where.fail("a scene's node must be a root, but it is a child of node " +
                           std::to_string(tree.parents[node]));
            }
            if (!seen.insert(node).second) {
                where.fail("the scene names a node twice");
            }
            if (s == (shown == kNone ? 0 : shown)) {
                roots.push_back(node);
                name = scene_name;
            }
        }
    }
    return roots;
}

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

/// What glTF leaves to applications. Ours: {"clip_planes": [[a, b, c, d]]} leaves of the node's mesh what has
/// a x + b y + c z + d >= 0, for each of up to two planes.
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
    if (const std::optional<JsonView> pointer = extension(view, "KHR_node_visibility")) {
        if (!pointer->boolean("visible", true)) {
            document.context().notice("node " + view.pointer() + " is shown, KHR_node_visibility has no effect");
        }
    }
    node.instances = readInstances(document, view);
    readExtras(view, node);
    return node;
}

/// What evaluating the scene will ask for: a million nodes may share a mesh of a million primitives, and each node of
/// a skinned or morphed mesh gets vertices of its own.
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
    refuseLoops(document, tree);
    std::vector<Node> all;
    all.reserve(tree.parents.size());
    for (std::size_t i = 0; i < tree.parents.size(); ++i) {
        all.push_back(readNode(document, nodeView(document, i)));
    }
    std::string name;
    const std::vector<std::uint32_t> order = parentsFirst(document, tree, sceneRoots(document, tree, name));
    if (!name.empty()) {
        document.scene.name = name;
    }
    document.nodes.assign(all.size(), kNone);
    for (const std::uint32_t old : order) {
        document.nodes[old] = static_cast<std::uint32_t>(document.scene.nodes.size());
        Node& node = all[old];
        node.parent = tree.parents[old] == kNone ? kNone : document.nodes[tree.parents[old]];
        document.scene.nodes.push_back(std::move(node));
    }
    checkObjects(document, order);
}

} // namespace gnomon::scene::gltf
