// SPDX-License-Identifier: Apache-2.0
// The numbers of gnomon::Filter, which takes them from here. CMake reads this list too: each filter has a module of the
// mask pass. Macros, because the preprocessor chooses by them. First are filters that compare the depths of a map, then
// those that average texels, then those that compare ids; a new one goes to its kind, and those after it move up.
#ifndef GNOMON_FILTER_NUMBERS_H
#define GNOMON_FILTER_NUMBERS_H
#define GNOMON_FILTER_HARD 0
#define GNOMON_FILTER_PCF 1
#define GNOMON_FILTER_PCSS 2
#define GNOMON_FILTER_RAYMARCH 3
#define GNOMON_FILTER_VSM 4
#define GNOMON_FILTER_LVSM 5
#define GNOMON_FILTER_ESM 6
#define GNOMON_FILTER_EVSM 7
#define GNOMON_FILTER_MSM 8
#define GNOMON_FILTER_ID 9
#define GNOMON_FILTER_DEPTH_ID 10
#define GNOMON_FILTER_COUNT 11

#endif
