// SPDX-License-Identifier: Apache-2.0
#include "map_storage.h"

#include <gnomon/gl/shadow_renderer.h>
#include <gnomon/pack/map_attachments.h>

namespace gnomon::gl {

MapStorage mapStorage(MapFormat format)
{
    switch (format) {
    case MapFormat::d16:
        return {0, GL_DEPTH_COMPONENT16};
    case MapFormat::d24:
        return {0, GL_DEPTH_COMPONENT24};
    case MapFormat::d32f:
        return {};
    case MapFormat::r8:
        return {GL_R8};
    case MapFormat::r16:
        return {GL_R16};
    case MapFormat::r16f:
        return {GL_R16F};
    case MapFormat::r32f:
        return {GL_R32F};
    case MapFormat::rg8:
        return {GL_RG8};
    case MapFormat::rg16:
        return {GL_RG16};
    case MapFormat::rg16f:
        return {GL_RG16F};
    case MapFormat::rg32f:
        return {GL_RG32F};
    case MapFormat::rgba8:
        return {GL_RGBA8};
    case MapFormat::rgba16:
        return {GL_RGBA16};
    case MapFormat::rgba16f:
        return {GL_RGBA16F};
    case MapFormat::rgba32f:
        return {GL_RGBA32F};
    default: // one that came later
        return {};
    }
}

MapPassFormats mapFormats(const ResolvedOptions& options, bool orthographic)
{
    const pack::MapAttachments made = pack::mapAttachments(options, orthographic);
    return {made.colour ? mapStorage(*made.colour).colour : 0, mapStorage(made.depth).depth, made.samples, made.write_depth};
}

} // namespace gnomon::gl
