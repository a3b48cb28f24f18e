// SPDX-License-Identifier: Apache-2.0
// OpenGL's formats for maps.
#pragma once

#include "functions.h"

#include <gnomon/options.h>

namespace gnomon::gl {

struct MapStorage {
    GLenum colour = 0; // 0: depths alone
    GLenum depth = GL_DEPTH_COMPONENT32F;

    [[nodiscard]] bool depthOnly() const { return colour == 0; }
    [[nodiscard]] GLenum mapFormat() const { return depthOnly() ? depth : colour; }
};
[[nodiscard]] MapStorage mapStorage(MapFormat format);

} // namespace gnomon::gl
