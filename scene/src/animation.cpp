// SPDX-License-Identifier: Apache-2.0
// Based on: Khronos Group, "glTF 2.0 Specification", appendix C (Animation Sampler Interpolation Modes).
#include "animation.h"

#include <gnomon/error.h>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {

namespace {

struct Segment {
    std::size_t first = 0;  // key at or before the time
    std::size_t second = 0; // the next key; equal to `first` outside the range
    float t = 0.0F;         // 0 at first, 1 at second
    float length_s = 0.0F;
};

Segment findSegment(const std::vector<float>& times_s, float time_s)
{
    const std::size_t last = times_s.size() - 1;
    if (!(time_s > times_s.front())) {
        return {};
    }
    if (time_s >= times_s.back()) {
        return {.first = last, .second = last};
    }
    const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s);
    const auto second = static_cast<std::size_t>(after - times_s.begin());
    const float length_s = times_s[second] - times_s[second - 1];
    return {
        .first = second - 1, .second = second, .t = (time_s - times_s[second - 1]) / length_s, .length_s = length_s};
}

void normalise4(std::span<float> q)
{
    const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (length > 0.0F) {
        for (float& v : q) {
            v /= length;
        }
    }
}

/// Shortest-arc spherical interpolation of x y z w quaternions.
void slerp(std::span<const float> a, std::span<const float> b, float t, std::span<float> out)
{
    float cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    const float sign = cosine < 0.0F ? -1.0F : 1.0F; // q and -q are the same rotation
    cosine = std::min(cosine * sign, 1.0F);
    float weight_a = 1.0F - t;
    float weight_b = t;
    constexpr float kNearlyEqual = 0.9999F; // below one part in 10^4 of an arc the straight line is as good
    if (cosine < kNearlyEqual) {
        const float angle = std::acos(cosine);
        const float sine = std::sin(angle);
        weight_a = std::sin((1.0F - t) * angle) / sine;
        weight_b = std::sin(t * angle) / sine;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        out[i] = weight_a * a[i] + sign * weight_b * b[i];
    }
}

/// One component of the Hermite spline; each key holds in-tangent, value, out-tangent.
float cubic(float value0, float out_tangent0, float value1, float in_tangent1, float t, float length_s)
{
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2.0F * t3 - 3.0F * t2 + 1.0F) * value0 + length_s * (t3 - 2.0F * t2 + t) * out_tangent0 +
           (-2.0F * t3 + 3.0F * t2) * value1 + length_s * (t3 - t2) * in_tangent1;
}

void sampleCubic(const AnimationChannel& channel, const Segment& segment, std::span<float> out)
{
    const std::size_t n = out.size();
    const float* key0 = channel.values.data() + segment.first * 3 * n;
    const float* key1 = channel.values.data() + segment.second * 3 * n;
    for (std::size_t i = 0; i < n; ++i) {
        out[i] = segment.first == segment.second
                     ? key0[n + i]
                     : cubic(key0[n + i], key0[2 * n + i], key1[n + i], key1[i], segment.t, segment.length_s);
    }
}

double wrapTime(double time_s, double duration_s)
{
    if (duration_s > 0.0 && (time_s > duration_s || time_s < 0.0)) {
        return time_s - std::floor(time_s / duration_s) * duration_s;
    }
    return time_s;
}

void applyChannel(const AnimationChannel& channel, float time_s, Node& node)
{
    Transform& transform = node.transform;
    switch (channel.path) {
    case AnimationPath::translation:
        sampleChannel(channel, time_s, std::span<float>(&transform.translation.x, 3));
        break;
    case AnimationPath::scale:
        sampleChannel(channel, time_s, std::span<float>(&transform.scale.x, 3));
        break;
    case AnimationPath::rotation: {
        const glm::quat& q = transform.rotation;
        float xyzw[4] = {q.x, q.y, q.z, q.w};
        sampleChannel(channel, time_s, xyzw);
        transform.rotation = glm::quat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
        break;
    }
    case AnimationPath::weights:
        sampleChannel(channel, time_s, node.morph_weights);
        break;
    }
}

} // namespace

const Animation* findAnimation(const Scene& scene, const std::string& name)
{
    if (name.empty()) {
        return scene.animations.empty() ? nullptr : &scene.animations.front();
    }
    std::string names;
    for (const Animation& animation : scene.animations) {
        if (animation.name == name) {
            return &animation;
        }
        names += (names.empty() ? "" : ", ") + animation.name;
    }
    throw Error("playing animation '" + name + "'", "the scene has no animation of that name",
                names.empty() ? "it has none at all" : "it has: " + names);
}

void sampleChannel(const AnimationChannel& channel, float time_s, std::span<float> out)
{
    const std::size_t n = out.size();
    const std::size_t floats_per_key = channel.interpolation == Interpolation::cubic_spline ? 3 * n : n;
    if (channel.times_s.empty() || n == 0 || channel.values.size() < channel.times_s.size() * floats_per_key) {
        return;
    }
    const Segment segment = findSegment(channel.times_s, time_s);
    const bool rotation = channel.path == AnimationPath::rotation;
    const std::span<const float> values(channel.values);
    if (channel.interpolation == Interpolation::cubic_spline) {
        sampleCubic(channel, segment, out);
    } else if (channel.interpolation == Interpolation::step || segment.first == segment.second) {
        std::copy_n(values.data() + segment.first * n, n, out.begin());
    } else if (rotation) {
        slerp(values.subspan(segment.first * n, n), values.subspan(segment.second * n, n), segment.t, out);
    } else {
        for (std::size_t i = 0; i < n; ++i) {
            const float a = values[segment.first * n + i];
            out[i] = a + (values[segment.second * n + i] - a) * segment.t;
        }
    }
    if (rotation) {
        normalise4(out);
    }
}

void applyAnimation(const Animation& animation, double time_s, std::vector<Node>& nodes)
{
    const auto at_s = static_cast<float>(wrapTime(time_s, static_cast<double>(animation.duration_s)));
    for (const AnimationChannel& channel : animation.channels) {
        if (channel.node < nodes.size() && !nodes[channel.node].use_matrix) {
            applyChannel(channel, at_s, nodes[channel.node]);
        }
    }
}

} // namespace gnomon::scene
