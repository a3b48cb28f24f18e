// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_EDGE_LINE_GLSL
#define GNOMON_EDGE_LINE_GLSL
#include "filter_types.glsl"
GN_BEGIN
GN_CONST int kEdgeRun = 12;
GN_FN real edgeLit(MapPoint point, FilterInput f, real2 cell)
{
    return compareTexel(point, cell + real2(real(0.5)) - point.texel, mapTexel(cell, f.layer, f.part));
}
GN_FN real2 edgeCell(bool along_x, real u, real v)
{
    return along_x ? real2(u, v) : real2(v, u);
}
struct EdgeFound {
    real run; // 0: none
    real visibility;
};
GN_FN EdgeFound findEdge(MapPoint point, FilterInput f, bool along_x, real centre)
{
    EdgeFound found;
    found.run = real(0.0);
    found.visibility = centre;
    real pu = along_x ? point.texel.x : point.texel.y;
    real pv = along_x ? point.texel.y : point.texel.x;
    real col = floor(pu);
    real row = floor(pv);
    real part = pv - row;
    real low1 = edgeLit(point, f, edgeCell(along_x, col, row - real(1.0)));
    real high1 = edgeLit(point, f, edgeCell(along_x, col, row + real(1.0)));
    real low2 = edgeLit(point, f, edgeCell(along_x, col, row - real(2.0)));
    real high2 = edgeLit(point, f, edgeCell(along_x, col, row + real(2.0)));
    real to_low = low1 != centre ? part : (low2 != centre ? part + real(1.0) : real(9.0));
    real to_high = high1 != centre ? real(1.0) - part : (high2 != centre ? real(2.0) - part : real(9.0));
    if (min(to_low, to_high) > real(3.0)) {
        return found;
    }
    bool is_low = to_low <= to_high;
    real h = is_low ? (low1 != centre ? row : row - real(1.0)) : (high1 != centre ? row + real(1.0) : row + real(2.0));
    real above = is_low ? real(1.0) - centre : centre; // of v < h
    real below = real(1.0) - above;
    real2 ends = real2(real(0.0));
    real2 steps = real2(real(0.0));
    for (int side = 0; side < 2; ++side) {
        real way = side == 0 ? real(-1.0) : real(1.0);
        real k = real(1.0);
        bool more = true;
        real step_here = real(0.0);
        do {
            real t = edgeLit(point, f, edgeCell(along_x, col + way * k, h - real(1.0)));
            real b = edgeLit(point, f, edgeCell(along_x, col + way * k, h));
            bool goes_on = t == above && b == below;
            step_here = goes_on || (t == below && b == above) ? real(0.0) : (t == below ? real(-1.0) : real(1.0));
            more = goes_on && k < real(kEdgeRun);
            k += real(1.0);
        } while (more);
        k -= real(1.0);
        if (side == 0) {
            ends.x = col - k + real(1.0);
            steps.x = step_here;
        } else {
            ends.y = col + k;
            steps.y = step_here;
        }
    }
    real run = ends.y - ends.x;
    real at_low = h + real(0.5) * steps.x;
    real at_high = h + real(0.5) * steps.y;
    real e = h;
    real slope = real(0.0);
    if (steps.x * steps.y < real(0.0)) {
        slope = (at_high - at_low) / run;
        e = at_low + slope * (pu - ends.x);
    } else {
        real middle = real(0.5) * (ends.x + ends.y);
        real half_run = real(0.5) * run;
        slope = pu < middle ? (h - at_low) / half_run : (at_high - h) / half_run;
        e = h + slope * (pu - middle);
    }
    real stored = mapTexel(edgeCell(along_x, col, above < below ? h - real(1.0) : h), f.layer, f.part);
    real gap = max(point.depth - stored, real(0.0)) / max(point.texel_depth, real(1e-12));
    real width = clamp(real(2.0) * gap * f.spread / length(f.toward), real(0.7), real(6.0));
    real d = (pv - e) / sqrt(real(1.0) + slope * slope);
    real share = clamp(real(0.5) + d / width, real(0.0), real(1.0));
    found.run = run;
    found.visibility = mix(above, below, share);
    return found;
}
GN_FN real edgeVisibility(MapPoint point, FilterInput f)
{
    real2 cell = floor(point.texel);
    real centre = edgeLit(point, f, cell);
    EdgeFound x = findEdge(point, f, true, centre);
    EdgeFound y = findEdge(point, f, false, centre);
    return x.run >= y.run ? x.visibility : y.visibility;
}
GN_END
#endif
