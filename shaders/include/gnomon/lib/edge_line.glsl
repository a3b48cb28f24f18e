// SPDX-License-Identifier: Apache-2.0
// The edge of a shadow, found within texels. Where texels that shade the receiver meet texels that do not, their border
// is a stair. The edge that was drawn passes the corner of each step within half a texel, so a line from the middle of
// one step's riser to the middle of the next is nearer to it than the stair.
// After: M. Macedo, A. Apolinario, "Revectorization-based shadow mapping", Graphics Interface 2016; M. Macedo,
// A. Apolinario, K. Aguero, "Revectorization-based soft shadow mapping", Computer Graphics Forum, 2019. Lines from riser
// to riser are after A. Reshetov, "Morphological antialiasing", High Performance Graphics 2009.
// Departures: the light's disc is laid on the map at the depth of the texel that casts, and lit is the disc's share
// beyond the line. The lines on both sides of a narrow shadow, and of a narrow light, count together.
#ifndef GNOMON_EDGE_LINE_GLSL
#define GNOMON_EDGE_LINE_GLSL
#include "cone_texels.glsl"
GN_BEGIN

// How far from the receiver's texel an edge is looked for along an axis, and how far its step is followed, texels.
GN_CONST int kEdgeReach = 3;
GN_CONST int kEdgeRun = 12;
// A step this long is a line's, whatever follows it.
GN_CONST real kSureRun = real(4.0);
// No disc is smaller, texels of radius: a line is not known any better.
GN_CONST real kLeastDisc = real(0.2);

// Rows of texels: places are given along a row and across the rows.
struct EdgeRows {
    bool along_x;
    real2 at; // the receiver
};

GN_FN real2 edgeCell(EdgeRows rows, real along, real across)
{
    return rows.along_x ? real2(along, across) : real2(across, along);
}

// Does a texel's depth light the receiver?
GN_FN bool edgeLit(MapPoint point, FilterInput f, real2 cell, bool looks_for_creases)
{
    real2 inside = texelInside(f, cell);
    real stored = mapTexel(inside, f.layer, f.part);
    real2 at = cell + real2(real(0.5)) - point.texel;
    bool lit = compareTexel(point, at, stored) > real(0.5);
    if (looks_for_creases && !lit && max(abs(at.x), abs(at.y)) < kCrease) {
        lit = passesBeneath(point, f, inside, at, stored);
    }
    return lit;
}

// One end of a step.
struct StepEnd {
    real run;  // columns from the receiver's, with it, to the end
    real turn; // half a texel to where the stair goes on across the rows: -0.5, 0.5, or 0 where that is not known
};

// Follows the border between rows `across` - 1 and `across` from column `from`. `way`: -1 or 1.
GN_FN StepEnd followStep(MapPoint point, FilterInput f, EdgeRows rows, real from, real across, bool low_lit, real way)
{
    StepEnd end;
    end.run = real(0.0);
    end.turn = real(0.0);
    bool more = true;
    do {
        end.run += real(1.0);
        bool low = false;
        bool high = false;
        real row = real(-1.0);
        do { // a loop, so that a texel's comparison is compiled once
            low = high;
            high = edgeLit(point, f, edgeCell(rows, from + way * end.run, across + row), false);
            row += real(1.0);
        } while (row < real(0.5));
        more = low == low_lit && high != low_lit && end.run < real(kEdgeRun);
        real turn = low == low_lit ? real(0.5) : real(-0.5);
        end.turn = low == high ? turn : real(0.0);
    } while (more);
    return end;
}

// The share of the light that an edge leaves.
struct EdgeShare {
    real lit;
    real apart; // the receiver's distance from the edge, texels
    bool here;  // whether the receiver's own texel lights it
    real run;   // columns of its step; 0: there is no edge
    bool leans; // the stair goes on to different sides at the step's ends, as a line's does
};

// Share of a disc of radius 1 on the side of a line to which its middle is `x` from it.
GN_FN real discShare(real x)
{
    real c = clamp(x, real(-1.0), real(1.0));
    return real(0.5) + (c * sqrt(max(real(1.0) - c * c, real(0.0))) + asin(c)) * real(0.3183098862);
}

// The line through a step that is `run` columns long, `along` columns from its beginning: its height over the step's
// own, and its slope. `turns`: StepEnd::turn of both ends.
GN_FN real2 lineInStep(real along, real run, real2 turns)
{
    real middle = real(0.5) * run;
    // Ends that turn to one side make a roof of two lines.
    bool roof = turns.x * turns.y >= real(0.0);
    real slope_of_roof = (along < middle ? -turns.x : turns.y) / middle;
    real slope = roof ? slope_of_roof : (turns.y - turns.x) / run;
    return real2(slope * (along - middle), slope);
}

// The edge on one side of the receiver, `way`, across the rows.
GN_FN EdgeShare edgeBeside(MapPoint point, FilterInput f, RayCone cone, EdgeRows rows, real way)
{
    real2 cell = floor(rows.at);
    real k = real(-1.0);
    bool here = false;
    bool differs = false;
    do { // from the receiver's own texel on
        k += real(1.0);
        bool lit = edgeLit(point, f, edgeCell(rows, cell.x, cell.y + way * k), true);
        here = k > real(0.0) ? here : lit;
        differs = lit != here;
    } while (!differs && k < real(kEdgeReach));
    EdgeShare found;
    found.here = here;
    found.lit = here ? real(1.0) : real(0.0);
    found.apart = real(1e9);
    found.run = real(0.0);
    found.leans = false;
    if (differs) {
        real across = way < real(0.0) ? cell.y - k + real(1.0) : cell.y + k;
        bool low_lit = (way < real(0.0)) != here;
        StepEnd before;
        StepEnd after;
        after.run = real(0.0);
        after.turn = real(0.0);
        int ends = 0;
        do {
            before = after;
            after = followStep(point, f, rows, cell.x, across, low_lit, ends == 0 ? real(-1.0) : real(1.0));
            ++ends;
        } while (ends < 2);
        found.run = before.run + after.run - real(1.0);
        found.leans = before.turn * after.turn < real(0.0);
        real along = rows.at.x - (cell.x - before.run + real(1.0));
        real2 line = lineInStep(along, found.run, real2(before.turn, after.turn));
        real2 to_lit = real2(-line.y, real(1.0)) * ((low_lit ? real(-1.0) : real(1.0)) / sqrt(real(1.0) + line.y * line.y));
        real2 normal = edgeCell(rows, to_lit.x, to_lit.y);
        // The light's disc, where the texel that casts is.
        real2 dark = texelInside(f, edgeCell(rows, cell.x, low_lit ? across : across - real(1.0)));
        real caster = mapTexel(dark, f.layer, f.part);
        real s = rayLength(point.depth - caster, cone.rise, cone.start.z, cone.axis.z, kRayEnd);
        real2 centre = coneTexel(cone, s, real2(real(0.0)));
        real3 across_disc = real3(normal.x, normal.y, -dot(centre, normal)) * (s / (cone.start.z + cone.axis.z * s));
        real2 radius = real2(dot(cone.side_x, across_disc), dot(cone.side_y, across_disc));
        real beyond = (rows.at.y - across - line.x) * to_lit.y + dot(centre - point.texel, normal);
        found.lit = discShare(beyond / max(length(radius), kLeastDisc));
        found.apart = abs(beyond);
    }
    return found;
}

// The share that the edges around the receiver leave: of rows along x or along y, where the nearer edge's step is
// longer, because there the line is known better.
GN_FN EdgeShare edgeShare(MapPoint point, FilterInput f, RayCone cone)
{
    EdgeShare found;
    found.here = false;
    found.lit = real(0.0);
    found.apart = real(0.0);
    found.run = real(-1.0);
    found.leans = false;
    EdgeShare first = found;
    int side = 0;
    do {
        EdgeRows rows;
        rows.along_x = side < 2;
        rows.at = rows.along_x ? point.texel : real2(point.texel.y, point.texel.x);
        bool second = (side & 1) == 1;
        EdgeShare edge = edgeBeside(point, f, cone, rows, second ? real(1.0) : real(-1.0));
        real both = first.lit + edge.lit - (edge.here ? real(1.0) : real(0.0));
        if (second) {
            if (first.apart < edge.apart) {
                edge = first;
            }
            edge.lit = clamp(both, real(0.0), real(1.0));
            if (edge.run > found.run) {
                found = edge;
            }
        }
        first = edge;
        ++side;
    } while (side < 4);
    return found;
}

// Do lines suffice? They do where no edge is near the receiver, or a straight one. Leaves and wires have stairs with steps
// of every length.
GN_FN bool linesSuffice(EdgeShare edge)
{
    return edge.run == real(0.0) || edge.leans || edge.run >= kSureRun;
}

GN_END
#endif
