// SPDX-License-Identifier: Apache-2.0
// Turns a list of objects into instanced indirect draws, grouped by material batch. No GPU work: it writes plain
// arrays, which are usually mapped memory. Serves shadow casters (caster_drawer.h) and a host's own passes alike.
#pragma once

#include <gnomon/export.h>

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::vulkan {

/// One triangle list inside the shared index and vertex buffers.
struct MeshRange {
    std::uint32_t first_index = 0;  // in the index buffer
    std::uint32_t index_count = 0;  // three to a triangle
    std::int32_t vertex_offset = 0; // added to each index
};

/// A mesh drawn with one material. The caller groups by `batch` as it likes (material, pipeline); batches come out in
/// ascending order.
struct DrawPart {
    MeshRange mesh;          // the mesh
    std::uint32_t batch = 0; // its material, pipeline, ...
};

/// The parts that an object draws: a range. Objects that name the same parts become instances of one draw. A count of 0
/// draws nothing.
struct DrawObject {
    std::uint32_t first_part = 0; // index into setScene()'s parts
    std::uint32_t part_count = 0; // 0 draws nothing
};

/// Consecutive commands of one batch: one vkCmdDrawIndexedIndirect.
struct BatchDraws {
    std::uint32_t batch = 0;         // DrawPart::batch
    std::uint32_t first_command = 0; // counted from the first command of the build() call
    std::uint32_t command_count = 0; // at least 1
};

/// The result of build().
struct DrawLists {
    std::span<const BatchDraws> batches; // ascending by batch; valid until the next call of the batcher
    std::uint32_t command_count = 0;     // indirect commands
    std::uint32_t instance_count = 0;    // objects, each as often as it has parts
    std::uint64_t index_count = 0;       // over all instances: three times the triangles
};

/// Deterministic; allocates in setScene() alone. Not thread-safe.
class GNOMON_API DrawBatcher {
public:
    /// Sets the scene and copies all that it needs. Ranges of `objects` must lie inside `parts`, else Error.
    void setScene(std::span<const DrawPart> parts, std::span<const DrawObject> objects);

    /// Instances that build() will write for this list. O(list).
    [[nodiscard]] std::uint32_t instanceCount(std::span<const std::uint32_t> list) const;
    /// Commands that build() writes at most, for any list.
    [[nodiscard]] std::uint32_t maxCommands() const { return static_cast<std::uint32_t>(parts_.size()); }

    /// Writes one command per part in use and, for each of its instances, the object's index; instances of a part are
    /// consecutive and in the list's order. Command i of the result starts at instance `first_instance` + its place, so
    /// several lists can share one buffer. Indices beyond setScene()'s objects draw nothing. `commands` and `instances`
    /// must be large enough, else Error; the caller binds instance data from them as it likes: as an instance-rate
    /// attribute, or as a storage buffer read at gl_InstanceIndex. An object may be listed more than once. `places`:
    /// writes each instance's place in the list instead of the object's index.
    DrawLists build(std::span<const std::uint32_t> list, std::uint32_t first_instance,
                    std::span<VkDrawIndexedIndirectCommand> commands, std::span<std::uint32_t> instances,
                    bool places = false);

private:
    std::vector<DrawPart> parts_;
    std::vector<DrawObject> objects_;
    std::vector<std::uint32_t> order_;  // part indices, ascending by batch
    std::vector<std::uint32_t> cursor_; // per part: instances counted, then where the next one goes
    std::vector<BatchDraws> batches_;
};

} // namespace gnomon::vulkan
