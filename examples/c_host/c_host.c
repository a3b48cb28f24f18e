// SPDX-License-Identifier: Apache-2.0
// A host in C plans a frame and prints what it would draw: docs/c.md has the lines between the marks.
#include <gnomon/gnomon.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(void)
{
    fprintf(stderr, "c_host: %s\n", gnomonLastError()->message);
    return EXIT_FAILURE;
}

// Yours: record the commands that draw these casters to this tile.
static void drawMap(const GnomonPlan* plan, const GnomonView* view)
{
    printf("  map %u of light %u: %ux%u texels at (%u, %u) of page %u, objects", (unsigned)view->map_index,
           (unsigned)view->light, (unsigned)view->tile_width, (unsigned)view->tile_height, (unsigned)view->tile_x,
           (unsigned)view->tile_y, (unsigned)view->tile_layer);
    for (uint32_t i = 0; i < view->caster_count; ++i) {
        printf(" %u", (unsigned)plan->casters[view->first_caster + i]);
    }
    printf("\n");
}

int main(void)
{
    const GnomonBounds ground = {{-20.0F, -0.1F, -20.0F}, {20.0F, 0.0F, 20.0F}};
    const GnomonBounds box = {{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}};
    // From (0, 2, 10) along -z, 90 degrees wide; depth is 1 at 0.1 m and 0 without an end.
    const double clip_from_world[16] = {1.0, 0.0, 0.0, 0.0,  0.0, -1.0, 0.0, 0.0,
                                        0.0, 0.0, 0.0, -1.0, 0.0, 2.0,  0.1, 10.0};
    const double eye_ws[3] = {0.0, 2.0, 10.0};
    uint64_t drawn[64] = {0}; // by map: the contents that it has

    // docs/c.md begin
    GnomonObjects* objects = gnomonMakeObjects(GNOMON_INTERFACE);
    GnomonPlanner* planner = gnomonMakePlanner(GNOMON_INTERFACE);
    GnomonObjectId id;
    if (gnomonAddObject(objects, &ground, NULL, &id) != GNOMON_OK ||
        gnomonAddObject(objects, &box, NULL, &id) != GNOMON_OK ||
        gnomonSetOption(planner, 0, "filter", "pcf") != GNOMON_OK ||
        gnomonSetOption(planner, 0, "map-size", "1024") != GNOMON_OK) {
        return fail(); // prints gnomonLastError()->message
    }

    GnomonLight sun;
    GnomonFrame frame;
    gnomonInitLight(&sun, sizeof(sun)); // the defaults
    gnomonInitFrame(&frame, sizeof(frame));
    sun.direction_ws[0] = 0.6;
    sun.direction_ws[1] = -0.8;
    memcpy(frame.camera.eye_ws, eye_ws, sizeof(eye_ws));
    memcpy(frame.camera.clip_from_world, clip_from_world, sizeof(clip_from_world)); // in columns
    frame.objects = objects;
    frame.lights = &sun;
    frame.light_count = 1;

    for (frame.index = 0; frame.index < 2; ++frame.index) {
        const GnomonPlan* plan = gnomonPlan(planner, &frame);
        if (plan == NULL) {
            return fail();
        }
        for (uint32_t i = 0; i < plan->pass_count; ++i) {
            const GnomonPass* pass = gnomonPassAt(planner, i);
            printf("frame %u, pass %s\n", (unsigned)plan->frame, pass->name);
            for (uint32_t v = 0; pass->kind == GNOMON_PASS_MAPS && v < plan->view_count; ++v) {
                const GnomonView* view = gnomonViewAt(planner, v);
                if (view->options == pass->options && view->makes != 0 && drawn[view->map_index] != view->makes) {
                    drawMap(plan, view); // yours
                    drawn[view->map_index] = view->makes;
                }
            }
        }
    }
    gnomonFreePlanner(planner);
    gnomonFreeObjects(objects);
    // docs/c.md end
    return EXIT_SUCCESS;
}
