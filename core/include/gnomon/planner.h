// SPDX-License-Identifier: Apache-2.0
// Makes a Plan from a Frame. Keeps the lights' maps and their contents, the steps of suns, the choices of partition and
// fit auto, the views of the last plan where lights take turns, every object's last bounds for soften=converge, and its
// scratch memory; nothing else.
#pragma once

#include <gnomon/export.h>
#include <gnomon/frame.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <memory>
#include <span>

namespace gnomon {

/// Deterministic: the same frames and options give the same plans, bit for bit. Not thread-safe; make one per thread.
/// A planner that was moved from refuses every light.
class GNOMON_API Planner {
public:
    Planner(); // with the default options
    /// Options that resolve() refuses are no error: every light that names them gets Outcome refused with that
    /// sentence, as does a light whose own type does not go with the technique.
    explicit Planner(const ShadowOptions& options);
    /// Several options; each light names its own (Light::options). Every light is refused where `options` is empty.
    explicit Planner(std::span<const ShadowOptions> options);
    ~Planner();
    Planner(Planner&&) noexcept;            // the other one refuses every light then
    Planner& operator=(Planner&&) noexcept; // the other one refuses every light then

    /// The plan holds until the next call. Allocates nothing once warm (same counts as before). Accepts any numbers in
    /// a frame: the outcome of a light says why it cannot be planned (degenerate: not finite, without size, or so far
    /// apart that doubles cannot tell what lies between), and no light spoils the maps of another.
    ///
    /// The planner assumes that its plans are drawn, one after the other. A backend that compares
    /// ViewContents::presumes with what it drew needs no more. Another backend calls lost() or reset() for maps that it
    /// did not draw or no longer has.
    ///
    /// Throws std::bad_alloc when memory runs out. The last plan is gone then. The next call plans as if this frame had
    /// not been, in most cases as after reset().
    [[nodiscard]] const Plan& plan(const Frame& frame);
    /// A map's texels are gone, or were not drawn: it is drawn whole when it is read next. The name of a map that is
    /// gone is no error.
    void lost(const MapId& map);
    /// All maps are lost, and partition and fit auto choose anew. Suns go on in their steps.
    void reset();
    /// The options that Light::options = `index` names, as they were asked for; the default ones beyond them.
    [[nodiscard]] const ShadowOptions& options(std::uint32_t index = 0) const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon
