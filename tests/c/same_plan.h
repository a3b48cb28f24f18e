// SPDX-License-Identifier: Apache-2.0
// Is every number that the C interface shows that of the C++ plan, bit for bit?
#pragma once

#include <gnomon/gnomon.h>
#include <gnomon/planner.h>

namespace gnomon::test {

/// Compares all of the planner's last plan with one of the same frames, and fails where they differ. The numbers of
/// contents differ in their planner's share, which is how they are known apart.
void expectSamePlan(const GnomonPlanner* planner, const GnomonPlan& shown, const Plan& wanted);

/// Compares all buffers that C fills in with those of pack.
void expectSameBuffers(GnomonPlanner* planner, const Plan& plan);
/// Compares the rows of casters of two objects in every view.
void expectSameRows(const GnomonPlanner* planner, const Plan& plan);

/// The C struct of a C++ light, member by member.
[[nodiscard]] GnomonLight lightOf(const Light& light);
/// The C struct of a frame, member by member, without what it points to.
[[nodiscard]] GnomonFrame frameOf(const Frame& frame);

} // namespace gnomon::test
