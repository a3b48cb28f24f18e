// SPDX-License-Identifier: Apache-2.0
// Makes one text both GLSL and C++. A header that includes this may use: scalars and vectors of the precision
// `real` (float in GLSL; float or double in C++, by GNOMON_REAL), functions marked GN_FN, and the GLSL built-ins that
// glm has too. No swizzles on the left side, no arrays by value, no out-parameters but GN_OUT(type).
#ifndef GNOMON_PORTABILITY_H
#define GNOMON_PORTABILITY_H

#ifdef __cplusplus
#include <glm/glm.hpp>
#ifndef GNOMON_REAL
#define GNOMON_REAL float
#endif
#define GN_FN inline
#define GN_OUT(type) type&
#define GN_BEGIN                                                                                                       \
    namespace gnomon::shared {                                                                                         \
    using real = GNOMON_REAL;                                                                                          \
    using real2 = glm::vec<2, real>;                                                                                   \
    using real3 = glm::vec<3, real>;                                                                                   \
    using real4 = glm::vec<4, real>;                                                                                   \
    using glm::abs, glm::ceil, glm::clamp, glm::cross, glm::dot, glm::exp, glm::floor, glm::fract, glm::length,        \
        glm::max, glm::min, glm::mix, glm::normalize, glm::sign, glm::sqrt, glm::step, glm::inversesqrt;
#define GN_END }
#else
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define GN_FN
#define GN_OUT(type) out type
#define GN_BEGIN
#define GN_END
#endif

#endif
