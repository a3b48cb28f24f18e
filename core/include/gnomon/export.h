// SPDX-License-Identifier: Apache-2.0
// The names that a shared library of Gnomon shows. All others have hidden visibility. In a static library the two
// macros change nothing.
#pragma once

#if defined(__GNUC__)
#define GNOMON_API __attribute__((visibility("default")))  // public functions, classes with functions in a source
#define GNOMON_LOCAL __attribute__((visibility("hidden"))) // a private type of such a class
#else
#define GNOMON_API
#define GNOMON_LOCAL
#endif
