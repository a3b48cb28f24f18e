// SPDX-License-Identifier: Apache-2.0
// From a Frame to a Plan. Keeps which maps the lights have and what these hold, how far suns that move in steps have
// got, what partition and fit auto came to, where lights take turns the views of the plan before, for soften=converge
// where every object was, and its scratch memory; nothing else.
#pragma once

#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <memory>
#include <span>

namespace gnomon {

/// Deterministic: the same frames and options give the same plans, bit for bit. Not thread-safe; make one per thread.
/// One that was moved from refuses every light.
class GNOMON_API Planner {
public:
    Planner(); // of the default options
    /// Options that resolve() refuses are no error: every light that names them gets Outcome refused with that
    /// sentence, as does a light whose own type does not go with the technique.
    explicit Planner(const ShadowOptions& options);
    /// Several options, of which each light names its own (Light::options). Of none at all every light is refused.
    explicit Planner(std::span<const ShadowOptions> options);
    ~Planner();
    Planner(Planner&&) noexcept;            // the other one refuses every light then
    Planner& operator=(Planner&&) noexcept; // the other one refuses every light then

    /// The plan holds until the next call. Allocates nothing once warm (same counts as before). Whatever the frame's
    /// numbers are: what cannot be planned is said by the lights' outcomes (degenerate: not finite, without size, or so
    /// far apart that doubles cannot tell what lies between), and no light ruins another's maps.
    ///
    /// The planner takes it that its plans are drawn, one after the other. A backend that compares
    /// ViewContents::presumes with what it drew needs no more. One that doesn't says what it has not, or no longer:
    /// lost() or reset().
    ///
    /// Throws std::bad_alloc when memory runs out. The last plan is gone then, and the next call plans as if this frame
    /// had not been, as a rule after reset().
    [[nodiscard]] const Plan& plan(const Frame& frame);
    /// A map's texels are gone, or were not drawn: it is drawn whole when it is read next. A name of old is no error.
    void lost(const MapId& map);
    /// All maps are lost, and what partition and fit auto came to is found anew. Suns go on in their steps.
    void reset();
    /// Those that Light::options = `index` stands for, as they were asked for; beyond them, default ones.
    [[nodiscard]] const ShadowOptions& options(std::uint32_t index = 0) const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
