// SPDX-License-Identifier: Apache-2.0
#include "loops.h"

#include "../rng.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace gnomon::worlds {

namespace {

glm::vec2 catmullRom(glm::vec2 a, glm::vec2 b, glm::vec2 c, glm::vec2 d, float t)
{
    return 0.5F * ((2.0F * b) + (c - a) * t + (2.0F * a - 5.0F * b + 4.0F * c - d) * (t * t) +
                   (3.0F * b - a - 3.0F * c + d) * (t * t * t));
}

std::vector<glm::vec2> ellipse(glm::vec2 centre, glm::vec2 radii, int corners, float wobble)
{
    std::vector<glm::vec2> points;
    for (int i = 0; i < corners; ++i) {
        const float turn = kTau * static_cast<float>(i) / static_cast<float>(corners);
        const float r = 1.0F + wobble * std::sin(3.0F * turn + 0.7F);
        points.push_back(centre + radii * r * glm::vec2(std::cos(turn), std::sin(turn)));
    }
    return points;
}

} // namespace

Loop::Loop(std::span<const glm::vec2> corners)
{
    const std::size_t n = corners.size();
    std::vector<glm::vec2> fine;
    constexpr int kPerCorner = 64;
    for (std::size_t i = 0; i < n; ++i) {
        for (int k = 0; k < kPerCorner; ++k) {
            fine.push_back(catmullRom(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n], corners[(i + 2) % n],
                                      static_cast<float>(k) / kPerCorner));
        }
    }
    fine.push_back(fine.front());
    for (std::size_t i = 1; i < fine.size(); ++i) {
        length_m_ += glm::distance(fine[i - 1], fine[i]);
    }
    const auto count = static_cast<std::size_t>(length_m_ / kStep_m);
    samples_per_m_ = static_cast<float>(count) / length_m_;
    std::size_t segment = 1;
    float before = 0.0F;
    for (std::size_t i = 0; i < count; ++i) {
        const float wanted = static_cast<float>(i) / samples_per_m_;
        while (segment + 1 < fine.size() && before + glm::distance(fine[segment - 1], fine[segment]) < wanted) {
            before += glm::distance(fine[segment - 1], fine[segment]);
            ++segment;
        }
        const float length = glm::distance(fine[segment - 1], fine[segment]);
        samples_.push_back({fine[segment - 1] + (fine[segment] - fine[segment - 1]) * ((wanted - before) / length)});
    }
    for (std::size_t i = 0; i < count; ++i) {
        samples_[i].direction =
            glm::normalize(samples_[(i + 1) % count].position - samples_[(i + count - 1) % count].position);
    }
    samples_.push_back(samples_.front());
}

Loop::Place Loop::at(float distance_m) const
{
    const float turns = distance_m / length_m_;
    const float at_sample = (turns - std::floor(turns)) * length_m_ * samples_per_m_;
    const std::size_t i = std::min(static_cast<std::size_t>(at_sample), samples_.size() - 2);
    const float t = at_sample - static_cast<float>(i);
    const Place& a = samples_[i];
    const Place& b = samples_[i + 1];
    const glm::vec2 d = a.direction + (b.direction - a.direction) * t;
    return {a.position + (b.position - a.position) * t, d * (1.0F / std::sqrt(glm::dot(d, d)))};
}

std::array<Loop, kLoopCount> makeLoops()
{
    const std::vector<glm::vec2> ring = ellipse({0, 0}, {28, 28}, 12, 0.0F);
    const std::vector<glm::vec2> west{{-10, 27},  {-1, 38},   {0, 56},  {-26, 86}, {-76, 98}, {-112, 92},
                                      {-128, 62}, {-104, 24}, {-56, 0}, {-38, 0},  {-27, 8},  {-21, 19}};
    const std::vector<glm::vec2> east{{27, -8},  {38, 0},  {56, 0},  {92, -10}, {124, -36}, {152, -52}, {170, -24},
                                      {140, 22}, {98, 46}, {48, 74}, {4, 62},   {2, 40},    {10, 26},   {24, 14}};
    const std::vector<glm::vec2> far = ellipse({0, 0}, {190, 176}, 24, 0.07F);
    const std::vector<glm::vec2> field = ellipse({-4, -84}, {38, 15}, 10, 0.0F);
    return {Loop(ring), Loop(west), Loop(east), Loop(far), Loop(field)};
}

} // namespace gnomon::worlds
