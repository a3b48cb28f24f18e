// SPDX-License-Identifier: Apache-2.0
// Clear air over a round earth, and how light goes through it. Both GLSL and C++.
// Based on: S. Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020 (section 4 and
// table 1: molecules, dust, ozone); E. Bruneton and F. Neyret, "Precomputed Atmospheric Scattering", 2008 (where the
// numbers come from, and why dust has a table of its own: its phase is then exact about the sun).
//
// Departures: four times the paper's dust, an optical depth of 0.02, still a very clear day; with the paper's the sky
// about a low sun hardly glows. And molecules and ozone at 620, 550 and 450 nm, nearer to a screen's primaries, where
// the paper has 680, 550 and 440 nm: ozone takes most at 600 nm, which is what makes dusk blue and not purple.
// Molecules go by the fourth power of the wavelength, ozone by its cross-section in the Chappuis band. Lengths are
// kilometres, coefficients 1 / km, colours linear red, green, blue.
#ifndef HOST_ATMOSPHERE_H
#define HOST_ATMOSPHERE_H
#include "gnomon/shared/portability.h"
GN_BEGIN

GN_CONST real kEarth_km = real(6360.0);
GN_CONST real kAir_km = real(100.0); // thickness
GN_CONST real kDustForward = real(0.8);
GN_CONST real kQuarterOverPi = real(0.0795774715459477); // 1 / 4 pi

struct Air {
    real3 molecules; // scattering by them, Rayleigh's
    real dust;       // scattering by aerosols, Mie's
    real3 lost;      // extinction, by all of it
};

GN_FN Air airAt(real height_km)
{
    real molecules = exp(-height_km / real(8.0));
    real dust = exp(-height_km / real(1.2)) * real(4.0);
    real ozone = max(real(1.0) - abs(height_km - real(25.0)) / real(15.0), real(0.0));
    Air air;
    air.molecules = real3(real(8.40e-3), real(13.56e-3), real(30.25e-3)) * molecules;
    air.dust = real(3.996e-3) * dust;
    air.lost = air.molecules + real3(air.dust + real(0.444e-3) * dust) +
               real3(real(2.25e-3), real(1.88e-3), real(0.10e-3)) * ozone;
    return air;
}

// The phase function of scattering by an angle of cosine `c`, per steradian.
GN_FN real moleculesPhase(real c)
{
    return real(0.75) * kQuarterOverPi * (real(1.0) + c * c);
}
// Cornette and Shanks 1992.
GN_FN real dustPhase(real c)
{
    real g2 = kDustForward * kDustForward;
    real base = max(real(1.0) + g2 - real(2.0) * kDustForward * c, real(1e-4));
    return real(1.5) * kQuarterOverPi * (real(1.0) - g2) / (real(2.0) + g2) * (real(1.0) + c * c) / (base * sqrt(base));
}

// The length of a ray to where it leaves the air. It starts `radius_km` from the earth's centre and rises by the sine
// `up`.
GN_FN real toTheTop_km(real radius_km, real up)
{
    real top = kEarth_km + kAir_km;
    real b = radius_km * up;
    return max(-b + sqrt(max(b * b + top * top - radius_km * radius_km, real(0.0))), real(0.0));
}
// The length of a ray to the ground; negative where it misses the ground.
GN_FN real toTheGround_km(real radius_km, real up)
{
    real b = radius_km * up;
    real inside = b * b + kEarth_km * kEarth_km - radius_km * radius_km;
    return inside < real(0.0) || up >= real(0.0) ? real(-1.0) : max(-b - sqrt(inside), real(0.0));
}

// Where the sky table has the direction whose sine of height is `up`, at an azimuth of cosine `along` from the light:
// [0, 1], finer about the horizon and the light.
GN_FN real2 skyTablePlace(real up, real along)
{
    return real2(sqrt(clamp(real(0.5) - real(0.5) * along, real(0.0), real(1.0))),
                 sqrt(clamp(up, real(0.0), real(1.0))));
}
// (up, along) of a place.
GN_FN real2 skyTableDirection(real2 place)
{
    return real2(place.y * place.y, real(1.0) - real(2.0) * place.x * place.x);
}

// The share of the ground's colour below the horizon, which grows slowly and never to 1, as in haze.
GN_FN real groundShare(real up)
{
    real t = clamp(-up / real(0.8), real(0.0), real(1.0));
    return real(0.65) * t * t * (real(3.0) - real(2.0) * t);
}

GN_END
#endif
