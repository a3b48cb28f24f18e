// SPDX-License-Identifier: Apache-2.0
// How a shader finds the page of partition virtual that serves a point: a quadtree of words, one walk down from the
// light's root.
#pragma once

#include <gnomon/export.h>
#include <gnomon/plan.h>

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::pack {

/// A light's entries in the table.
inline constexpr std::uint32_t kPageFaces = 6;
/// Fills in the table. First for each light of the plan six entries, by ViewPage::face. A light with one root has it
/// six times. An entry is the place of the root's node, less one, and the plan's view that serves all of the root;
/// zeros: the light has no pages. Then the nodes. A node has two vectors, the lower half and the upper half of its
/// square, each with a word for the left and the right quarter: in its lower 16 bits the view that serves it, counted
/// from the light's first, and in its upper 16 bits how many vectors after its own node the quarter's lies; 0: it has
/// none. Empty where no light has pages. Keeps the memory of `out`.
GNOMON_API void fillPageTable(const Plan& plan, std::vector<glm::uvec2>& out);
/// Does a light with these options have pages, and its views a table?
[[nodiscard]] GNOMON_API bool hasPages(const ResolvedOptions& options);

} // namespace gnomon::pack
