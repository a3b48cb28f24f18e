// SPDX-License-Identifier: Apache-2.0
#include "../rts/plants.h"
#include "../scene_maker.h"
#include "furnish.h"
#include "furniture.h"

namespace gnomon::worlds {

Wares addWares(Scene& scene, const RingPalette& p)
{
    const auto add = [&](Mesh mesh) {
        return addMesh(scene, std::move(mesh));
    };
    Wares w{};
    w.stool = add(makeStool(p));
    w.table = add(makeTable(p));
    w.shelf = add(makeBottleShelf(p));
    w.jukebox = add(makeJukebox(p));
    w.glasses = add(makeGlasses(p));
    w.bench = add(makeBench(p));
    w.nightstand = add(makeNightstand(p));
    w.chairs = {add(makeTubChair(p, 0xC7742E)), add(makeTubChair(p, 0x2F7F86)), add(makeTubChair(p, 0xD9C9A8))};
    w.sofas = {add(makeSofa(p, 0xB5485A)), add(makeSofa(p, 0x3E6FA0)), add(makeSofa(p, 0xC9A24E))};
    w.beds = {add(makeBed(p, 0xB5412F)), add(makeBed(p, 0x2F6F9E)), add(makeBed(p, 0x4F8A54))};
    w.lockers = {add(makeLocker(p, 0x4F7FA0)), add(makeLocker(p, 0xA0563C)), add(makeLocker(p, 0x7E8A92))};
    w.crates = {add(makeCrate(p, 0xC78B3A)), add(makeCrate(p, 0x5B86A8)), add(makeCrate(p, 0x8FA05A))};
    w.drums = {add(makeDrum(p, 0xC8452F)), add(makeDrum(p, 0x2F7F86)), add(makeDrum(p, 0xD9B23C))};
    w.consoles = {add(makeConsole(p, Hue::cyan)), add(makeConsole(p, Hue::lime)), add(makeConsole(p, Hue::amber))};
    w.stalls = {add(makeStall(p, 0xC23B32)), add(makeStall(p, 0x2F7F86)), add(makeStall(p, 0xD99A2B))};
    w.planters = {add(makePlanter(p, 0xB5653A)), add(makePlanter(p, 0x2F6F78)), add(makePlanter(p, 0xD9D2C4))};
    w.scanner = add(makeScanner(p));
    w.workbench = add(makeWorkbench(p));
    w.turbine = add(makeTurbine(p));
    w.boiler = add(makeBoiler(p));
    w.wares = add(makeWares(p));
    w.fern = add(makeFern(p));
    w.bush = add(makeBush(p.common));
    w.tree = add(makeBroadTree(p.common, 1));
    w.rock = add(makeRock(p.common, 0));
    w.palms = {add(makePalm(p, 0)), add(makePalm(p, 1))};
    return w;
}

} // namespace gnomon::worlds
