// SPDX-License-Identifier: Apache-2.0
// Which filters are compiled: with GNOMON_FILTER defined as a number of filter_numbers.h that one; with GNOMON_FILTERS those
// whose bits (1 << number) it has; else all.
#ifndef GNOMON_COMPILED_FILTERS_GLSL
#define GNOMON_COMPILED_FILTERS_GLSL
#include "../shared/filter_numbers.h"
// Sets of filters that share a module: those that compare ids, and those that smoothies are read beside.
#define GNOMON_FILTERS_OF_IDS ((1 << GNOMON_FILTER_ID) | (1 << GNOMON_FILTER_DEPTH_ID))
#define GNOMON_FILTERS_OF_KERNELS ((1 << GNOMON_FILTER_HARD) | (1 << GNOMON_FILTER_PCF))
#ifdef GNOMON_FILTER
#define GNOMON_FILTERS (1 << GNOMON_FILTER)
#endif
#ifndef GNOMON_FILTERS
#define GNOMON_FILTERS ((1 << GNOMON_FILTER_COUNT) - 1)
#endif
// For #if: GNOMON_COMPILES(GNOMON_FILTER_PCF).
#define GNOMON_COMPILES(NUMBER) (((GNOMON_FILTERS >> (NUMBER)) & 1) != 0)
// Some filter that compares the depths of a map; one that does so over a fixed kernel; one that looks for them in the
// map's blocks; one that compares ids.
#define GNOMON_COMPARES_DEPTHS(NUMBER) ((NUMBER) <= GNOMON_FILTER_RAYMARCH)
#define GNOMON_COMPILES_DEPTHS ((GNOMON_FILTERS & ((1 << (GNOMON_FILTER_RAYMARCH + 1)) - 1)) != 0)
#define GNOMON_COMPILES_KERNELS ((GNOMON_FILTERS & GNOMON_FILTERS_OF_KERNELS) != 0)
#define GNOMON_COMPILES_BLOCKS (GNOMON_COMPILES(GNOMON_FILTER_PCSS) || GNOMON_COMPILES(GNOMON_FILTER_RAYMARCH))
#define GNOMON_COMPILES_IDS ((GNOMON_FILTERS & GNOMON_FILTERS_OF_IDS) != 0)
#endif
