// SPDX-License-Identifier: Apache-2.0
#include "gltf/scene_part.h"

namespace gnomon::scene::gltf {

namespace {

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

std::vector<std::uint32_t> treeRoots(const Tree& tree)
{
    std::vector<std::uint32_t> roots;
    for (std::uint32_t i = 0; i < tree.parents.size(); ++i) {
        if (tree.parents[i] == kNone) {
            roots.push_back(i);
        }
    }
    return roots;
}

/// Every node has at most one parent here, so a loop is what no root leads to.
void refuseLoops(const Document& document, const Tree& tree)
{
    std::vector<bool> reached(tree.parents.size(), false);
    for (const std::uint32_t node : parentsFirst(document, tree, treeRoots(tree))) {
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

/// The nodes that the scene to show names: of `scene`, else of the first, else every node without a parent.
std::vector<std::uint32_t> namedNodes(const Document& document, const Tree& tree, std::string& name)
{
    const std::size_t scene_count = topLevelCount(document, "scenes");
    const std::uint32_t shown = document.root.index("scene", scene_count);
    if (scene_count == 0) {
        return treeRoots(tree);
    }
    std::vector<std::uint32_t> named;
    for (std::size_t s = 0; s < scene_count; ++s) {
        const JsonView view = document.root.at("scenes").element(s);
        checkExtensions(view, Place::other);
        const bool picked = s == (shown == kNone ? 0 : shown);
        const std::string scene_name = view.string("name", "");
        name = picked ? scene_name : name;
        const std::optional<JsonView> nodes = view.find("nodes");
        const std::size_t count = nodes ? nodes->size() : 0;
        std::set<std::uint32_t> seen;
        for (std::size_t i = 0; i < count; ++i) {
            const JsonView where = nodes->element(i);
            const std::uint32_t node = where.index(tree.parents.size());
            const bool first = seen.insert(node).second;
            if (!picked) {
                continue;
            }
            if (!first) {
                view.context().notice("scene " + view.pointer() + " names a node twice; it is shown once");
                continue;
            }
            if (tree.parents[node] != kNone) {
                view.context().notice("scene " + view.pointer() +
                                      " names children of other nodes; each is shown once, where its parents place it");
            }
            named.push_back(node);
        }
    }
    return named;
}

/// The trees that `nodes` are in, each once.
void addTrees(const Tree& tree, const std::vector<std::uint32_t>& nodes, std::vector<bool>& known,
              std::vector<std::uint32_t>& roots)
{
    for (std::uint32_t node : nodes) {
        while (tree.parents[node] != kNone) {
            node = tree.parents[node];
        }
        if (!known[node]) {
            known[node] = true;
            roots.push_back(node);
        }
    }
}

/// Joints of the skins of what is shown.
std::vector<std::uint32_t> jointsOf(const Document& document, const std::vector<Node>& all,
                                    const std::vector<bool>& shown)
{
    std::set<std::uint32_t> skins;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (shown[i] && all[i].skin != kNone) {
            skins.insert(all[i].skin);
        }
    }
    std::vector<std::uint32_t> out;
    for (const std::uint32_t skin : skins) {
        const JsonView joints = document.root.at("skins").element(skin).at("joints");
        const std::size_t count = joints.size();
        for (std::size_t i = 0; i < count; ++i) {
            out.push_back(joints.element(i).index(all.size()));
        }
    }
    return out;
}

} // namespace

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
    refuseLoops(document, tree);
    return tree;
}

ScenePart pickScene(const Document& document, const Tree& tree, const std::vector<Node>& all)
{
    ScenePart part{{}, {}, std::vector<bool>(all.size(), false)};
    const std::vector<std::uint32_t> named = namedNodes(document, tree, part.name);
    for (const std::uint32_t node : named) {
        part.shown[node] = true;
    }
    std::vector<bool> known(all.size(), false);
    std::vector<std::uint32_t> roots;
    addTrees(tree, named, known, roots);
    for (const std::uint32_t node : parentsFirst(document, tree, roots)) {
        const std::uint32_t parent = tree.parents[node];
        part.shown[node] = part.shown[node] || (parent != kNone && part.shown[parent]);
    }
    const std::vector<std::uint32_t> joints = jointsOf(document, all, part.shown);
    std::vector<bool> needed = part.shown;
    for (const std::uint32_t joint : joints) {
        if (!part.shown[joint]) {
            document.context().notice(
                "skins of what is shown have joints outside the scene; they move it all the same");
        }
        needed[joint] = true;
    }
    addTrees(tree, joints, known, roots);
    std::vector<std::uint32_t> order = parentsFirst(document, tree, roots);
    for (std::size_t i = order.size(); i-- > 0;) {
        if (const std::uint32_t parent = tree.parents[order[i]]; parent != kNone && needed[order[i]]) {
            needed[parent] = true;
        }
    }
    std::erase_if(order, [&](std::uint32_t node) { return !needed[node]; });
    part.nodes = std::move(order);
    return part;
}

} // namespace gnomon::scene::gltf
