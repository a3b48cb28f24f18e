// SPDX-License-Identifier: Apache-2.0
// lvsm's layers of depth for `gnomon plan`.
#pragma once

#include "app/shot.h"
#include "result_json.h"

#include <memory>

namespace gnomon::app {

/// It does nothing for other filters, and needs no GPU where layers do not depend on drawn depths.
class PlanLayers {
public:
    /// Opens the GPU where layers follow drawn depths. Throws Error.
    PlanLayers(const Settings& settings, const Shot& shot);
    ~PlanLayers();
    PlanLayers(const PlanLayers&) = delete;
    PlanLayers& operator=(const PlanLayers&) = delete;

    /// Takes the next frame, and draws it where needed: layers follow from frame to frame.
    void follow(const Shot& shot);
    /// Adds "layers" to each view of the last frame.
    void describe(const Plan& plan, Json& views) const;

private:
    struct Drawing;
    const Settings& settings_;
    std::unique_ptr<Drawing> drawing_;
};

} // namespace gnomon::app
