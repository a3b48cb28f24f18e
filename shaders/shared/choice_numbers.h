// SPDX-License-Identifier: Apache-2.0
// The numbers of choices that shaders tell apart. C++ asserts that they are those of choices.h and moment_options.h
// (vulkan/src/choice_numbers.cpp).
#ifndef GNOMON_CHOICE_NUMBERS_H
#define GNOMON_CHOICE_NUMBERS_H
#include "portability.h"

// gnomon::Filter. Macros, because the preprocessor chooses by them.
#define GNOMON_FILTER_HARD 0
#define GNOMON_FILTER_PCF 1
#define GNOMON_FILTER_VSM 3
#define GNOMON_FILTER_LVSM 4
#define GNOMON_FILTER_ESM 5
#define GNOMON_FILTER_EVSM 6
#define GNOMON_FILTER_MSM 7

GN_BEGIN

GN_CONST int kFilterHard = GNOMON_FILTER_HARD;
GN_CONST int kFilterPcf = GNOMON_FILTER_PCF;
GN_CONST int kFilterVsm = GNOMON_FILTER_VSM;
GN_CONST int kFilterLvsm = GNOMON_FILTER_LVSM;
GN_CONST int kFilterEsm = GNOMON_FILTER_ESM;
GN_CONST int kFilterEvsm = GNOMON_FILTER_EVSM;
GN_CONST int kFilterMsm = GNOMON_FILTER_MSM;

// gnomon::MapSampling
GN_CONST int kSamplingNearest = 0;
GN_CONST int kSamplingBilinear = 1;
GN_CONST int kSamplingTrilinear = 2;
GN_CONST int kSamplingAnisotropic = 3;

GN_END
#endif
