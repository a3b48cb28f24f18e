// SPDX-License-Identifier: Apache-2.0
// Makes one text both GLSL and C++. A header that includes this may use: scalars and vectors of the precision
// `real` (float in GLSL; float or double in C++, by GNOMON_REAL), functions marked GN_FN, and the GLSL built-ins that
// glm has too. No swizzles, no literals of floating type but real(0.5), no arrays by value, no out-parameters but
// GN_OUT(type), no floating vector indexed on the left side.
#ifndef GNOMON_PORTABILITY_H
#define GNOMON_PORTABILITY_H

#ifdef __cplusplus
#include <glm/glm.hpp>
#ifndef GNOMON_REAL
#define GNOMON_REAL float
#endif
#define GN_FN inline
#define GN_CONST inline constexpr
#define GN_OUT(type) type&
#define GN_JOIN_(a, b) a##b
#define GN_JOIN(a, b) GN_JOIN_(a, b)
// The inner namespace keeps the two precisions apart when a program has both.
#define GN_BEGIN                                                                                                       \
    namespace gnomon::shared {                                                                                         \
    inline namespace GN_JOIN(of_, GNOMON_REAL)                                                                         \
    {                                                                                                                  \
        using real = GNOMON_REAL;                                                                                      \
        using real2 = glm::vec<2, real>;                                                                               \
        using real3 = glm::vec<3, real>;                                                                               \
        using real4 = glm::vec<4, real>;                                                                               \
        using glm::abs, glm::asin, glm::ceil, glm::clamp, glm::cross, glm::dot, glm::exp, glm::exp2, glm::floor,       \
            glm::fract, glm::inversesqrt, glm::length, glm::log, glm::log2, glm::pow, glm::max, glm::min, glm::mix,    \
            glm::normalize, glm::sign, glm::sin, glm::cos, glm::smoothstep, glm::sqrt, glm::step;
#define GN_END                                                                                                         \
    }                                                                                                                  \
    }
#else
#define real float
#define real2 vec2
#define real3 vec3
#define real4 vec4
#define GN_FN
#define GN_CONST const
#define GN_OUT(type) out type
#define GN_BEGIN
#define GN_END
#endif

#endif
