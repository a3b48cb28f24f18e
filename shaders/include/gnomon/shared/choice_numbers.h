// SPDX-License-Identifier: Apache-2.0
// The numbers of choices that shaders tell apart. C++ asserts that they are those of choices.h and moment_options.h
// (pack/src/choice_numbers.cpp).
#ifndef GNOMON_CHOICE_NUMBERS_H
#define GNOMON_CHOICE_NUMBERS_H
#include "filter_numbers.h"
#include "portability.h"

GN_BEGIN

GN_CONST int kFilterHard = GNOMON_FILTER_HARD;
GN_CONST int kFilterPcf = GNOMON_FILTER_PCF;
GN_CONST int kFilterPcss = GNOMON_FILTER_PCSS;
GN_CONST int kFilterRaymarch = GNOMON_FILTER_RAYMARCH;
GN_CONST int kFilterVsm = GNOMON_FILTER_VSM;
GN_CONST int kFilterLvsm = GNOMON_FILTER_LVSM;
GN_CONST int kFilterEsm = GNOMON_FILTER_ESM;
GN_CONST int kFilterEvsm = GNOMON_FILTER_EVSM;
GN_CONST int kFilterMsm = GNOMON_FILTER_MSM;
GN_CONST int kFilterId = GNOMON_FILTER_ID;
GN_CONST int kFilterDepthId = GNOMON_FILTER_DEPTH_ID;

// gnomon::MapSampling
GN_CONST int kSamplingNearest = 0;
GN_CONST int kSamplingBilinear = 1;
GN_CONST int kSamplingTrilinear = 2;
GN_CONST int kSamplingAnisotropic = 3;

GN_END
#endif
