// SPDX-License-Identifier: Apache-2.0
// What a shared library of Gnomon shows: everything else is compiled with hidden visibility. In a static library the
// two macros change nothing.
#pragma once

#if defined(__GNUC__)
#define GNOMON_API __attribute__((visibility("default")))  // public functions, classes with functions in a source
#define GNOMON_LOCAL __attribute__((visibility("hidden"))) // of such a class, a type that is nobody else's
#else
#define GNOMON_API
#define GNOMON_LOCAL
#endif
