// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace gnomon::test {

#ifdef __has_feature // clang's, which builds with sanitizers
#if __has_feature(address_sanitizer)
#define GNOMON_SANITIZED
#endif
#endif
#ifdef GNOMON_SANITIZED
constexpr bool kSanitized = true; // each step takes ten times as long, or more
#else
constexpr bool kSanitized = false;
#endif

} // namespace gnomon::test
