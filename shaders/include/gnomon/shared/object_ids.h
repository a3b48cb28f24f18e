// SPDX-License-Identifier: Apache-2.0
// Ids of objects instead of depths, and depths within an object's own range: what a texel holds, and what it says of a
// receiver.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (ID buffers; depth and ID buffers).
// Departures: 0 stands for what does not cast and for texels that nothing was drawn to, and lights everything.
// "Priority", which the talk names and does not give, asks the nearest texel, and does not believe one whose object
// ranks behind the receiver's where one of the four nearest texels is of the receiver itself.
#ifndef GNOMON_OBJECT_IDS_H
#define GNOMON_OBJECT_IDS_H
#include "portability.h"
GN_BEGIN

// gnomon::IdTest
GN_CONST int kIdTestAny = 1;
GN_CONST int kIdTestPriority = 2;
GN_CONST int kIdTestNearest = 3;

struct IdRule {
    real test;  // a kIdTest
    real ids;   // how many there are besides 0: a texel holds id / ids
    real order; // above 0: of two ids the higher is behind; else they begin again after the last (gnomon::IdSharing)
    real bias;  // depth-id: towards the light, in shares of the object's radius; less than 0: as BiasRule has it
    real steps; // depth-id: of what a texel's depth is rounded to; less than 0: minus that, and the depth is the map's
};

// For IdOf::face: pieces of an object that have numbers of their own, and the bit in a pixel's number at which its
// piece begins.
GN_CONST int kMostPieces = 4096;
GN_CONST int kPieceShift = 20;

// An object's own range is its box's along the light and this share of its radius more, so that points at its ends stay
// inside in spite of rounding.
GN_CONST real kObjectPad = real(0.001);

GN_FN real idOfTexel(real stored, real ids)
{
    return floor(stored * ids + real(0.5));
}

// The id of an object's piece; `first`: that of its first, after which they follow each other, from 1 again after the
// last. An object without an id has pieces without.
GN_FN real idOfPiece(real first, real piece, real ids)
{
    real before = first - real(1.0) + piece;
    return first > real(0.0) ? before - ids * floor((before + real(0.5)) / ids) + real(1.0) : real(0.0);
}

// Does an object with this id leave the one with id `own` lit?
GN_FN bool idLights(real own, real id)
{
    return id == own || id == real(0.0);
}

// Ids were handed out front to back. Where they begin again from 1, of two the one that comes within half of them after
// the other is taken for the one behind.
GN_FN bool idIsBehind(real own, real id, IdRule rule)
{
    real after = id > own ? id - own : id - own + rule.ids;
    bool comes_after = rule.order > real(0.0) ? id > own : real(2.0) * after <= rule.ids;
    return own > real(0.0) && id != own && comes_after;
}

// The nearest of the four texels of a gather (filter_types.glsl). `part`: the receiver's place between their centres,
// from the top left one.
GN_FN real nearestOfFour(real4 four, real2 part)
{
    real2 row = part.y < real(0.5) ? real2(four.w, four.z) : real2(four.x, four.y);
    return part.x < real(0.5) ? row.x : row.y;
}

// The visibility by the four texels around a receiver, 0 or 1. `lit`: 1 for texels that light it by themselves.
// `lifted`: as in FilterInput. With it no texel need be the receiver's own, so an object behind lights the receiver by
// every test except the nearest.
GN_FN real idVisibility(IdRule rule, real own, real lifted, real4 ids, real4 lit, real2 part)
{
    real any = max(max(lit.x, lit.y), max(lit.z, lit.w));
    real nearest = nearestOfFour(lit, part);
    int test = int(rule.test);
    bool is_behind = test != kIdTestNearest && idIsBehind(own, nearestOfFour(ids, part), rule);
    if (is_behind && lifted > real(0.5))
        any = real(1.0);
    return test == kIdTestAny || is_behind ? any : nearest;
}

// Half the length that a box spans along the light, in units of `along`, the gradient of the depth metric. `half_size`:
// half the box's size.
GN_FN real objectExtent(real3 along, real3 half_size)
{
    return dot(abs(along), half_size) + kObjectPad * length(along) * length(half_size);
}

// A point's depth within that range, 0 .. 1, by its distance from the box's centre.
GN_FN real objectDepth(real3 along, real3 from_centre, real extent)
{
    return real(0.5) + dot(along, from_centre) / max(real(2.0) * extent, real(1e-30));
}

GN_END
#endif
