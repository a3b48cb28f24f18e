// SPDX-License-Identifier: Apache-2.0
// Writes what the playground page reads of the library: a built-in world as one file, and all choices as JSON.
//
// usage: write_world WORLD TIME_S FILE | write_world --choices FILE
//
// A world's file is little-endian: the bytes "GNW1", the length of a JSON text, the text padded with spaces to a multiple
// of four, then four arrays whose lengths the text has: vertices (24 bytes: position 3 x float, normal 4 x snorm8, colour 4 x
// unorm8 whose squares are linear, uv 2 x half), indices (uint32), places (12 floats each, world_from_object by rows), and
// images (RGBA8, all kSide texels wide and high).
#include "scene/state.h"
#include "worlds/worlds.h"

#include <gnomon/choices.h>
#include <gnomon/error.h>

#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace gnomon;
static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t kSide = 256; // texels of an image's side

std::string quoted(std::string_view text)
{
    std::string out = "\"";
    for (const char c : text) {
        out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return out + '"';
}

template <typename Vector>
std::string listOf(const Vector& values, int count)
{
    std::ostringstream out;
    out.precision(6);
    for (int i = 0; i < count; ++i) {
        out << (i == 0 ? "[" : ",") << values[i];
    }
    return out.str() + "]";
}

struct Vertex {
    glm::vec3 position{0.0F};
    std::uint32_t normal = 0;
    std::uint32_t colour = 0;
    std::uint32_t uv = 0;
};
static_assert(sizeof(Vertex) == 24);

struct Writer {
    const scene::Scene& scene;
    const scene::State state;
    std::vector<Vertex> vertices{};
    std::vector<std::uint32_t> indices{};
    std::vector<glm::vec4> places{};
    std::vector<std::uint8_t> images{};
    std::map<std::uint32_t, int> layer_of{}; // by the image's index

    int layerOf(const scene::TextureUse& use);
    std::string material(const scene::Material& material);
    void addVertices(const scene::Primitive& primitive, const scene::DeformedPrimitive* deformed, const scene::Material& material);
    std::string meshes();
    std::string header();
};

/// The layer of a texture's image, which is made as large as all are; -1: there is none.
int Writer::layerOf(const scene::TextureUse& use)
{
    if (use.texture == scene::kNone || scene.textures[use.texture].image == scene::kNone) {
        return -1;
    }
    const auto [place, is_new] = layer_of.emplace(scene.textures[use.texture].image, static_cast<int>(layer_of.size()));
    if (is_new) {
        const scene::Image& image = scene.images[place->first];
        for (std::uint32_t y = 0; y < kSide; ++y) {
            for (std::uint32_t x = 0; x < kSide; ++x) {
                // The mean of what a texel covers, or the nearest texel of a smaller image.
                const std::uint32_t x0 = x * image.width / kSide;
                const std::uint32_t y0 = y * image.height / kSide;
                const std::uint32_t x1 = std::max(x0 + 1, (x + 1) * image.width / kSide);
                const std::uint32_t y1 = std::max(y0 + 1, (y + 1) * image.height / kSide);
                for (std::uint32_t k = 0; k < 4; ++k) {
                    std::uint32_t sum = 0;
                    for (std::uint32_t v = y0; v < y1; ++v) {
                        for (std::uint32_t u = x0; u < x1; ++u) {
                            sum += image.rgba[(static_cast<std::size_t>(v) * image.width + u) * 4 + k];
                        }
                    }
                    const std::uint32_t count = std::max((x1 - x0) * (y1 - y0), 1U);
                    images.push_back(static_cast<std::uint8_t>((sum + count / 2) / count));
                }
            }
        }
    }
    return place->second;
}

std::string Writer::material(const scene::Material& material)
{
    std::ostringstream out;
    out << "{\"name\":" << quoted(material.name) << ",\"colour\":" << listOf(material.base_colour, 4)
        << ",\"image\":" << layerOf(material.base_colour_texture)
        << ",\"cutoff\":" << (material.alpha_mode == scene::AlphaMode::mask ? material.alpha_cutoff : 0.0F)
        << ",\"double_sided\":" << (material.double_sided ? "true" : "false") << '}';
    return out.str();
}

void Writer::addVertices(const scene::Primitive& primitive, const scene::DeformedPrimitive* deformed, const scene::Material& material)
{
    const auto& positions = deformed != nullptr ? deformed->positions : primitive.positions;
    const auto& normals = deformed != nullptr ? deformed->normals : primitive.normals;
    const bool masked = material.alpha_mode == scene::AlphaMode::mask;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const glm::vec2 uv = i < primitive.uv0.size() ? primitive.uv0[i] : glm::vec2(0.0F);
        glm::vec4 colour = i < primitive.colours.size() ? primitive.colours[i] : glm::vec4(1.0F);
        colour = glm::sqrt(glm::clamp(colour, 0.0F, 1.0F));
        colour.a = masked ? colour.a : 1.0F;
        vertices.push_back({positions[i] + (deformed != nullptr ? glm::vec3(0.0F) : primitive.origin),
                            glm::packSnorm4x8(glm::vec4(normals[i], 0.0F)), glm::packUnorm4x8(colour),
                            glm::packHalf2x16(material.base_colour_texture.offset + material.base_colour_texture.scale * uv)});
    }
}

/// Objects with the same vertices, casting and receiving alike, are one mesh with several places.
std::string Writer::meshes()
{
    using Key = std::array<std::uint32_t, 6>;
    std::map<Key, std::vector<const scene::Object*>> objects;
    for (const scene::Object& object : state.objects) {
        const bool blended = object.material != scene::kNone && scene.materials[object.material].alpha_mode == scene::AlphaMode::blend;
        if (!blended) {
            objects[{object.mesh, object.primitive, object.deformed, object.material, object.casts, object.receives}].push_back(&object);
        }
    }
    std::ostringstream out;
    for (const auto& [key, all] : objects) {
        const scene::Primitive& primitive = scene.meshes[key[0]].primitives[key[1]];
        const scene::DeformedPrimitive* deformed = key[2] == scene::kNone ? nullptr : &state.deformed[key[2]];
        out << (vertices.empty() ? "" : ",") << "{\"first_vertex\":" << vertices.size() << ",\"first_index\":" << indices.size()
            << ",\"indices\":" << primitive.indices.size() << ",\"first_place\":" << places.size() / 3 << ",\"places\":" << all.size()
            << ",\"material\":" << static_cast<int>(key[3]) << ",\"casts\":" << (key[4] != 0 ? "true" : "false") << '}';
        static const scene::Material kPlain;
        addVertices(primitive, deformed, key[3] == scene::kNone ? kPlain : scene.materials[key[3]]);
        indices.insert(indices.end(), primitive.indices.begin(), primitive.indices.end());
        for (const scene::Object* object : all) {
            const glm::mat4 rows = glm::transpose(object->world_from_object);
            places.insert(places.end(), {rows[0], rows[1], rows[2]});
        }
    }
    return out.str();
}

std::string Writer::header()
{
    std::ostringstream out;
    out << "{\"name\":" << quoted(scene.name) << ",\"summary\":" << quoted(worlds::find(scene.name)->summary) << ",\"meshes\":[" << meshes()
        << "],\"materials\":[";
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        out << (i == 0 ? "" : ",") << material(scene.materials[i]);
    }
    out << "],\"views\":[";
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        const scene::NamedView& view = scene.views[i];
        out << (i == 0 ? "" : ",") << "{\"name\":" << quoted(view.name) << ",\"eye\":" << listOf(view.eye, 3)
            << ",\"target\":" << listOf(view.target, 3) << ",\"fov_y_rad\":" << view.fov_y_rad << '}';
    }
    const auto sun = std::ranges::find(scene.lights, scene::LightType::directional, &scene::Light::type);
    if (sun == scene.lights.end()) {
        throw Error("writing " + scene.name, "it has no sun", "take a world that has one");
    }
    const scene::PlacedLight& placed = state.lights[static_cast<std::size_t>(sun - scene.lights.begin())];
    const scene::Environment& around = state.environment;
    out << "],\"sun\":{\"direction\":" << listOf(placed.direction_ws, 3) << ",\"colour\":" << listOf(sun->colour * sun->intensity, 3)
        << "},\"sky\":{\"zenith\":" << listOf(around.sky_zenith, 3) << ",\"horizon\":" << listOf(around.sky_horizon, 3)
        << ",\"ground\":" << listOf(around.ground, 3) << ",\"ambient\":" << around.ambient << ",\"exposure\":" << around.exposure
        << "},\"vertices\":" << vertices.size() << ",\"indices\":" << indices.size() << ",\"places\":" << places.size() / 3
        << ",\"images\":" << layer_of.size() << ",\"image_side\":" << kSide << '}';
    std::string text = out.str();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return text;
}

template <typename T>
void put(std::ostream& out, const std::vector<T>& values)
{
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void writeWorld(const char* name, double time_s, const char* file)
{
    const worlds::World* world = worlds::find(name);
    if (world == nullptr) {
        throw Error(std::string("making the world ") + name, "there is none of this name", "take one of worlds/src/list.cpp");
    }
    const scene::Scene scene = world->make(1);
    Writer writer{.scene = scene, .state = scene::evaluate(scene, time_s)};
    const std::string text = writer.header();
    const auto length = static_cast<std::uint32_t>(text.size());
    std::ofstream out(file, std::ios::binary);
    out.write("GNW1", 4);
    out.write(reinterpret_cast<const char*>(&length), sizeof length);
    out << text;
    put(out, writer.vertices);
    put(out, writer.indices);
    put(out, writer.places);
    put(out, writer.images);
    if (!out.flush()) {
        throw Error(std::string("writing ") + file, "it could not be written", "look at its folder");
    }
    std::cout << name << ": " << writer.vertices.size() << " vertices, " << writer.indices.size() / 3 << " triangles, " << writer.places.size() / 3
              << " objects, " << writer.layer_of.size() << " images\n";
}

void writeChoices(const char* file)
{
    std::ofstream out(file);
    const char* before = "[";
    for (const ChoiceValue& value : choiceValues()) {
        out << before << "{\"choice\":" << quoted(value.choice) << ",\"name\":" << quoted(value.name) << ",\"summary\":" << quoted(value.summary) << '}';
        before = ",\n";
    }
    out << "]\n";
    if (!out.flush()) {
        throw Error(std::string("writing ") + file, "it could not be written", "look at its folder");
    }
}

} // namespace

int main(int count, char** arguments)
{
    try {
        if (count == 3 && std::string_view(arguments[1]) == "--choices") {
            writeChoices(arguments[2]);
            return EXIT_SUCCESS;
        }
        if (count == 4) {
            writeWorld(arguments[1], std::strtod(arguments[2], nullptr), arguments[3]);
            return EXIT_SUCCESS;
        }
        std::cerr << "usage: write_world WORLD TIME_S FILE | write_world --choices FILE\n";
        return 2;
    } catch (const std::exception& failure) {
        std::cerr << failure.what() << '\n';
        return EXIT_FAILURE;
    }
}
