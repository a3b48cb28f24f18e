// SPDX-License-Identifier: Apache-2.0
// Makes a visibility mask from a Plan by OpenGL 4.5: draws shadow maps and the mask in the context that is current.
// Never makes a context, never swaps, never waits for the GPU.
#pragma once

#include <gnomon/export.h>
#include <gnomon/options.h>
#include <gnomon/plan.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace gnomon::gl {

/// How a ShadowRenderer is made.
struct ShadowRendererOptions {
    /// Gives the context's function with this name, as eglGetProcAddress() and its like do; never null.
    void* (*get_proc_address)(const char* name) = nullptr;
    /// Does a software rasteriser draw? Shaders are made otherwise then, which is quicker there and slower on a GPU.
    /// Nothing: GL_RENDERER is asked for "llvmpipe" or "softpipe".
    std::optional<bool> in_software;
};

/// The host's inputs of the mask: names of 2D textures with at least one level, of size `size_px`. Row 0 of each is
/// where clip space's y is -1, as in a framebuffer that OpenGL has drawn.
struct MaskInputs {
    glm::uvec2 size_px{0}; // size of the mask, and of each texture here
    /// The camera's depth: a depth format, with stencil or without, or R32F. The automatic bias allows for the
    /// rounding of its format.
    std::uint32_t depth = 0;
    /// Geometric world-space normals, octahedral in RG (snorm or float; gnomon/shared/octahedral.h), or 0: then taken
    /// from depth.
    std::uint32_t normal = 0;
    /// For smooth-shaded meshes: the result of gnomonSmoothEncode() (gnomon/smooth_surface.glsl), RGB of 16 bits (snorm
    /// or float). 0: the geometric normal decides whether a surface faces a light.
    std::uint32_t smooth = 0;
    /// Index of the object in Frame::objects + 1, in R32UI, 0 where a receiver wants no shadow at all; 0: everything
    /// receives.
    std::uint32_t object_id = 0;
};

/// How a view's casters are drawn. Formats are OpenGL's (GL_DEPTH_COMPONENT32F).
struct MapPassFormats {
    std::uint32_t colour = 0;  // 0: depth only. Else the fragment shader writes gnomonCasterTexel() (gnomon/caster.glsl)
    std::uint32_t depth = 0;   // of the depth attachment
    std::uint32_t samples = 1; // of both attachments
    /// View not orthographic, into a depth-only map: gl_FragDepth = metric. With more than one sample, give the
    /// metric the qualifier `sample`, in both stages.
    bool write_frag_depth = false;

    bool operator==(const MapPassFormats&) const = default;
};

/// One map to draw, given to the host's callback. Its framebuffer is bound and cleared, viewport and scissor are set,
/// depth is tested by GL_LEQUAL and written, near planes clamp where ViewProjection::clamp_near says so (GL_DEPTH_CLAMP),
/// clip space is GL_LOWER_LEFT and GL_ZERO_TO_ONE; no culling, blending or stencil. The callback binds program, vertex
/// array, textures and buffers, and draws. It leaves the rest as it is.
struct MapPass {
    MapPassFormats formats;       // mapFormats() of the light's options and ViewProjection::orthographic
    const Plan* plan = nullptr;   // never null
    const View* view = nullptr;   // never null
    std::uint32_t view_index = 0; // its place in Plan::views
    /// Object indices: all that must be drawn; for a map that is kept in two parts either the still ones or the moving
    /// ones.
    std::span<const std::uint32_t> casters;
    glm::mat4 clip_from_world{1.0F}; // the view's, for vertices in world space; pack::CasterRows is more exact
    glm::vec4 metric_ws{0.0F};       // d' = dot(metric_ws, (p, 1))
};
/// Draws one map's casters.
using DrawCasters = std::function<void(const MapPass&)>;

/// The formats that views with these options are drawn in. `orthographic`: ViewProjection::orthographic.
[[nodiscard]] GNOMON_API MapPassFormats mapFormats(const ResolvedOptions& options, bool orthographic);

/// A texture of the renderer's, a 2D array. Holds until the next prepare().
struct TextureRef {
    std::uint32_t texture = 0; // 0: there is none
    std::uint32_t format = 0;  // its internal format
    glm::uvec2 size_px{0};     // texels
    std::uint32_t layers = 0;  // array layers
    std::uint32_t levels = 0;  // mip levels
};

/// The maps that one drawMaps() drew, and those that it did not have to.
struct MapReuse {
    std::uint32_t drawn = 0;      // maps drawn at once
    std::uint32_t kept_drawn = 0; // maps of still casters, drawn into their kept layers
    std::uint32_t restored = 0;   // maps restored from a kept layer, with moving casters drawn over it
    std::uint32_t held = 0;       // maps left as they were
};

/// Draws a plan by the options that the plan carries (Plan::options). Not thread-safe; its context is current in every
/// call, the destructor's too.
///
/// A call restores the state that it changes: framebuffers, program, vertex array, viewport, scissor, clip control,
/// depth, blending and write masks of draw buffer 0, polygon mode and the switches of GL_DEPTH_TEST and its like. It
/// leaves changed, to be bound anew by who needs them: texture units 0 to 11, image units 0 to 2, the uniform buffers 0,
/// 4, 8 and 13, and the storage buffers 1 to 5 and 12. These texture units have no sampler object afterwards, nor in the
/// callback. Errors that glGetError() holds when prepare() is called are lost.
///
/// Throws Error from prepare() for what it does not do, with a sentence: partition sdsm and paraboloid, classic filters
/// (id, depth-id, smoothies, volumes), soften smoothies and converge, motion step-alternate, caster-faces midpoint,
/// cascades.pass=layered, mask-size=half and blur-path=fragment; and for a plan whose numbers point beyond its own
/// lists, sizes beyond the context's limits, and memory that is gone. A callback obeys ShadowOptions::faces and cull by
/// itself. A call that throws leaves state as it was; all maps are drawn again afterwards.
class GNOMON_API ShadowRenderer {
public:
    /// Throws Error when the context is older than OpenGL 4.5, lacks a function, or has a limit that is too low.
    explicit ShadowRenderer(const ShadowRendererOptions& options);
    /// Deletes its textures, buffers and programs.
    ~ShadowRenderer();
    ShadowRenderer(const ShadowRenderer&) = delete;
    ShadowRenderer& operator=(const ShadowRenderer&) = delete;

    /// Makes textures and buffers for this plan and size where the existing ones do not fit; no mask for size 0, for a
    /// host that shades from the maps. Larger textures take over what maps held. True when maps() or mask() is another
    /// texture than before.
    bool prepare(const Plan& plan, glm::uvec2 size_px);
    /// Draws the maps that are out of date: the parts in ViewContents::redraw and ViewContents::dirty, and all of a map
    /// whose contents are not ViewContents::presumes. Throws Error for a plan that needs other textures than the last
    /// prepare() made, and for a null callback.
    void drawMaps(const Plan& plan, const DrawCasters& draw);
    /// Draws the mask: every layer, every channel, 1 = fully lit; its values are those of vulkan::ShadowRenderer. Throws
    /// Error for such a plan too, and where the depth is 0, or the size of an input another one than prepare()'s.
    void drawMask(const Plan& plan, const MaskInputs& inputs);
    /// The contents of maps are lost: the next drawMaps() draws all of them again.
    void reset();

    /// R8 for one light, else RGBA8, one layer per four lights and one for each coloured light
    /// (LightPlan::mask_layer). Row 0 is that of the inputs.
    [[nodiscard]] TextureRef mask() const;
    /// The maps of one of the plan's options; empty where no light of the plan names them.
    [[nodiscard]] TextureRef maps(std::uint32_t options = 0) const;
    /// The maps that the last drawMaps() drew and kept.
    [[nodiscard]] MapReuse reuse() const;

private:
    struct GNOMON_LOCAL Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace gnomon::gl
