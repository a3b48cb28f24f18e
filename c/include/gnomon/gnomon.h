// SPDX-License-Identifier: Apache-2.0
// Gnomon's planner for hosts in C, and in languages that call C: camera, lights and bounds in, a plan of shadow maps
// out (door 3 of docs/integrating.md). docs/c.md has an example. The members of structs are those of the C++ headers
// that are named beside them, which say more.
//
// - A function returns a status, or null where it fails; gnomonLastError() then says why, and what to do.
//   A call that is refused changes nothing. No exception crosses this border.
// - Memory that a function returns is the library's. It holds until the same planner's next gnomonPlan() or
//   gnomonFreePlanner(), where nothing else is said. Memory that a host passes is not kept.
// - A struct that a host fills in begins with its size. gnomonInit...() sets that, and the defaults. Later versions add
//   members at the end of structs, and a program that was compiled with this header goes on to work.
// - It cannot be found out, and is undefined: a pointer to memory that is gone, too small or something else, an array
//   with fewer elements than its count, a text without an end, two threads in calls on one planner or object set.
// - Metres, radians, a right-handed world. Matrices are in columns: element [4 * column + row]. Clip space is
//   Vulkan's: y down, z in [0, w]. A uint32_t that asks a question is 0 or 1; other numbers stand for 1.
#ifndef GNOMON_GNOMON_H
#define GNOMON_GNOMON_H

#include <gnomon/gnomon_commands.h>
#include <gnomon/gnomon_data.h>

#include <stddef.h>
#include <stdint.h>

/// Marks the functions that a shared library shows.
#if defined(__GNUC__)
#define GNOMON_C_API __attribute__((visibility("default")))
#else
#define GNOMON_C_API
#endif
/// No function throws.
#if defined(__cplusplus)
#define GNOMON_NOEXCEPT noexcept
#else
#define GNOMON_NOEXCEPT
#endif

#if defined(__cplusplus)
extern "C" {
#endif

/// The last call of this thread that failed; never null. It holds until the thread's next call that fails.
GNOMON_C_API const GnomonError* gnomonLastError(void) GNOMON_NOEXCEPT;
/// The library's version, such as "0.1.0".
GNOMON_C_API const char* gnomonVersion(void) GNOMON_NOEXCEPT;

// ---- Objects: the bounds of everything that casts or receives

/// Writes the defaults. `size`: sizeof(GnomonObjectFlags).
GNOMON_C_API GnomonStatus gnomonInitObjectFlags(GnomonObjectFlags* flags, size_t size) GNOMON_NOEXCEPT;
/// An empty set; null where it fails. Pass GNOMON_INTERFACE.
GNOMON_C_API GnomonObjects* gnomonMakeObjects(uint32_t header_interface) GNOMON_NOEXCEPT;
/// Null does nothing.
GNOMON_C_API void gnomonFreeObjects(GnomonObjects* objects) GNOMON_NOEXCEPT;
/// Adds an object and writes its name. `flags` may be null, which stands for the defaults.
GNOMON_C_API GnomonStatus gnomonAddObject(GnomonObjects* objects, const GnomonBounds* bounds,
                                          const GnomonObjectFlags* flags, GnomonObjectId* id) GNOMON_NOEXCEPT;
/// Moves objects to other bounds: bounds[i] of ids[i]. Refused before any moves where one is not in the set.
GNOMON_C_API GnomonStatus gnomonMoveObjects(GnomonObjects* objects, const GnomonObjectId* ids,
                                            const GnomonBounds* bounds, uint32_t count) GNOMON_NOEXCEPT;
/// Says that an object's shape changed inside its bounds: maps that show it are drawn again.
GNOMON_C_API GnomonStatus gnomonTouchObject(GnomonObjects* objects, GnomonObjectId id) GNOMON_NOEXCEPT;
/// Says that an object takes part otherwise from now on.
GNOMON_C_API GnomonStatus gnomonSetObjectFlags(GnomonObjects* objects, GnomonObjectId id,
                                               const GnomonObjectFlags* flags) GNOMON_NOEXCEPT;
/// Removes an object. Its index is used again, its name is not.
GNOMON_C_API GnomonStatus gnomonRemoveObject(GnomonObjects* objects, GnomonObjectId id) GNOMON_NOEXCEPT;

// ---- Frames

/// Writes the defaults. `size`: sizeof(GnomonLight).
GNOMON_C_API GnomonStatus gnomonInitLight(GnomonLight* light, size_t size) GNOMON_NOEXCEPT;
/// Writes the defaults. `size`: sizeof(GnomonFrame).
GNOMON_C_API GnomonStatus gnomonInitFrame(GnomonFrame* frame, size_t size) GNOMON_NOEXCEPT;
/// Writes the defaults. `size`: sizeof(GnomonPageRequests).
GNOMON_C_API GnomonStatus gnomonInitPageRequests(GnomonPageRequests* requests, size_t size) GNOMON_NOEXCEPT;

// ---- The planner and its options

/// How many options there are.
GNOMON_C_API uint32_t gnomonOptionCount(void) GNOMON_NOEXCEPT;
/// The description of an option, in the order of `gnomon list`; null beyond the last.
GNOMON_C_API const GnomonOption* gnomonOptionAt(uint32_t index) GNOMON_NOEXCEPT;
/// A planner whose options 0 are the defaults; null where it fails. Pass GNOMON_INTERFACE.
GNOMON_C_API GnomonPlanner* gnomonMakePlanner(uint32_t header_interface) GNOMON_NOEXCEPT;
/// Null does nothing.
GNOMON_C_API void gnomonFreePlanner(GnomonPlanner* planner) GNOMON_NOEXCEPT;
/// Sets an option, as `gnomon --set KEY=VALUE` does; an empty value stands for the default. `options`: the index of
/// options that there are, or one past the last, which adds further ones (at most 256). Where a value differs from
/// before, the next plan begins anew: it is made by another planner (GnomonPlan::planner), whose maps are all to be
/// drawn.
GNOMON_C_API GnomonStatus gnomonSetOption(GnomonPlanner* planner, uint32_t options, const char* key,
                                          const char* value) GNOMON_NOEXCEPT;
/// The value of an option, as gnomonSetOption() takes it; null where it fails. It holds until the thread's next call of
/// this function.
GNOMON_C_API const char* gnomonGetOption(const GnomonPlanner* planner, uint32_t options,
                                         const char* key) GNOMON_NOEXCEPT;
/// Can a light of this type (GnomonLightType) have these options? Refused with the sentence that says why not.
GNOMON_C_API GnomonStatus gnomonCheckOptions(const GnomonPlanner* planner, uint32_t options,
                                             uint32_t light_type) GNOMON_NOEXCEPT;
/// A map's texels are gone, or were not drawn: it is drawn whole when it is read next.
GNOMON_C_API GnomonStatus gnomonLoseMap(GnomonPlanner* planner, uint32_t map_index,
                                        uint32_t map_generation) GNOMON_NOEXCEPT;
/// All maps are lost, and partition and fit auto choose anew.
GNOMON_C_API GnomonStatus gnomonLoseAllMaps(GnomonPlanner* planner) GNOMON_NOEXCEPT;

// ---- The plan

/// Plans a frame. Null where it fails; the last plan is gone then, too, if memory is exhausted. Any numbers are taken:
/// a light's outcome says why it cannot be planned.
GNOMON_C_API const GnomonPlan* gnomonPlan(GnomonPlanner* planner, const GnomonFrame* frame) GNOMON_NOEXCEPT;
/// A light of the last plan; null beyond the last.
GNOMON_C_API const GnomonLightPlan* gnomonLightAt(const GnomonPlanner* planner, uint32_t light) GNOMON_NOEXCEPT;
/// A view of the last plan; null beyond the last.
GNOMON_C_API const GnomonView* gnomonViewAt(const GnomonPlanner* planner, uint32_t view) GNOMON_NOEXCEPT;
/// The pages of one of the planner's options; null beyond the last.
GNOMON_C_API const GnomonPages* gnomonPagesAt(const GnomonPlanner* planner, uint32_t options) GNOMON_NOEXCEPT;
/// A pass of the last plan, in the order in which they are drawn; null beyond the last.
GNOMON_C_API const GnomonPass* gnomonPassAt(const GnomonPlanner* planner, uint32_t pass) GNOMON_NOEXCEPT;
/// All of the last plan as JSON text (gnomon::toJson()); null where it fails. It holds until the next call of this
/// function, too.
GNOMON_C_API const char* gnomonPlanJson(GnomonPlanner* planner) GNOMON_NOEXCEPT;

// ---- Further needs of a backend

/// Writes GnomonView::caster_rows rows of four floats for each object, one object after the other, which take its own
/// points to the map: rows of x, y and depth, or of x, y, z, w and depth. They are composed in double precision.
/// `world_from_object`: three rows of four floats for each object, p_ws[i] = dot(row i, (p, 1)). `bias_m`: metres that
/// depth is moved away from the light. `floats`: how many `out` has room for.
GNOMON_C_API GnomonStatus gnomonWriteCasterRows(const GnomonPlanner* planner, uint32_t view,
                                                const float* world_from_object, uint32_t objects, double bias_m,
                                                float* out, size_t floats) GNOMON_NOEXCEPT;
/// Writes the defaults. `size`: sizeof(GnomonPrecision).
GNOMON_C_API GnomonStatus gnomonInitPrecision(GnomonPrecision* precision, size_t size) GNOMON_NOEXCEPT;
/// Writes how many bytes a buffer (GnomonBuffer) of the last plan has.
GNOMON_C_API GnomonStatus gnomonBufferBytes(GnomonPlanner* planner, uint32_t buffer, size_t* bytes) GNOMON_NOEXCEPT;
/// Fills in a buffer. `options` and `precision` are those of GNOMON_BUFFER_CONSTANTS; `precision` may be null, which
/// stands for the defaults. `bytes`: how many `out` has; what is more is left as it is.
GNOMON_C_API GnomonStatus gnomonFillBuffer(GnomonPlanner* planner, uint32_t buffer, uint32_t options,
                                           const GnomonPrecision* precision, void* out, size_t bytes) GNOMON_NOEXCEPT;

// ---- The commands of a frame (docs/c.md#commands)

/// A recorder for an executor with these limits of its device; null where it fails. `most_layers`: of an array of
/// images, 1 ... `uniform_alignment`: of offsets in uniform buffers, bytes, a multiple of 16. `in_software`: a software
/// rasteriser draws. Pass GNOMON_INTERFACE.
GNOMON_C_API GnomonRecorder* gnomonMakeRecorder(uint32_t header_interface, uint32_t most_layers,
                                                uint32_t uniform_alignment, uint32_t in_software) GNOMON_NOEXCEPT;
/// Null does nothing.
GNOMON_C_API void gnomonFreeRecorder(GnomonRecorder* recorder) GNOMON_NOEXCEPT;
/// Images and buffers for the planner's last plan, and a mask of this size, pixels; 0: no mask. Null where it fails,
/// with the sentence that says what is not recorded; errors call this function prepare(). The list holds until the
/// recorder's next call, as do those below; it runs before what the next call records.
GNOMON_C_API const GnomonCommandList* gnomonRecordImages(GnomonRecorder* recorder, const GnomonPlanner* planner,
                                                         uint32_t width_px, uint32_t height_px) GNOMON_NOEXCEPT;
/// The maps that are out of date.
GNOMON_C_API const GnomonCommandList* gnomonRecordMaps(GnomonRecorder* recorder,
                                                       const GnomonPlanner* planner) GNOMON_NOEXCEPT;
/// The mask. `images`: bits of GnomonHas. `precision` may be null, which stands for the defaults.
GNOMON_C_API const GnomonCommandList* gnomonRecordMask(GnomonRecorder* recorder, const GnomonPlanner* planner,
                                                       uint32_t images,
                                                       const GnomonPrecision* precision) GNOMON_NOEXCEPT;
/// The contents of maps are lost: all are drawn again. `images_too`: the images and buffers are gone as well, and
/// gnomonRecordImages() makes them anew.
GNOMON_C_API GnomonStatus gnomonLoseRecorded(GnomonRecorder* recorder, uint32_t images_too) GNOMON_NOEXCEPT;

#if defined(__cplusplus)
}
#endif

#endif
