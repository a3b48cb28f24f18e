// SPDX-License-Identifier: Apache-2.0
#include "structs.h"

#include "handles.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::c {
namespace {

static_assert(static_cast<int>(LightType::spot) == GNOMON_SPOT && static_cast<int>(LightType::point) == GNOMON_POINT &&
              static_cast<int>(ClipDepth::minus_one_to_one) == GNOMON_MINUS_ONE_TO_ONE &&
              static_cast<int>(RateSource::software) == GNOMON_SOFTWARE &&
              static_cast<int>(RateSource::measured) == GNOMON_MEASURED);

template <class Vector, std::size_t kCount>
void put(const Vector& from, double (&to)[kCount])
{
    std::copy_n(glm::value_ptr(from), kCount, to);
}

template <class Vector, class Number, std::size_t kCount>
void get(const Number (&from)[kCount], Vector& to)
{
    std::copy_n(from, kCount, glm::value_ptr(to));
}

/// The times of rates, in the order of both structs.
constexpr std::array kTimes{&DeviceRates::rest_ns,        &DeviceRates::caster_ns,       &DeviceRates::texel_ns,
                            &DeviceRates::block_texel_ns, &DeviceRates::moment_texel_ns, &DeviceRates::compare_ns,
                            &DeviceRates::search_ns,      &DeviceRates::ray_ns};
constexpr std::array kGivenTimes{&GnomonDeviceRates::rest_ns,         &GnomonDeviceRates::caster_ns,
                                 &GnomonDeviceRates::texel_ns,        &GnomonDeviceRates::block_texel_ns,
                                 &GnomonDeviceRates::moment_texel_ns, &GnomonDeviceRates::compare_ns,
                                 &GnomonDeviceRates::search_ns,       &GnomonDeviceRates::ray_ns};

DeviceRates taken(const GnomonDeviceRates& rates)
{
    DeviceRates out;
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
        const double time = rates.*kGivenTimes[i];
        if (!(std::isfinite(time) && time >= 0.0)) {
            throw WrongCall{"a time of GnomonFrame::rates is not finite or below 0",
                            "leave the defaults where unknown"};
        }
        out.*kTimes[i] = time;
    }
    out.source = static_cast<RateSource>(takenEnum(rates.source, 3, "GnomonDeviceRates::source"));
    return out;
}

void requireReserved(std::uint32_t value, const char* name)
{
    if (value != 0) {
        throw WrongCall{std::string(name) + "::reserved is " + std::to_string(value), "leave it 0"};
    }
}

Camera taken(const GnomonCamera& camera)
{
    Camera out;
    get(camera.eye_ws, out.eye_ws);
    get(camera.clip_from_world, out.clip_from_world);
    get(camera.jitter_px, out.jitter_px);
    out.reversed_z = camera.reversed_z != 0;
    out.clip_depth = static_cast<ClipDepth>(takenEnum(camera.clip_depth, 2, "GnomonCamera::clip_depth"));
    return out;
}

GnomonCamera given(const Camera& camera)
{
    GnomonCamera out{};
    put(camera.eye_ws, out.eye_ws);
    put(camera.clip_from_world, out.clip_from_world);
    put(camera.jitter_px, out.jitter_px);
    out.reversed_z = camera.reversed_z ? 1 : 0;
    out.clip_depth = static_cast<std::uint32_t>(camera.clip_depth);
    return out;
}

/// Calls `each` with every element of a host's array of versioned structs, which are as far apart as the first says.
template <class T, class Cpp, class Each>
void readStructs(const T* first, std::uint32_t count, const char* name, const Each& each)
{
    if (count == 0) {
        return;
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(&required(first, name));
    const std::uint32_t size = readStruct<T, Cpp>(bytes, name).size;
    for (std::uint32_t i = 0; i < count; ++i) {
        const T own = readStruct<T, Cpp>(bytes + std::size_t{size} * i, name);
        if (own.size != size) {
            throw WrongCall{std::string(name) + " have different sizes", "set that of each by gnomonInit...()"};
        }
        each(own);
    }
}

} // namespace

std::uint8_t takenEnum(std::uint32_t value, std::uint32_t count, const char* name)
{
    requireIndex(value, count, name);
    return static_cast<std::uint8_t>(value);
}

void requireSize(std::size_t size, std::size_t first, std::size_t now, const char* name)
{
    if (size < first || size > now || size % sizeof(std::uint32_t) != 0) {
        throw WrongCall{std::string("the size of ") + name + " is " + std::to_string(size) + " bytes, and it can be " +
                            std::to_string(first) + " to " + std::to_string(now),
                        "set it by gnomonInit...(), and take a library that is as new as its header"};
    }
}

GnomonObjectFlags given(const ObjectFlags& flags)
{
    GnomonObjectFlags out{};
    out.size = sizeof(out);
    out.casts = flags.casts ? 1 : 0;
    out.receives = flags.receives ? 1 : 0;
    out.dynamic = flags.dynamic ? 1 : 0;
    out.closed = flags.closed ? 1 : 0;
    out.joined = flags.joined ? 1 : 0;
    out.pieces = flags.pieces;
    out.groups = flags.groups;
    return out;
}

ObjectFlags taken(const GnomonObjectFlags& flags)
{
    requireIndex(flags.pieces, kMostPieces + 1, "GnomonObjectFlags::pieces");
    return {.casts = flags.casts != 0,
            .receives = flags.receives != 0,
            .dynamic = flags.dynamic != 0,
            .closed = flags.closed != 0,
            .pieces = static_cast<std::uint16_t>(flags.pieces),
            .joined = flags.joined != 0,
            .groups = flags.groups};
}

Aabb taken(const GnomonBounds& bounds)
{
    Aabb out;
    get(bounds.min, out.min);
    get(bounds.max, out.max);
    return out;
}

GnomonLight given(const Light& light)
{
    GnomonLight out{};
    out.size = sizeof(out);
    out.key = light.key;
    out.type = static_cast<std::uint32_t>(light.type);
    out.casts_shadow = light.casts_shadow ? 1 : 0;
    put(light.position_ws, out.position_ws);
    put(light.direction_ws, out.direction_ws);
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

Light taken(const GnomonLight& light)
{
    requireReserved(light.reserved, "GnomonLight");
    Light out;
    out.key = light.key;
    out.type = static_cast<LightType>(takenEnum(light.type, 3, "GnomonLight::type"));
    out.casts_shadow = light.casts_shadow != 0;
    get(light.position_ws, out.position_ws);
    get(light.direction_ws, out.direction_ws);
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

GnomonPageRequests given(const PageRequests& requests)
{
    GnomonPageRequests out{};
    out.size = sizeof(out);
    out.light_key = requests.light_key;
    put(requests.clip_from_world, out.clip_from_world);
    out.width_px = requests.size_px.x;
    out.height_px = requests.size_px.y;
    return out;
}

GnomonPrecision given(const pack::DrawPrecision& precision)
{
    return {sizeof(GnomonPrecision), precision.sub_pixel_bits, precision.receivers_from_depth ? 1U : 0U,
            precision.depth_rounding, precision.normal_error_rad};
}

pack::DrawPrecision taken(const GnomonPrecision& precision)
{
    const auto require = [](float value, float most, const char* name) {
        if (!(value >= 0.0F && value <= most)) {
            throw WrongCall{std::string("GnomonPrecision::") + name + " is outside of its range", ""};
        }
    };
    require(precision.depth_rounding, 0.01F, "depth_rounding");
    require(precision.normal_error_rad, 0.2F, "normal_error_rad");
    return {.sub_pixel_bits = precision.sub_pixel_bits,
            .receivers_from_depth = precision.receivers_from_depth != 0,
            .depth_rounding = precision.depth_rounding,
            .normal_error_rad = precision.normal_error_rad};
}

GnomonFrame given(const Frame& frame)
{
    GnomonFrame out{};
    out.size = sizeof(out);
    out.cut = frame.cut ? 1 : 0;
    out.index = frame.index;
    out.time_s = frame.time_s;
    out.camera = given(frame.camera);
    out.width_px = frame.size_px.x;
    out.height_px = frame.size_px.y;
    out.clamps_depth = frame.clamps_depth ? 1 : 0;
    out.draw_ms_per_texel = frame.draw_ms_per_texel;
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
        out.rates.*kGivenTimes[i] = frame.rates.*kTimes[i];
    }
    out.rates.source = static_cast<std::uint32_t>(frame.rates.source);
    return out;
}

const Frame& FrameTaker::take(const GnomonFrame& frame)
{
    const auto own = readStruct<GnomonFrame, Frame>(&frame, "GnomonFrame");
    requireReserved(own.rates.reserved, "GnomonDeviceRates");
    takeLights(own);
    takeRequests(own);
    takeLayers(own);
    frame_.index = own.index;
    frame_.time_s = own.time_s;
    frame_.camera = taken(own.camera);
    frame_.size_px = {own.width_px, own.height_px};
    frame_.lights = lights_;
    frame_.objects = own.objects != nullptr ? &own.objects->set : nullptr;
    frame_.layers = layers_;
    frame_.cut = own.cut != 0;
    frame_.draw_ms_per_texel = own.draw_ms_per_texel;
    frame_.rates = taken(own.rates);
    frame_.clamps_depth = own.clamps_depth != 0;
    frame_.requests = requests_;
    return frame_;
}

void FrameTaker::takeLights(const GnomonFrame& own)
{
    lights_.clear();
    readStructs<GnomonLight, Light>(own.lights, own.light_count, "the lights (GnomonLight)",
                                    [&](const GnomonLight& light) { lights_.push_back(taken(light)); });
}

void FrameTaker::takeRequests(const GnomonFrame& own)
{
    requests_.clear();
    readStructs<GnomonPageRequests, PageRequests>(
        own.requests, own.request_count, "the requests (GnomonPageRequests)", [&](const GnomonPageRequests& from) {
            if (cells_.size() == requests_.size()) {
                cells_.emplace_back();
            }
            std::vector<SeenCell>& cells = cells_[requests_.size()];
            cells.clear();
            for (std::uint64_t i = 0; i < from.cell_count; ++i) {
                const GnomonSeenCell& cell = (&required(from.cells, "GnomonPageRequests::cells"))[i];
                cells.push_back({{cell.place_px[0], cell.place_px[1]}, cell.depth, cell.edge});
            }
            PageRequests& out = requests_.emplace_back();
            out.light_key = from.light_key;
            get(from.clip_from_world, out.clip_from_world);
            out.size_px = {from.width_px, from.height_px};
        });
    for (std::size_t i = 0; i < requests_.size(); ++i) { // the cells' memory stays where it is from here on
        requests_[i].cells = cells_[i];
    }
}

void FrameTaker::takeLayers(const GnomonFrame& own)
{
    layers_.clear();
    for (std::uint32_t i = 0; i < own.layer_count; ++i) {
        const GnomonWorldLayer& layer = (&required(own.layers, "GnomonFrame::layers"))[i];
        layers_.push_back({layer.low_m, layer.high_m});
    }
}

} // namespace gnomon::c

extern "C" {

GnomonStatus gnomonInitObjectFlags(GnomonObjectFlags* flags, size_t size) noexcept
{
    return gnomon::c::initStruct<GnomonObjectFlags, gnomon::ObjectFlags>(flags, size, "GnomonObjectFlags");
}

GnomonStatus gnomonInitLight(GnomonLight* light, size_t size) noexcept
{
    return gnomon::c::initStruct<GnomonLight, gnomon::Light>(light, size, "GnomonLight");
}

GnomonStatus gnomonInitFrame(GnomonFrame* frame, size_t size) noexcept
{
    return gnomon::c::initStruct<GnomonFrame, gnomon::Frame>(frame, size, "GnomonFrame");
}

GnomonStatus gnomonInitPageRequests(GnomonPageRequests* requests, size_t size) noexcept
{
    return gnomon::c::initStruct<GnomonPageRequests, gnomon::PageRequests>(requests, size, "GnomonPageRequests");
}

GnomonStatus gnomonInitPrecision(GnomonPrecision* precision, size_t size) noexcept
{
    return gnomon::c::initStruct<GnomonPrecision, gnomon::pack::DrawPrecision>(precision, size, "GnomonPrecision");
}

} // extern "C"
