// SPDX-License-Identifier: Apache-2.0
#include "scene/model.h"

namespace gnomon::scene {

glm::mat4 Transform::matrix() const
{
    // Rows of the rotation, each column times its scale; written out because it runs for every moving node.
    const glm::quat& q = rotation;
    const float xx = q.x * q.x;
    const float yy = q.y * q.y;
    const float zz = q.z * q.z;
    const float xy = q.x * q.y;
    const float xz = q.x * q.z;
    const float yz = q.y * q.z;
    const float wx = q.w * q.x;
    const float wy = q.w * q.y;
    const float wz = q.w * q.z;
    return {
        glm::vec4(1.0F - 2.0F * (yy + zz), 2.0F * (xy + wz), 2.0F * (xz - wy), 0.0F) * scale.x,
        glm::vec4(2.0F * (xy - wz), 1.0F - 2.0F * (xx + zz), 2.0F * (yz + wx), 0.0F) * scale.y,
        glm::vec4(2.0F * (xz + wy), 2.0F * (yz - wx), 1.0F - 2.0F * (xx + yy), 0.0F) * scale.z,
        glm::vec4(translation, 1.0F),
    };
}

} // namespace gnomon::scene
