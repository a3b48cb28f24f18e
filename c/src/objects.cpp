// SPDX-License-Identifier: Apache-2.0
#include "handles.h"

#include <memory>

using namespace gnomon;
using namespace gnomon::c;

namespace {

constexpr const char* kFlags = "GnomonObjectFlags";

ObjectFlags readFlags(const GnomonObjectFlags& flags)
{
    return taken(readStruct<GnomonObjectFlags, ObjectFlags>(&flags, kFlags));
}

ObjectId requireAlive(const ObjectSet& set, const GnomonObjectId& id)
{
    const ObjectId name{id.index, id.generation};
    if (!set.alive(name)) {
        throw WrongCall{"the set has no object of the name " + std::to_string(id.index) + ", " +
                            std::to_string(id.generation),
                        "keep what gnomonAddObject() writes, until the object is removed"};
    }
    return name;
}

} // namespace

extern "C" {

GnomonObjects* gnomonMakeObjects(uint32_t header_interface) noexcept
{
    return guardedPointer("making an object set", [&] {
        requireInterface(header_interface);
        return std::make_unique<GnomonObjects>().release();
    });
}

void gnomonFreeObjects(GnomonObjects* objects) noexcept
{
    delete objects;
}

GnomonStatus gnomonAddObject(GnomonObjects* objects, const GnomonBounds* bounds, const GnomonObjectFlags* flags,
                             GnomonObjectId* id) noexcept
{
    return guarded("adding an object", [&] {
        ObjectSet& set = required(objects, "objects").set;
        GnomonObjectId& out = required(id, "id");
        const Aabb box = taken(required(bounds, "bounds"));
        const ObjectId added = set.add(box, flags != nullptr ? readFlags(*flags) : ObjectFlags{});
        if (!added) {
            throw WrongCall{"the set is full", "remove objects, or join some"};
        }
        out = {added.index, added.generation};
    });
}

GnomonStatus gnomonMoveObjects(GnomonObjects* objects, const GnomonObjectId* ids, const GnomonBounds* bounds,
                               uint32_t count) noexcept
{
    return guarded("moving objects", [&] {
        ObjectSet& set = required(objects, "objects").set;
        if (count == 0) {
            return;
        }
        required(ids, "ids");
        required(bounds, "bounds");
        for (uint32_t i = 0; i < count; ++i) {
            requireAlive(set, ids[i]);
        }
        for (uint32_t i = 0; i < count; ++i) {
            set.update({ids[i].index, ids[i].generation}, taken(bounds[i]));
        }
    });
}

GnomonStatus gnomonTouchObject(GnomonObjects* objects, GnomonObjectId id) noexcept
{
    return guarded("touching an object", [&] {
        ObjectSet& set = required(objects, "objects").set;
        set.touch(requireAlive(set, id));
    });
}

GnomonStatus gnomonSetObjectFlags(GnomonObjects* objects, GnomonObjectId id, const GnomonObjectFlags* flags) noexcept
{
    return guarded("setting an object's flags", [&] {
        ObjectSet& set = required(objects, "objects").set;
        const ObjectId name = requireAlive(set, id);
        set.setFlags(name, readFlags(required(flags, "flags")));
    });
}

GnomonStatus gnomonRemoveObject(GnomonObjects* objects, GnomonObjectId id) noexcept
{
    return guarded("removing an object", [&] {
        ObjectSet& set = required(objects, "objects").set;
        set.remove(requireAlive(set, id));
    });
}

} // extern "C"
