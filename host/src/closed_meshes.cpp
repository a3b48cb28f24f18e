// SPDX-License-Identifier: Apache-2.0
#include "closed_meshes.h"

#include "host/view.h"

#include <algorithm>
#include <string_view>

namespace gnomon::host {
namespace {

enum class Fault : std::uint8_t { none, masked, blended, cut, open };

scene::AlphaMode alphaOf(const scene::Scene& scene, std::uint32_t material)
{
    return material < scene.materials.size() ? scene.materials[material].alpha_mode : scene::AlphaMode::opaque;
}

bool isOpaque(const scene::Scene& scene, const scene::Mesh& mesh)
{
    return std::ranges::all_of(mesh.primitives, [&](const scene::Primitive& primitive) {
        return alphaOf(scene, primitive.material) == scene::AlphaMode::opaque;
    });
}

/// The reason why an object's shadow does not have its mesh's outline.
Fault outlineFaultOf(const scene::Scene& scene, const scene::Object& object)
{
    const scene::AlphaMode alpha = alphaOf(scene, object.material);
    if (alpha != scene::AlphaMode::opaque) {
        return alpha == scene::AlphaMode::blend ? Fault::blended : Fault::masked;
    }
    return object.clip_planes != scene::kNoClipPlanes ? Fault::cut : Fault::none;
}

/// A primitive that is open alone may be closed by the mesh's others, which then have to cast as it does.
Fault faultOf(const scene::Scene& scene, const scene::Object& object, const scene::MeshClosure& closure)
{
    if (const Fault fault = outlineFaultOf(scene, object); fault != Fault::none) {
        return fault;
    }
    const bool closed = closure.open_edges_of[object.primitive] == 0 ||
                        (closure.closed() && isOpaque(scene, scene.meshes[object.mesh]));
    return closed ? Fault::none : Fault::open;
}

std::string sentenceOf(Fault fault, std::uint32_t open_edges)
{
    switch (fault) {
    case Fault::masked:
        return "is masked";
    case Fault::blended:
        return "is blended";
    case Fault::cut:
        return "is cut by clip planes";
    default:
        return "is open: " + std::to_string(open_edges) + " of its edges have one triangle";
    }
}

std::string_view named(const std::string& name)
{
    return name.empty() ? std::string_view("without a name") : std::string_view(name);
}

void note(const scene::Scene& scene, const scene::Object& object, Fault fault, std::uint32_t open_edges,
          VolumeFaults& out)
{
    if (!object.casts || fault == Fault::none) {
        return;
    }
    std::string sentence = "mesh ";
    sentence += named(scene.meshes[object.mesh].name);
    sentence += ' ';
    sentence += sentenceOf(fault, open_edges);
    ++out.objects;
    if (std::ranges::find(out.sentences, sentence) == out.sentences.end()) {
        out.sentences.push_back(std::move(sentence));
    }
}

} // namespace

bool isClosed(const scene::Mesh& mesh)
{
    return scene::closureOf(mesh).closed();
}

std::vector<scene::MeshClosure> closures(const scene::Scene& scene)
{
    std::vector<scene::MeshClosure> found;
    for (const scene::Mesh& mesh : scene.meshes) {
        found.push_back(scene::closureOf(mesh));
    }
    return found;
}

std::vector<bool> closedMeshes(const scene::Scene& scene)
{
    std::vector<bool> closed;
    for (const scene::MeshClosure& closure : closures(scene)) {
        closed.push_back(closure.closed());
    }
    return closed;
}

std::vector<std::uint8_t> closedObjects(const scene::Scene& scene, const scene::State& state,
                                        const std::vector<scene::MeshClosure>& closures)
{
    std::vector<std::uint8_t> closed;
    closed.reserve(state.objects.size());
    for (const scene::Object& object : state.objects) {
        closed.push_back(faultOf(scene, object, closures[object.mesh]) == Fault::none ? 1 : 0);
    }
    return closed;
}

std::vector<std::uint8_t> closedObjects(const scene::Scene& scene, const scene::State& state)
{
    return closedObjects(scene, state, closures(scene));
}

VolumeFaults volumeFaults(const scene::Scene& scene, const scene::State& state)
{
    const std::vector<scene::MeshClosure> found = closures(scene);
    VolumeFaults open;
    for (const scene::Object& object : state.objects) {
        const scene::MeshClosure& closure = found[object.mesh];
        note(scene, object, faultOf(scene, object, closure), closure.open_edges_of[object.primitive], open);
    }
    return open;
}

std::vector<std::uint8_t> outlinedObjects(const scene::Scene& scene, const scene::State& state)
{
    std::vector<std::uint8_t> outlined;
    outlined.reserve(state.objects.size());
    for (const scene::Object& object : state.objects) {
        outlined.push_back(outlineFaultOf(scene, object) == Fault::none ? 1 : 0);
    }
    return outlined;
}

VolumeFaults finFaults(const scene::Scene& scene, const scene::State& state)
{
    VolumeFaults without;
    for (const scene::Object& object : state.objects) {
        note(scene, object, outlineFaultOf(scene, object), 0, without);
    }
    return without;
}

} // namespace gnomon::host
