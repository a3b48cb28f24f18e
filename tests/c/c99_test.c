// SPDX-License-Identifier: Apache-2.0
// A sun, a spot and a lamp are planned from C, and the plan is what one would expect of them.
#include <gnomon/gnomon.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void expect(int holds, const char* what, int line)
{
    if (!holds) {
        ++failures;
        fprintf(stderr, "c99_test.c:%d: %s; the last error is \"%s\"\n", line, what, gnomonLastError()->message);
    }
}
#define EXPECT(condition) expect(condition, #condition, __LINE__)
#define DONE(call) expect((call) == GNOMON_OK, #call, __LINE__)

enum { kLights = 3, kBoxes = 8 };

// The place of a point on a view's map, -1 .. 1 over its tile, and its depth.
static void place(const GnomonView* view, const double p[3], double xy[2], double* depth)
{
    double clip[4];
    for (int row = 0; row < 4; ++row) {
        clip[row] = view->clip_from_world[12 + row];
        for (int i = 0; i < 3; ++i) {
            clip[row] += view->clip_from_world[4 * i + row] * p[i];
        }
    }
    xy[0] = clip[0] / clip[3];
    xy[1] = clip[1] / clip[3];
    *depth = view->metric_ws[3];
    for (int i = 0; i < 3; ++i) {
        *depth += view->metric_ws[i] * p[i];
    }
}

// A ground, and boxes in a ring around the origin.
static void addObjects(GnomonObjects* objects, GnomonObjectId boxes[kBoxes])
{
    GnomonObjectFlags flags;
    GnomonObjectId ground;
    const GnomonBounds level = {{-20.0F, -0.1F, -20.0F}, {20.0F, 0.0F, 20.0F}};
    DONE(gnomonInitObjectFlags(&flags, sizeof(flags)));
    EXPECT(flags.casts == 1 && flags.receives == 1 && flags.dynamic == 0 && flags.groups == 1);
    flags.casts = 0;
    DONE(gnomonAddObject(objects, &level, &flags, &ground));
    EXPECT(ground.index == 0);
    for (int i = 0; i < kBoxes; ++i) {
        const float x = 4.0F * (float)cos(0.785 * i);
        const float z = 4.0F * (float)sin(0.785 * i);
        const GnomonBounds box = {{x - 0.5F, 0.0F, z - 0.5F}, {x + 0.5F, 1.0F, z + 0.5F}};
        DONE(gnomonAddObject(objects, &box, NULL, &boxes[i]));
        EXPECT(boxes[i].index == (uint32_t)i + 1 && boxes[i].generation != 0);
    }
}

static void fillLights(GnomonLight lights[kLights])
{
    for (uint32_t i = 0; i < kLights; ++i) {
        DONE(gnomonInitLight(&lights[i], sizeof(lights[i])));
        lights[i].key = i;
        lights[i].position_ws[1] = 6.0;
        lights[i].range_m = 20.0;
    }
    lights[0].type = GNOMON_DIRECTIONAL;
    lights[0].direction_ws[0] = 0.6;
    lights[0].direction_ws[1] = -0.8;
    lights[1].type = GNOMON_SPOT;
    lights[1].outer_half_angle_rad = 0.8;
    lights[2].type = GNOMON_POINT;
    lights[2].position_ws[1] = 1.5; // among the boxes
    lights[2].options = 1;
}

static void fillFrame(GnomonFrame* frame, const GnomonObjects* objects, const GnomonLight* lights)
{
    // At (0, 4, 12), looking along -z; 90 degrees wide, reversed depth from 0.1 m on.
    const double clip_from_world[16] = {1.0, 0.0, 0.0, 0.0,  0.0, -1.0, 0.0, 0.0,
                                        0.0, 0.0, 0.0, -1.0, 0.0, 4.0,  0.1, 12.0};
    DONE(gnomonInitFrame(frame, sizeof(*frame)));
    memcpy(frame->camera.clip_from_world, clip_from_world, sizeof(clip_from_world));
    frame->camera.eye_ws[1] = 4.0;
    frame->camera.eye_ws[2] = 12.0;
    frame->objects = objects;
    frame->lights = lights;
    frame->light_count = kLights;
    frame->index = 17;
}

// All views of a light are on their tile, and have the boxes that they should.
static void checkViews(const GnomonPlanner* planner, const GnomonPlan* plan, uint32_t index, uint32_t views)
{
    const GnomonLightPlan* light = gnomonLightAt(planner, index);
    EXPECT(light != NULL);
    if (light == NULL) {
        return;
    }
    EXPECT(light->outcome == GNOMON_PLANNED && light->has_map == 1 && strcmp(light->outcome_name, "ok") == 0);
    EXPECT(light->reason[0] == '\0' && light->view_count == views);
    for (uint32_t i = 0; i < light->view_count; ++i) {
        const GnomonView* view = gnomonViewAt(planner, light->first_view + i);
        const GnomonPages* pages = gnomonPagesAt(planner, view->options);
        EXPECT(view->light == index && view->redraw == 1 && view->makes != 0 && view->presumes == 0);
        EXPECT(view->tile_width == 512 && view->tile_height == 512);
        EXPECT(view->tile_x + view->tile_width <= pages->width && view->tile_y + view->tile_height <= pages->height);
        EXPECT(view->tile_layer < pages->layers && view->map_index < plan->map_count);
        EXPECT(view->first_caster + view->caster_count <= plan->caster_count);
        for (uint32_t c = 0; c < view->caster_count; ++c) {
            const uint32_t caster = plan->casters[view->first_caster + c];
            EXPECT(caster >= 1 && caster <= kBoxes);
        }
        for (int n = 0; n < 16; ++n) {
            EXPECT(view->clip_from_world_f[n] == (float)view->clip_from_world[n]);
        }
    }
}

static void checkPlaces(const GnomonPlanner* planner)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    for (uint32_t light = 0; light < 2; ++light) {
        const GnomonView* view = gnomonViewAt(planner, gnomonLightAt(planner, light)->first_view);
        double xy[2];
        double depth = -1.0;
        place(view, origin, xy, &depth);
        EXPECT(fabs(xy[0]) < 1.0 && fabs(xy[1]) < 1.0 && depth > 0.0 && depth < 1.0);
        if (light == 1) { // straight below the spot, 6 m from it
            EXPECT(fabs(xy[0]) < 0.01 && fabs(xy[1]) < 0.01);
            EXPECT(fabs(depth * (view->far_m - view->near_m) + view->near_m - 6.0) < 1e-9);
            EXPECT(view->parallel == 0 && view->orthographic == 0 && view->caster_rows == 5);
        } else {
            EXPECT(view->parallel == 1 && view->orthographic == 1 && view->caster_rows == 3);
        }
    }
}

static void checkPasses(const GnomonPlanner* planner, const GnomonPlan* plan)
{
    EXPECT(plan->pass_count == 3 && plan->options_count == 2);
    if (plan->pass_count == 3) {
        EXPECT(gnomonPassAt(planner, 0)->kind == GNOMON_PASS_MAPS && gnomonPassAt(planner, 0)->options == 0);
        EXPECT(gnomonPassAt(planner, 1)->kind == GNOMON_PASS_MAPS && gnomonPassAt(planner, 1)->options == 1);
        EXPECT(gnomonPassAt(planner, 2)->kind == GNOMON_PASS_MASK &&
               strcmp(gnomonPassAt(planner, 2)->name, "mask") == 0);
    }
    EXPECT(strcmp(gnomonPagesAt(planner, 0)->filter, "pcf") == 0 &&
           strcmp(gnomonPagesAt(planner, 0)->format, "d32f") == 0);
}

// Nothing moves, then a box does: its maps alone are drawn again.
static void checkMotion(GnomonObjects* objects, GnomonPlanner* planner, const GnomonFrame* frame, GnomonObjectId box)
{
    const GnomonBounds moved = {{-0.5F, 0.0F, -0.5F}, {0.5F, 1.5F, 0.5F}};
    const GnomonPlan* plan = gnomonPlan(planner, frame);
    EXPECT(plan != NULL && plan->number == 2);
    for (uint32_t i = 0; plan != NULL && i < plan->view_count; ++i) {
        EXPECT(gnomonViewAt(planner, i)->redraw == 0 && gnomonViewAt(planner, i)->texels_to_draw == 0);
    }
    DONE(gnomonMoveObjects(objects, &box, &moved, 1));
    plan = gnomonPlan(planner, frame);
    EXPECT(plan != NULL && gnomonViewAt(planner, gnomonLightAt(planner, 1)->first_view)->redraw == 1);
    DONE(gnomonRemoveObject(objects, box));
    EXPECT(gnomonTouchObject(objects, box) == GNOMON_REFUSED);
}

int main(void)
{
    GnomonObjects* objects = gnomonMakeObjects(GNOMON_INTERFACE);
    GnomonPlanner* planner = gnomonMakePlanner(GNOMON_INTERFACE);
    GnomonObjectId boxes[kBoxes];
    GnomonLight lights[kLights];
    GnomonFrame frame;
    const GnomonPlan* plan;
    EXPECT(objects != NULL && planner != NULL && strncmp(gnomonVersion(), "0.", 2) == 0);
    EXPECT(gnomonLastError()->status == GNOMON_OK && gnomonLastError()->message[0] == '\0');
    addObjects(objects, boxes);
    fillLights(lights);
    for (uint32_t options = 0; options < 2; ++options) {
        DONE(gnomonSetOption(planner, options, "filter", "pcf"));
        DONE(gnomonSetOption(planner, options, "fit", "uniform"));
        DONE(gnomonSetOption(planner, options, "partition", options == 0 ? "single" : "cube"));
        DONE(gnomonSetOption(planner, options, "map-size", "512"));
    }
    EXPECT(strcmp(gnomonGetOption(planner, 1, "partition"), "cube") == 0);
    fillFrame(&frame, objects, lights);

    plan = gnomonPlan(planner, &frame);
    EXPECT(plan != NULL);
    if (plan != NULL) {
        EXPECT(plan->frame == 17 && plan->number == 1 && plan->light_count == kLights && plan->mask_channels == 4);
        checkViews(planner, plan, 0, 1);
        checkViews(planner, plan, 1, 1);
        checkViews(planner, plan, 2, gnomonLightAt(planner, 2)->view_count);
        EXPECT(gnomonLightAt(planner, 2)->view_count >= 4 && gnomonLightAt(planner, 2)->view_count <= 6);
        checkPlaces(planner);
        checkPasses(planner, plan);
        checkMotion(objects, planner, &frame, boxes[3]);
    }
    gnomonFreePlanner(planner);
    gnomonFreeObjects(objects);
    printf("%d failures\n", failures);
    return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
