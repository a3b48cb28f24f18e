// SPDX-License-Identifier: Apache-2.0
// Meshes from simple solids, for the built-in worlds.
#pragma once

#include "scene_names.h"

#include <deque>
#include <span>
#include <string>

namespace gnomon::worlds {

/// Linear colour from sRGB 0xRRGGBB.
[[nodiscard]] glm::vec4 rgb(std::uint32_t srgb);
/// The colour of a pane that is lit by night, in a material with Material::lit_by_night.
[[nodiscard]] inline glm::vec4 litByNight(const glm::vec4& colour)
{
    return {colour.r, colour.g, colour.b, 0.0F};
}

/// Matrices in the order they read: move, turn, then scale.
[[nodiscard]] glm::mat4 at(const glm::vec3& position);
[[nodiscard]] glm::mat4 turnedX(float radians);
[[nodiscard]] glm::mat4 turnedY(float radians);
[[nodiscard]] glm::mat4 turnedZ(float radians);
[[nodiscard]] glm::mat4 scaled(const glm::vec3& factors);

/// Triangles of one material in the making. Shapes go through `frame` and take `colour`; texture coordinates are
/// metres times `uv_per_metre` on the plane a face is nearest to. Faces are counter-clockwise from outside.
class Part {
public:
    glm::mat4 frame{1.0F};
    glm::vec4 colour{1.0F};
    float uv_per_metre = 1.0F;

    void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
    void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);
    /// A quad with given corners of the texture, (0,0) at a and (1,1) at c, and one normal (frame space).
    void card(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, const glm::vec3& normal);
    /// A box whose top is `taper` times as wide and deep as its bottom.
    void box(const glm::vec3& min, const glm::vec3& max, float taper = 1.0F, bool bottom = false);
    /// A roof: triangle of the given width (x) and height over the length in z, eaves at y = 0.
    void gable(float width, float height, float length);
    /// Turns `profile` (radius, height; bottom to top) about the y axis. Smooth along the profile or flat; always
    /// smooth around unless `faceted`.
    void lathe(std::span<const glm::vec2> profile, int sides, bool smooth_profile = false, bool faceted = false);
    void lathe(std::initializer_list<glm::vec2> profile, int sides, bool smooth_profile = false, bool faceted = false);
    /// A beam of square section from a to b; without its ends where they are hidden.
    void beam(const glm::vec3& a, const glm::vec3& b, float thickness, bool ends = true);
    /// A smooth pipe along `path`, with one of `radii` for each point; closed when `ring`.
    void tube(std::span<const glm::vec3> path, std::span<const float> radii, int sides, bool ring = false);
    /// A subdivided icosahedron, smooth, or faceted with corners pushed in and out by up to `roughness` of the radius.
    void ball(float radius, int subdivisions, float roughness = 0.0F, std::uint32_t seed = 0);

    [[nodiscard]] std::size_t triangles() const { return primitive_.indices.size() / 3; }
    [[nodiscard]] Primitive take(std::uint32_t material);

private:
    std::uint32_t vertex(const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv);
    void latheSegment(std::span<const glm::vec2> profile, std::size_t row, int sides, bool smooth_profile,
                      bool faceted);

    Primitive primitive_;
};

/// A mesh in the making: one Part per material, in the order of first use.
class MeshMaker {
public:
    [[nodiscard]] Part& with(std::uint32_t material);
    /// Sets the frame of all parts there are and will be.
    void setFrame(const glm::mat4& frame);
    [[nodiscard]] Mesh take(const std::string& name);

private:
    std::deque<Part> parts_; // references stay good
    std::deque<std::uint32_t> materials_;
    glm::mat4 frame_{1.0F};
};

/// A square card around `centre` that faces `facing`, turned in its plane by `roll`.
void leafCard(Part& part, const glm::vec3& centre, const glm::vec3& facing, float half, float roll,
              const glm::vec3& normal);

} // namespace gnomon::worlds
