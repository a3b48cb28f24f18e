// SPDX-License-Identifier: Apache-2.0
// The table of filters. A new one is a file in this folder, a number in gnomon/shared/choice_numbers.h, and its lines here.
// With GNOMON_FILTER defined as one of those numbers that filter alone is compiled.
#ifndef GNOMON_FILTERS_GLSL
#define GNOMON_FILTERS_GLSL
#include "../shared/choice_numbers.h"
#include "filter_types.glsl"
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_HARD
#include "hard.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_PCF
#include "pcf.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_PCSS
#include "pcss.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_RAYMARCH
#include "raymarch.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_VSM || GNOMON_FILTER == GNOMON_FILTER_MSM
#include "moment_penumbra.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_LVSM
#include "lvsm.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_ESM
#include "esm.glsl"
#endif
#if !defined(GNOMON_FILTER) || GNOMON_FILTER == GNOMON_FILTER_EVSM
#include "evsm.glsl"
#endif
#if defined(GNOMON_SMOOTHIES) && (!defined(GNOMON_FILTER) || GNOMON_FILTER <= GNOMON_FILTER_PCF)
#define GNOMON_READS_SMOOTHIES
#include "smoothies.glsl"
#endif
// Without a receiver's object (light_visibility.glsl) nothing is told apart by ids.
#if (defined(GNOMON_FILTER) && (GNOMON_FILTER == GNOMON_FILTER_ID || GNOMON_FILTER == GNOMON_FILTER_DEPTH_ID)) ||              \
    (!defined(GNOMON_FILTER) && (defined(GNOMON_OBJECT) || defined(__cplusplus)))
#define GNOMON_WITH_IDS
#include "depth_id.glsl"
#endif
GN_BEGIN

// Of a filter that compares depths: it is no lighter than the smoothies beside its map, if there are any.
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

// `filter_number` counts only where more than one filter is compiled.
GN_FN real applyFilter(int filter_number, MapPoint point, FilterInput f)
{
#if defined(GNOMON_FILTER)
#if GNOMON_FILTER == GNOMON_FILTER_HARD
    return withSmoothies(filterHard(point, f), point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_PCF
    return withSmoothies(filterPcf(point, f), point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_PCSS
    return filterPcss(point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_RAYMARCH
    return filterRaymarch(point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_VSM
    return applyMoments(kFilterVsm, point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_LVSM
    return filterLvsm(point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_ESM
    return filterEsm(point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_EVSM
    return filterEvsm(point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_MSM
    return applyMoments(kFilterMsm, point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_ID
    return filterId(point, f);
#elif GNOMON_FILTER == GNOMON_FILTER_DEPTH_ID
    return filterDepthId(point, f);
#endif
#else
    switch (filter_number) {
    case GNOMON_FILTER_HARD:
        return withSmoothies(filterHard(point, f), point, f);
    case GNOMON_FILTER_PCF:
        return withSmoothies(filterPcf(point, f), point, f);
    case GNOMON_FILTER_PCSS:
        return filterPcss(point, f);
    case GNOMON_FILTER_RAYMARCH:
        return filterRaymarch(point, f);
    case GNOMON_FILTER_VSM:
        return applyMoments(kFilterVsm, point, f);
    case GNOMON_FILTER_LVSM:
        return filterLvsm(point, f);
    case GNOMON_FILTER_ESM:
        return filterEsm(point, f);
    case GNOMON_FILTER_EVSM:
        return filterEvsm(point, f);
    case GNOMON_FILTER_MSM:
        return applyMoments(kFilterMsm, point, f);
#ifdef GNOMON_WITH_IDS
    case GNOMON_FILTER_ID:
        return filterId(point, f);
    case GNOMON_FILTER_DEPTH_ID:
        return filterDepthId(point, f);
#endif
    default:
        return real(1.0);
    }
#endif
}

GN_END
#endif
