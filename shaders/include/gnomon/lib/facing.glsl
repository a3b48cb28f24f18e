// SPDX-License-Identifier: Apache-2.0
// The part of shading that needs no map: whether a surface faces the light, where it takes its light from, and how
// shadows fade with distance.
#ifndef GNOMON_FACING_GLSL
#define GNOMON_FACING_GLSL
#include "../shared/bias.h"
#include "../shared/gpu_structs.h"
#include "../shared/smooth_surface.h"
GN_BEGIN

// The sine of the height over a surface up to which a light without a size does not reach it (0.11 degrees). Stored normals
// err by about 2e-4, so at zero a face that the light grazes would be lit and dark by turns, pixel by pixel.
GN_CONST real kGrazing = real(0.002);

// The share of a light's disc that is over the horizon of a surface with normal `n`: 0 to 1, within 0.04. `to_light`
// may have any length; `radius` has the same scale (lightSpread()). A disc narrower than kGrazing is lowered by the
// difference.
GN_FN real shareOverHorizon(real3 n, real3 to_light, real radius)
{
    real least = kGrazing * length(to_light) + real(1e-30); // more than 0 at a light's own place too
    real middle = max(least - radius, real(0.0));
    real half_width = max(radius, real(1e-3) * least);
    return smoothstep(middle - half_width, middle + half_width, dot(n, to_light));
}

// Where a surface takes its light from.
struct LightPoint {
    real3 p;
    real3 n;    // normal of the plane that stands for the surface there
    real share; // share of the light's disc over its horizon, an upper bound of the visibility
};

// Below this cosine between a triangle and the light, some three degrees, its neighbours on a smooth body rise over its
// plane by as much as the map errs; and of a wide sun they hide a part.
GN_CONST real kHardlyFaces = real(0.05);

// A point `p` of a triangle with unit normal `n`, for a light of this `radius` in direction `to_light`, as for
// shareOverHorizon(). The smooth normal over it says whether it faces the light, as for shading. Where that faces the
// light and the triangle does not, or hardly, light arrives at the smooth surface, whose plane no part of a convex body
// rises over. Where the light all but grazes, the plane is leant back to where filters can follow it: the bias of a
// steeper one would let light through whatever shades the body.
GN_FN LightPoint lightPoint(real3 p, real3 n, SmoothSurface s, real3 to_light, real radius)
{
    LightPoint at;
    at.p = p;
    at.n = n;
    at.share = shareOverHorizon(n, to_light, radius);
    if (s.lift > real(0.0)) {
        real3 l = normalize(to_light);
        bool lifts = dot(n, l) < kHardlyFaces;
        at.p = lifts ? p + s.n * s.lift : p;
        at.n = lifts ? normalize(s.n + l * max(real(1.0) / kSteepest - dot(s.n, l), real(0.0))) : n;
        at.share = shareOverHorizon(s.n, to_light, radius);
    }
    return at;
}

// A point that light all but grazes, and how.
struct GrazedPoint {
    real3 p;
    real sine; // sine of the light's height over the plane there; 0: it is higher, or wide
};

// The triangle is that of `at`, its lightPoint(). `light_sine`: of the light's radius, as it is seen. A triangle that faces
// the light takes it by itself, whatever lies over it.
GN_FN GrazedPoint grazedPoint(LightPoint at, real3 p, real3 n, real3 to_light, real light_sine)
{
    real facing = dot(n, normalize(to_light));
    bool by_itself = facing > light_sine;
    GrazedPoint grazed;
    grazed.p = by_itself ? p : at.p;
    grazed.sine = max(by_itself ? facing : dot(at.n, normalize(to_light)), real(1.0) / kSteepestBias);
    grazed.sine = facing < kHardlyFaces && light_sine < kHardlyFaces ? grazed.sine : real(0.0);
    return grazed;
}

// From a surface's eye-relative point `p` to the light's centre, as FilterInput has it.
GN_FN real3 towardLight(GN_VEC4 place, real3 p)
{
    return real3(real(place.x), real(place.y), real(place.z)) - p * real(place.w);
}

// How far shadows have faded away at a distance from the eye, before the distance to which they are drawn: 1, all of them.
GN_FN real fadedShare(GN_VEC4 fade, real distance)
{
    return clamp((distance - real(fade.x)) * real(fade.y), real(0.0), real(1.0));
}

GN_END
#endif
