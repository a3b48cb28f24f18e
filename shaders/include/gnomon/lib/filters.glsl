// SPDX-License-Identifier: Apache-2.0
// The table of filters. A new one is a file in this folder, a number in gnomon/shared/filter_numbers.h, and its lines here.
// compiled_filters.glsl says which are compiled.
#ifndef GNOMON_FILTERS_GLSL
#define GNOMON_FILTERS_GLSL
#include "compiled_filters.glsl"
#include "filter_types.glsl"
#if GNOMON_COMPILES(GNOMON_FILTER_HARD)
#include "hard.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_PCF)
#include "pcf.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_PCSS)
#include "pcss.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_RAYMARCH)
#include "raymarch.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_VSM) || GNOMON_COMPILES(GNOMON_FILTER_MSM)
#include "moment_penumbra.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_LVSM)
#include "lvsm.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_ESM)
#include "esm.glsl"
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_EVSM)
#include "evsm.glsl"
#endif
#if defined(GNOMON_SMOOTHIES) && GNOMON_COMPILES_KERNELS
#define GNOMON_READS_SMOOTHIES
#include "smoothies.glsl"
#endif
// Without a receiver's object (light_visibility.glsl) nothing is told apart by ids.
#if GNOMON_COMPILES_IDS && (defined(GNOMON_OBJECT) || defined(__cplusplus))
#define GNOMON_WITH_IDS
#include "depth_id.glsl"
#endif
GN_BEGIN

// The visibility of a filter that compares depths: at most that of the smoothies beside its map, if there are any.
GN_FN real withSmoothies(real visibility, MapPoint point, FilterInput f)
{
    real v = visibility;
#ifdef GNOMON_READS_SMOOTHIES
    if (f.smoothies > real(0.0) && v > real(0.0)) {
        v = min(v, smoothieVisibility(point, f));
    }
#endif
    return v;
}

// `filter_number`: one of the compiled filters. Any other gives 1.
GN_FN real applyFilter(int filter_number, MapPoint point, FilterInput f)
{
    real v = real(1.0);
    switch (filter_number) {
#if GNOMON_COMPILES(GNOMON_FILTER_HARD)
    case GNOMON_FILTER_HARD:
        v = withSmoothies(filterHard(point, f), point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_PCF)
    case GNOMON_FILTER_PCF:
        v = withSmoothies(filterPcf(point, f), point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_PCSS)
    case GNOMON_FILTER_PCSS:
        v = filterPcss(point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_RAYMARCH)
    case GNOMON_FILTER_RAYMARCH:
        v = filterRaymarch(point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_VSM) || GNOMON_COMPILES(GNOMON_FILTER_MSM)
    case GNOMON_FILTER_VSM:
    case GNOMON_FILTER_MSM:
        v = applyMoments(filter_number, point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_LVSM)
    case GNOMON_FILTER_LVSM:
        v = filterLvsm(point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_ESM)
    case GNOMON_FILTER_ESM:
        v = filterEsm(point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_EVSM)
    case GNOMON_FILTER_EVSM:
        v = filterEvsm(point, f);
        break;
#endif
#ifdef GNOMON_WITH_IDS
#if GNOMON_COMPILES(GNOMON_FILTER_ID)
    case GNOMON_FILTER_ID:
        v = filterId(point, f);
        break;
#endif
#if GNOMON_COMPILES(GNOMON_FILTER_DEPTH_ID)
    case GNOMON_FILTER_DEPTH_ID:
        v = filterDepthId(point, f);
        break;
#endif
#endif
    default:
        break;
    }
    return v;
}

GN_END
#endif
