// SPDX-License-Identifier: Apache-2.0
// The two opaque types of the C interface.
#pragma once

#include "flat_plan.h"
#include "structs.h"

#include <gnomon/object_set.h>
#include <gnomon/planner.h>

#include <glm/vec2.hpp>

#include <string>
#include <vector>

struct GnomonObjects {
    gnomon::ObjectSet set;
};

struct GnomonPlanner {
    std::vector<gnomon::ShadowOptions> options{{}}; // as they are asked for now
    std::vector<gnomon::ShadowOptions> planned{{}}; // as the planner was made of
    gnomon::Planner planner;
    gnomon::c::FrameTaker frame;
    const gnomon::Plan* plan = nullptr; // the last one; null: there is none
    gnomon::c::FlatPlan flat;           // of that plan
    std::string json;                   // of some plan
    std::vector<glm::uvec2> page_table; // of that plan, once it was asked for
    bool has_page_table = false;        // it was
};

namespace gnomon::c {

/// A planner that has a plan. Throws WrongCall where it has none.
template <class Handle>
Handle& planned(Handle* planner)
{
    Handle& own = required(planner, "planner");
    if (own.plan == nullptr) {
        throw WrongCall{"the planner has no plan", "call gnomonPlan() first"};
    }
    return own;
}

} // namespace gnomon::c
