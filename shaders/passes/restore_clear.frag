#version 460
// SPDX-License-Identifier: Apache-2.0
// Nothing is there: for a map that shares its texels with another, whose channels a clear of the attachment would lose.
layout(location = 0) out vec4 stored;

void main()
{
    stored = vec4(1.0);
    gl_FragDepth = 1.0;
}
