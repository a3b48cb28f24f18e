// SPDX-License-Identifier: Apache-2.0
// Random planes under random maps of every shape, in double precision.
#pragma once
#include "cpu_map.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::shared {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

struct PlaneUnderLight {
    MapRows map;
    BiasRule rule;
    dvec3 normal{0.0}; // of the receiver's plane
    dvec3 point{0.0};  // on it
    dvec3 to_light{0.0};
    double tangent = 0.0; // of the angle between normal and light
    dvec3 axis{0.0};      // of the map
};

enum class Shape { orthographic, perspective, warped };
inline constexpr Shape kShapes[] = {Shape::orthographic, Shape::perspective, Shape::warped};

/// Draws them.
class PlanesUnderLight {
public:
    double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(rng); }

    dvec3 direction()
    {
        std::normal_distribution<double> normal;
        dvec3 drawn; // one by one: the order of arguments is each compiler's own
        for (int axis = 2; axis >= 0; --axis) {
            drawn[axis] = normal(rng);
        }
        return glm::normalize(drawn);
    }

    // A map that looks along a random direction at a random plane through a random point.
    PlaneUnderLight make(Shape shape, double steepest)
    {
        const bool perspective =
            shape == Shape::perspective || (shape == Shape::warped && std::bernoulli_distribution()(rng));
        PlaneUnderLight s;
        const dvec3 axis = direction();
        const dvec3 right = glm::normalize(glm::cross(axis, direction()));
        const dvec3 up = glm::cross(right, axis);
        s.axis = axis;
        s.point = direction();
        s.point *= uniform(0.0, 20.0);
        const double texel_m = std::exp(uniform(std::log(0.002), std::log(0.5)));
        const double distance = uniform(5.0, 30.0);
        s.map.range_m = uniform(60.0, 300.0);
        if (perspective) {
            const double per_texel = std::min(texel_m / distance, 0.01); // at least 100 texels across 45 degrees
            const dvec2 aside{uniform(-0.4, 0.4), uniform(-0.4, 0.4)};
            const dvec3 origin = s.point - axis * distance + (right * aside.x + up * aside.y) * distance;
            s.map.w = dvec4(axis, -glm::dot(axis, origin));
            s.map.x = dvec4(right, -glm::dot(right, origin)) / per_texel + s.map.w * 1000.0;
            s.map.y = dvec4(-up, glm::dot(up, origin)) / per_texel + s.map.w * 700.0;
            s.map.metric = dvec4(axis, -glm::dot(axis, origin) - 0.1) / s.map.range_m;
            s.map.texel_m = per_texel;
            s.to_light = glm::normalize(origin - s.point);
        } else {
            s.map.w = {0.0, 0.0, 0.0, 1.0};
            s.map.x = dvec4(right / texel_m, 1000.0);
            s.map.y = dvec4(-up / texel_m, 700.0);
            s.map.metric = dvec4(axis, distance - glm::dot(axis, s.point)) / s.map.range_m;
            s.map.texel_m = texel_m;
            s.to_light = -axis;
        }
        if (shape == Shape::warped) {
            warp(s);
        }
        s.tangent = std::exp(uniform(std::log(1e-3), std::log(steepest)));
        const dvec3 side = glm::normalize(glm::cross(s.to_light, direction()));
        s.normal = glm::normalize(s.to_light + side * s.tangent);
        s.rule = {.automatic = 1.0, .quantum = 4e-6};
        return s;
    }

    // A homography of the map: w is from 1 to 2 at the point, and texels near it are up to four times as long.
    void warp(PlaneUnderLight& s)
    {
        const double n = uniform(200.0, 3000.0);
        const double upright = uniform(500.0, 1500.0);
        const double along = dotRow(s.map.y, s.point) / dotRow(s.map.w, s.point) - uniform(0.0, n);
        s.map.x -= s.map.w * upright;
        s.map.y -= s.map.w * along;
        s.map.w += s.map.y / n;
    }

    // The metric of the plane (moved by `offset_m` towards the light's side) at a texel's centre.
    static double planeDepth(const PlaneUnderLight& s, dvec2 texel, double offset_m)
    {
        const auto xyz = [](const dvec4& v) {
            return dvec3(v.x, v.y, v.z);
        };
        const dvec4 a = s.map.x - s.map.w * texel.x;
        const dvec4 b = s.map.y - s.map.w * texel.y;
        const dmat3 system = glm::transpose(dmat3(xyz(a), xyz(b), s.normal));
        const dvec3 p = glm::inverse(system) * dvec3(-a.w, -b.w, glm::dot(s.normal, s.point) + offset_m);
        // Beyond the plane's horizon there is nothing in the map.
        return dotRow(s.map.w, p) > 0.0 ? std::min(dotRow(s.map.metric, p), 1.0) : 1.0;
    }

protected:
    std::mt19937 rng{5};
};

} // namespace gnomon::shared
