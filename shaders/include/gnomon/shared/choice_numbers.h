// SPDX-License-Identifier: Apache-2.0
// The numbers of choices that shaders tell apart, beside filters (filter_numbers.h). C++ asserts that they are those of
// moment_options.h (pack/src/choice_numbers.cpp).
#ifndef GNOMON_CHOICE_NUMBERS_H
#define GNOMON_CHOICE_NUMBERS_H
#include "portability.h"

GN_BEGIN

// gnomon::MapSampling
GN_CONST int kSamplingNearest = 0;
GN_CONST int kSamplingBilinear = 1;
GN_CONST int kSamplingTrilinear = 2;
GN_CONST int kSamplingAnisotropic = 3;

GN_END
#endif
