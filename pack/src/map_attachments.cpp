// SPDX-License-Identifier: Apache-2.0
#include <gnomon/pack/map_attachments.h>

#include <gnomon/plan_views.h>

namespace gnomon::pack {

MapAttachments mapAttachments(const ResolvedOptions& options, bool orthographic)
{
    MapAttachments out;
    if (options.filterable()) { // moments are made of the depths
        out.samples = options.moments().samples;
        out.write_depth = !orthographic;
        return out;
    }
    const MapFormat format = options.format();
    if (isDepth(format)) {
        out.depth = format;
    } else {
        out.colour = format;
        out.clear_colour = options.traits().ids ? 0.0F : 1.0F; // 0: no object
    }
    const bool paraboloid = options.technique().partition == Partition::paraboloid; // the rasteriser's own says nothing
    const bool over_w = options.metric() == DepthMetricKind::z_over_w;              // the rasteriser's own
    out.write_depth = paraboloid || (!out.colour && !orthographic && !over_w);
    return out;
}

MapAttachments mapAttachments(const Plan& plan, const View& view)
{
    return mapAttachments(optionsOf(plan, view), view.projection.orthographic);
}

std::uint32_t channelsOfPart(MapFormat format, TexelPart part)
{
    constexpr std::uint32_t kAll = 0xF;
    const bool is_first = part == TexelPart::first;
    if (part != TexelPart::whole && (format == MapFormat::rg16 || format == MapFormat::rg16f)) {
        return is_first ? 0x1 : 0x2;
    }
    if (part != TexelPart::whole && format == MapFormat::rgba8) {
        return is_first ? 0x3 : 0xC;
    }
    return kAll;
}

} // namespace gnomon::pack
