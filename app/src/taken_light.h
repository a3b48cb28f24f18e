// SPDX-License-Identifier: Apache-2.0
// Objects that take all of a light: a dome around the scene, a bulb around its lamp.
#pragma once

#include "app/shot.h"

namespace gnomon::app {

/// Adds a notice for each object, or node of several, that holds all of a light back: nothing else that receives shadow
/// within the light's reach is lit at any of a few hundred points. Around a lamp it also stands in each of a hundred
/// directions; under a sun it does so in most that lead up, and its bounds hold the middles of all that receives. A
/// room does not count, because things in it are lit; nor does a shade with openings, nor an object around both camera
/// and lamp. Searches for a tenth of a second at most.
void noteTakenLight(Shot& shot);

} // namespace gnomon::app
