// SPDX-License-Identifier: Apache-2.0
#include "same_plan.h"

#include <gnomon/pack/caster_rows.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/map_attachments.h>
#include <gnomon/plan_views.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <gtest/gtest.h>

#include <cstring>

namespace gnomon::test {
namespace {

/// Compares the members of one struct. At its end they are as many bytes as the struct, so none was left out.
class Members {
public:
    explicit Members(const char* of, std::size_t size) : of_(of), left_(size) {}
    Members(const Members&) = delete;
    Members& operator=(const Members&) = delete;
    ~Members() { EXPECT_EQ(left_, 0U) << of_ << " has bytes that are not compared"; }

    template <class Wanted>
    void same(const char* name, const std::uint32_t& shown, const Wanted& wanted)
    {
        count(name, sizeof(shown), shown == static_cast<std::uint32_t>(wanted));
    }
    void same(const char* name, const std::uint64_t& shown, std::uint64_t wanted)
    {
        count(name, sizeof(shown), shown == wanted);
    }
    void same(const char* name, const double& shown, double wanted)
    {
        count(name, sizeof(shown), std::memcmp(&shown, &wanted, sizeof(shown)) == 0);
    }
    void same(const char* name, const float& shown, float wanted) { count(name, sizeof(shown), shown == wanted); }
    void same(const char* name, const char* const& shown, std::string_view wanted)
    {
        count(name, sizeof(shown), shown == wanted);
    }
    template <class Number, std::size_t kCount, class Vector>
    void same(const char* name, const Number (&shown)[kCount], const Vector& wanted)
    {
        bool equal = sizeof(Vector) == kCount * sizeof(*glm::value_ptr(wanted));
        for (std::size_t i = 0; i < kCount; ++i) {
            const auto number = static_cast<Number>(glm::value_ptr(wanted)[i]);
            equal = equal && std::memcmp(&shown[i], &number, sizeof(number)) == 0;
        }
        count(name, sizeof(shown), equal);
    }
    /// A list of `size` numbers.
    template <class T>
    void list(const char* name, const T* const& shown, const std::vector<T>& wanted)
    {
        count(name, sizeof(shown), wanted.empty() || std::memcmp(shown, wanted.data(), wanted.size() * sizeof(T)) == 0);
    }
    /// A number of contents, of planners that are told apart.
    void content(const char* name, const std::uint64_t& shown, std::uint64_t wanted, std::uint64_t planner)
    {
        constexpr std::uint64_t kOwn = (std::uint64_t{1} << 40U) - 1;
        count(name, sizeof(shown),
              wanted == 0 ? shown == 0 : (shown & kOwn) == (wanted & kOwn) && shown >> 40U == planner);
    }
    void count(const char* name, std::size_t bytes, bool equal)
    {
        left_ -= bytes;
        if (!equal) {
            ADD_FAILURE() << of_ << "::" << name << " is not that of the C++ plan";
        }
    }

private:
    const char* of_;
    std::size_t left_;
};

#define SAME(member, wanted) all.same(#member, shown.member, wanted)

void expectSameLight(const GnomonLightPlan& shown, const LightPlan& wanted)
{
    Members all("GnomonLightPlan", sizeof(shown));
    SAME(outcome, wanted.outcome.kind);
    SAME(has_map, wanted.outcome.hasMap());
    SAME(outcome_name, nameOf(wanted.outcome.kind));
    SAME(reason, wanted.outcome.reason);
    SAME(first_view, wanted.first_view);
    SAME(view_count, wanted.view_count);
    SAME(mask_layer, wanted.mask_layer);
    SAME(mask_channel, wanted.mask_channel);
    SAME(mask_coloured, wanted.mask_coloured);
    SAME(options, wanted.options);
    SAME(halved, wanted.halved);
    SAME(waited, wanted.waited);
    SAME(first_object_id, wanted.first_object_id);
    SAME(first_volume, wanted.first_volume);
    SAME(volume_count, wanted.volume_count);
    SAME(left_out, wanted.left_out);
    SAME(steps_stepping, wanted.steps.stepping);
    SAME(steps_paired, wanted.steps.paired);
    SAME(steps_smooth, wanted.steps.smooth);
    SAME(steps_alternate, wanted.steps.alternate);
    SAME(steps_read, wanted.steps.read);
    SAME(sample_joined, wanted.sample.joined);
    SAME(steps_earlier_ws, wanted.steps.earlier_ws);
    SAME(steps_later_ws, wanted.steps.later_ws);
    SAME(steps_share, wanted.steps.share);
    SAME(steps_band, wanted.steps.band);
    SAME(steps_edge, wanted.steps.edge);
    SAME(sample_position_ws, wanted.sample.position_ws);
    SAME(sample_direction_ws, wanted.sample.direction_ws);
    SAME(sample_number, wanted.sample.number);
    SAME(choice_made, wanted.choice.made);
    SAME(choice_partition, nameOf(wanted.choice.partition));
    SAME(choice_rates, nameOf(wanted.choice.rates));
    SAME(choice_reason, wanted.choice.reason);
    SAME(choice_texels_per_pixel, wanted.choice.texels_per_pixel);
    SAME(choice_error, wanted.choice.error);
    SAME(choice_other_error, wanted.choice.other_error);
    SAME(choice_time_ms, wanted.choice.time_ms);
    SAME(choice_halvings, wanted.choice.halvings);
    SAME(reserved, 0);
}

void compareProjection(Members& all, const GnomonView& shown, const ViewProjection& wanted, const glm::dvec3& eye_ws)
{
    const glm::dmat4 world_from_eye = glm::translate(glm::dmat4(1.0), eye_ws);
    SAME(caster_rows, pack::casterRowCount(wanted.orthographic));
    SAME(orthographic, wanted.orthographic);
    SAME(clamp_near, wanted.clamp_near);
    SAME(parallel, wanted.parallel);
    SAME(paraboloid, wanted.paraboloid);
    SAME(gpu_cascade, wanted.gpu_cascade);
    SAME(reserved, 0);
    SAME(clip_from_world, wanted.clip_from_world);
    SAME(clip_from_world_f, glm::mat4(wanted.clip_from_world));
    SAME(clip_from_eye_f, glm::mat4(wanted.clip_from_world * world_from_eye));
    SAME(metric_ws, wanted.metric.metric_ws);
    SAME(metric_ws_f, glm::vec4(wanted.metric.metric_ws));
    SAME(metric_eye_f, glm::vec4(wanted.metric.metric_ws * world_from_eye));
    SAME(near_m, wanted.metric.near_m);
    SAME(far_m, wanted.metric.far_m);
    SAME(light_place_ws, wanted.light_place_ws);
    SAME(texel_m, wanted.texel_m);
    SAME(texel_xy_m, wanted.texel_xy_m);
    SAME(light_reach, wanted.light_reach);
    SAME(grid_move_texels, wanted.grid_move_texels);
}

void comparePlace(Members& all, const GnomonView& shown, const ViewPlace& wanted)
{
    SAME(map_index, wanted.map.index);
    SAME(map_generation, wanted.map.generation);
    SAME(tile_layer, wanted.tile.layer);
    SAME(tile_x, wanted.tile.x);
    SAME(tile_y, wanted.tile.y);
    SAME(tile_width, wanted.tile.width);
    SAME(tile_height, wanted.tile.height);
    SAME(tile_part, wanted.part);
}

void compareContents(Members& all, const GnomonView& shown, const View& view, std::uint64_t planner)
{
    const ViewContents& wanted = view.contents;
    all.content("presumes", shown.presumes, wanted.presumes, planner);
    all.content("makes", shown.makes, wanted.makes, planner);
    all.content("kept_presumes", shown.kept_presumes, wanted.kept_presumes, planner);
    all.content("kept_makes", shown.kept_makes, wanted.kept_makes, planner);
    SAME(ids_key, wanted.ids_key);
    SAME(texels_to_draw, texelsToDraw(view));
    SAME(redraw, wanted.redraw);
    SAME(redraw_kept, wanted.redraw_kept);
    SAME(kept_layer, wanted.kept_layer);
    SAME(kept_map_index, wanted.kept_map.index);
    SAME(kept_map_generation, wanted.kept_map.generation);
    SAME(dirty_x, wanted.dirty.x);
    SAME(dirty_y, wanted.dirty.y);
    SAME(dirty_width, wanted.dirty.width);
    SAME(dirty_height, wanted.dirty.height);
    SAME(waited, wanted.waited);
}

void compareServes(Members& all, const GnomonView& shown, const ViewServes& wanted)
{
    SAME(serves_sun, wanted.sun);
    SAME(serves_layered, wanted.layered);
    SAME(slice_across, wanted.slice.across);
    SAME(reserved_too, 0);
    SAME(slice_axis, wanted.slice.axis);
    SAME(slice_over, wanted.slice.over);
    SAME(slice_begin_m, wanted.slice.begin_m);
    SAME(slice_end_m, wanted.slice.end_m);
    SAME(slice_blend_m, wanted.slice.blend_m);
    SAME(sector_x, wanted.sector.x);
    SAME(sector_y, wanted.sector.y);
    SAME(sector_w, wanted.sector.w);
    SAME(serves_faded_in, wanted.faded_in);
    SAME(serves_rim, wanted.rim);
    for (std::size_t i = 0; i < wanted.layers.size(); ++i) {
        SAME(layers[i], glm::dvec2(wanted.layers[i].near, wanted.layers[i].far));
    }
}

void compareAttachments(Members& all, const GnomonView& shown, const pack::MapAttachments& wanted, TexelPart part)
{
    SAME(depth_format, nameOf(wanted.depth));
    SAME(colour_format, wanted.colour ? nameOf(*wanted.colour) : std::string_view());
    SAME(clear_depth, wanted.clear_depth);
    SAME(clear_colour, wanted.clear_colour);
    SAME(samples, wanted.samples);
    SAME(write_depth, wanted.write_depth);
    SAME(need_fragment_shader, wanted.needFragmentShader());
    SAME(channels, wanted.colour ? pack::channelsOfPart(*wanted.colour, part) : 0);
}

void expectSameView(const GnomonView& shown, const Plan& plan, const View& wanted, std::uint64_t planner)
{
    Members all("GnomonView", sizeof(shown));
    SAME(light, wanted.light);
    SAME(options, plan.lights[wanted.light].options);
    SAME(first_caster, wanted.casters.first);
    SAME(caster_count, wanted.casters.count);
    SAME(still_casters, wanted.casters.still);
    compareProjection(all, shown, wanted.projection, plan.made_for.camera.eye_ws);
    comparePlace(all, shown, wanted.place);
    compareContents(all, shown, wanted, planner);
    compareServes(all, shown, wanted.serves);
    SAME(fit_strength, wanted.fit.strength);
    SAME(finest_texel, wanted.fit.finest_texel);
    SAME(coarsest_texel, wanted.fit.coarsest_texel);
    compareAttachments(all, shown, pack::mapAttachments(plan, wanted), wanted.place.part);
}

void expectSamePages(const GnomonPages& shown, const MapPages& wanted, const ResolvedOptions& options)
{
    Members all("GnomonPages", sizeof(shown));
    SAME(width, wanted.width);
    SAME(height, wanted.height);
    SAME(layers, wanted.layers);
    SAME(kept_layers, wanted.kept_layers);
    SAME(levels, wanted.width == 0 ? 1 : pack::mipLevels(options, wanted.width, wanted.height));
    SAME(waiting_lights, wanted.waiting_lights);
    SAME(waiting_maps, wanted.waiting_maps);
    SAME(longest_wait, wanted.longest_wait);
    SAME(wanted_texels, wanted.wanted_texels);
    SAME(given_texels, wanted.given_texels);
    SAME(drawn_texels, wanted.drawn_texels);
    SAME(margin_texels, tileMarginTexels(options.reach_texels()));
    SAME(reach_texels, double{options.reach_texels()});
    SAME(fade_begin_m, options.fadeBegin_m());
    SAME(fade_end_m, options.fadeEnd_m());
    SAME(filter, nameOf(options.filter()));
    SAME(format, nameOf(options.format()));
    const bool has_blocks = options.traits().integrates_light && wanted.width > 0;
    SAME(blocks_size, has_blocks ? pack::blocksExtent({wanted.width, wanted.height}).x : 0);
    SAME(blocks_levels, has_blocks ? pack::blockLevels({wanted.width, wanted.height}) : 0);
}

void expectSameLists(const GnomonPlan& shown, const Plan& wanted, std::size_t passes)
{
    Members all("GnomonPlan", sizeof(shown));
    SAME(frame, wanted.frame);
    SAME(number, wanted.number);
    all.count("planner", sizeof(shown.planner), shown.planner != wanted.planner);
    SAME(cut, wanted.cut);
    SAME(light_count, wanted.lights.size());
    SAME(view_count, wanted.views.size());
    SAME(options_count, wanted.pages.size());
    SAME(pass_count, passes);
    SAME(map_count, wanted.map_count);
    SAME(mask_layers, wanted.mask_layers);
    SAME(mask_channels, maskChannelCount(wanted));
    SAME(caster_count, wanted.casters.size());
    SAME(receiver_count, wanted.receivers.size());
    SAME(object_id_count, wanted.object_ids.size());
    SAME(moved_count, wanted.moved_ws.size());
    all.list("casters", shown.casters, wanted.casters);
    all.list("receivers", shown.receivers, wanted.receivers);
    all.list("object_ids", shown.object_ids, wanted.object_ids);
    bool moved = true;
    for (std::size_t i = 0; i < wanted.moved_ws.size(); ++i) {
        moved = moved && glm::make_vec3(shown.moved[i].min) == wanted.moved_ws[i].min &&
                glm::make_vec3(shown.moved[i].max) == wanted.moved_ws[i].max;
    }
    all.count("moved", sizeof(shown.moved), moved);
}

} // namespace

void expectSamePlan(const GnomonPlanner* planner, const GnomonPlan& shown, const Plan& wanted)
{
    std::vector<pack::FramePass> passes;
    pack::listFramePasses(wanted, passes);
    expectSameLists(shown, wanted, passes.size());
    for (std::uint32_t i = 0; i < wanted.lights.size(); ++i) {
        SCOPED_TRACE(i);
        expectSameLight(*gnomonLightAt(planner, i), wanted.lights[i]);
    }
    for (std::uint32_t i = 0; i < wanted.views.size(); ++i) {
        SCOPED_TRACE(i);
        expectSameView(*gnomonViewAt(planner, i), wanted, wanted.views[i], shown.planner);
    }
    for (std::uint32_t i = 0; i < wanted.pages.size(); ++i) {
        expectSamePages(*gnomonPagesAt(planner, i), wanted.pages[i], (*wanted.options)[i]);
    }
    for (std::uint32_t i = 0; i < passes.size(); ++i) {
        const GnomonPass& pass = *gnomonPassAt(planner, i);
        EXPECT_EQ(pass.kind, static_cast<std::uint32_t>(passes[i].kind));
        EXPECT_EQ(pass.options, passes[i].options);
        EXPECT_NE(pass.name, std::string());
    }
}

GnomonLight lightOf(const Light& light)
{
    GnomonLight out;
    gnomonInitLight(&out, sizeof(out));
    out.key = light.key;
    out.type = static_cast<std::uint32_t>(light.type);
    out.casts_shadow = light.casts_shadow ? 1 : 0;
    std::memcpy(out.position_ws, glm::value_ptr(light.position_ws), sizeof(out.position_ws));
    std::memcpy(out.direction_ws, glm::value_ptr(light.direction_ws), sizeof(out.direction_ws));
    out.outer_half_angle_rad = light.outer_half_angle_rad;
    out.range_m = light.range_m;
    out.near_m = light.near_m;
    out.angular_diameter_rad = light.angular_diameter_rad;
    out.radius_m = light.radius_m;
    out.brightness = light.brightness;
    out.options = light.options;
    out.map_size = light.map_size;
    out.groups = light.groups;
    return out;
}

GnomonFrame frameOf(const Frame& frame)
{
    GnomonFrame out;
    gnomonInitFrame(&out, sizeof(out));
    out.index = frame.index;
    out.time_s = frame.time_s;
    std::memcpy(out.camera.eye_ws, glm::value_ptr(frame.camera.eye_ws), sizeof(out.camera.eye_ws));
    std::memcpy(out.camera.clip_from_world, glm::value_ptr(frame.camera.clip_from_world),
                sizeof(out.camera.clip_from_world));
    std::memcpy(out.camera.jitter_px, glm::value_ptr(frame.camera.jitter_px), sizeof(out.camera.jitter_px));
    out.camera.reversed_z = frame.camera.reversed_z ? 1 : 0;
    out.camera.clip_depth = static_cast<std::uint32_t>(frame.camera.clip_depth);
    out.width_px = frame.size_px.x;
    out.height_px = frame.size_px.y;
    out.cut = frame.cut ? 1 : 0;
    out.draw_ms_per_texel = frame.draw_ms_per_texel;
    out.clamps_depth = frame.clamps_depth ? 1 : 0;
    out.rates.rest_ns = frame.rates.rest_ns;
    out.rates.caster_ns = frame.rates.caster_ns;
    out.rates.texel_ns = frame.rates.texel_ns;
    out.rates.block_texel_ns = frame.rates.block_texel_ns;
    out.rates.moment_texel_ns = frame.rates.moment_texel_ns;
    out.rates.compare_ns = frame.rates.compare_ns;
    out.rates.search_ns = frame.rates.search_ns;
    out.rates.ray_ns = frame.rates.ray_ns;
    out.rates.source = static_cast<std::uint32_t>(frame.rates.source);
    return out;
}

} // namespace gnomon::test
