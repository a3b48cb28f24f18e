// SPDX-License-Identifier: Apache-2.0
#include "gltf/document.h"

#include <algorithm>
#include <cmath>

namespace gnomon::scene::gltf {

namespace {

constexpr Format kTimes[] = {{"SCALAR", Component::f32, false}};
constexpr Format kVectors[] = {{"VEC3", Component::f32, false}};
constexpr Format kRotations[] = {{"VEC4", Component::f32, false},
                                 {"VEC4", Component::i8, true},
                                 {"VEC4", Component::u8, true},
                                 {"VEC4", Component::i16, true},
                                 {"VEC4", Component::u16, true}};
constexpr Format kWeights[] = {{"SCALAR", Component::f32, false},
                               {"SCALAR", Component::i8, true},
                               {"SCALAR", Component::u8, true},
                               {"SCALAR", Component::i16, true},
                               {"SCALAR", Component::u16, true}};

struct Sampler {
    const Accessor* input = nullptr;
    const Accessor* output = nullptr;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times_s; // empty without content
    JsonView view;
};

const Accessor& samplerAccessor(const Document& document, const JsonView& where)
{
    const Accessor& accessor = document.accessor(where);
    noticeStride(document, accessor, "keys of animations");
    return accessor;
}

void checkTimes(const JsonView& where, const std::vector<float>& times)
{
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] < 0.0F) {
            where.failFound("key times must not be negative",
                            std::to_string(times[i]) + " as key " + std::to_string(i));
        }
        if (i > 0 && !(times[i] > times[i - 1])) {
            where.failFound("key times must increase", std::to_string(times[i - 1]) + ", then " +
                                                           std::to_string(times[i]) + " as key " + std::to_string(i));
        }
    }
}

Sampler readSampler(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::other);
    Sampler sampler{nullptr, nullptr, Interpolation::linear, {}, view};
    const JsonView input = view.at("input");
    sampler.input = &samplerAccessor(document, input);
    sampler.output = &samplerAccessor(document, view.at("output"));
    expectFormat(input, *sampler.input, kTimes);
    const std::string interpolation = view.string("interpolation", "LINEAR");
    if (interpolation == "STEP") {
        sampler.interpolation = Interpolation::step;
    } else if (interpolation == "CUBICSPLINE") {
        sampler.interpolation = Interpolation::cubic_spline;
    } else if (interpolation != "LINEAR") {
        document.context().notice("unknown interpolation in " + view.pointer() + " was taken as LINEAR");
    }
    if (sampler.interpolation == Interpolation::cubic_spline && sampler.input->count < 2) {
        input.failFound("CUBICSPLINE needs at least two keys", std::to_string(sampler.input->count));
    }
    if (sampler.input->hasContent()) {
        sampler.times_s = readFloats(document.context(), *sampler.input);
        checkTimes(input, sampler.times_s);
    }
    return sampler;
}

/// False when the path is none of glTF's four.
bool readPath(const JsonView& target, AnimationPath& path)
{
    const std::string name = target.at("path").string();
    if (name == "translation") {
        path = AnimationPath::translation;
    } else if (name == "rotation") {
        path = AnimationPath::rotation;
    } else if (name == "scale") {
        path = AnimationPath::scale;
    } else if (name == "weights") {
        path = AnimationPath::weights;
    } else {
        target.context().notice("animation of '" + escapeKey(name) + "' in " + target.pointer() + " has no effect");
        return false;
    }
    return true;
}

/// Normalises the quaternions of a rotation channel; tangents of a spline are left as they are.
void normaliseRotations(const JsonView& where, AnimationChannel& channel)
{
    const bool spline = channel.interpolation == Interpolation::cubic_spline;
    for (std::size_t key = spline ? 1 : 0; key * 4 < channel.values.size(); key += spline ? 3 : 1) {
        float* q = &channel.values[key * 4];
        const float length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        constexpr float kTolerance = 0.02F; // that of a quaternion rounded to 8 bits
        if (!(std::abs(length - 1.0F) <= kTolerance)) {
            where.failFound("rotations must be unit quaternions", std::to_string(length) + " as a length");
        }
        for (int c = 0; c < 4; ++c) {
            q[c] /= length;
        }
    }
}

std::size_t morphTargetCount(const Document& document, const JsonView& node)
{
    const std::uint32_t mesh = node.index("mesh", document.scene.meshes.size());
    return mesh == kNone ? 0 : document.scene.meshes[mesh].morph_weights.size();
}

/// Fails unless the output has the format and the number of elements that its path asks for.
void checkOutput(const Document& document, const JsonView& channel, const JsonView& node, const Sampler& sampler,
                 AnimationPath path)
{
    const JsonView where = sampler.view.at("output");
    std::size_t elements_per_key = sampler.interpolation == Interpolation::cubic_spline ? 3 : 1;
    switch (path) {
    case AnimationPath::translation:
    case AnimationPath::scale:
        expectFormat(where, *sampler.output, kVectors);
        break;
    case AnimationPath::rotation:
        expectFormat(where, *sampler.output, kRotations);
        break;
    case AnimationPath::weights: {
        const std::size_t targets = morphTargetCount(document, node);
        if (targets == 0) {
            channel.at("target").failFound("the node has no morph targets to weigh", "none");
        }
        expectFormat(where, *sampler.output, kWeights);
        elements_per_key *= targets;
        break;
    }
    }
    const std::uint64_t expected = std::uint64_t{sampler.input->count} * elements_per_key;
    if (sampler.output->count != expected) {
        where.failFound("the output must have " + std::to_string(expected) + " elements for " +
                            std::to_string(sampler.input->count) + " keys",
                        std::to_string(sampler.output->count));
    }
}

void checkPointerExtension(const JsonView& target)
{
    const std::optional<JsonView> pointer = extension(target, "KHR_animation_pointer");
    if (pointer && target.has("node")) {
        pointer->failFound("an animation pointer's target must have no node", "one");
    }
}

/// False when the channel has no effect here.
bool readChannel(Document& document, const JsonView& view, const std::vector<Sampler>& samplers,
                 AnimationChannel& channel)
{
    checkExtensions(view, Place::channel);
    const Sampler& sampler = samplers[view.at("sampler").index(samplers.size())];
    const JsonView target = view.at("target");
    checkExtensions(target, Place::channel_target);
    checkPointerExtension(target);
    const std::uint32_t node = target.index("node", document.nodes.size());
    if (!readPath(target, channel.path) || node == kNone) {
        return false;
    }
    const JsonView node_view = document.root.at("nodes").element(node);
    if (node_view.has("matrix") && channel.path != AnimationPath::weights) {
        target.failFound("a node with a matrix cannot be animated", "node " + std::to_string(node));
    }
    checkOutput(document, view, node_view, sampler, channel.path);
    channel.interpolation = sampler.interpolation;
    if (sampler.output->hasContent()) {
        channel.values = readFloats(document.context(), *sampler.output);
    }
    if (channel.path == AnimationPath::rotation) {
        normaliseRotations(view.at("sampler"), channel);
    }
    if (sampler.times_s.empty() || channel.values.empty()) {
        document.context().notice("animation channel " + view.pointer() + " has no data and was left out");
        return false;
    }
    document.context().chargeBytes(sampler.times_s.size() * sizeof(float), view.pointer());
    channel.times_s = sampler.times_s;
    channel.node = document.nodes[node];
    return channel.node != kNone; // a node outside the scene needs no animation
}

Animation readAnimation(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::other);
    Animation animation;
    animation.name = view.string("name", "");
    const JsonView channels = view.at("channels");
    const std::size_t channel_count = channels.size();
    const JsonView sampler_views = view.at("samplers");
    const std::size_t sampler_count = sampler_views.size();
    std::vector<Sampler> samplers;
    for (std::size_t i = 0; i < sampler_count; ++i) {
        samplers.push_back(readSampler(document, sampler_views.element(i)));
    }
    std::set<std::pair<std::uint32_t, std::string>> targets;
    for (std::size_t i = 0; i < channel_count; ++i) {
        AnimationChannel channel;
        const bool acts = readChannel(document, channels.element(i), samplers, channel);
        // By the file's own numbers, so that it does not depend on the scene shown or on missing data.
        const JsonView target = channels.element(i).at("target");
        const std::uint32_t node = target.index("node", document.nodes.size());
        if (node != kNone && !targets.insert({node, target.at("path").string()}).second) {
            target.failFound("two channels animate the same property", "the second");
        }
        if (!acts) {
            continue;
        }
        animation.duration_s = std::max(animation.duration_s, channel.times_s.back());
        animation.channels.push_back(std::move(channel));
    }
    return animation;
}

} // namespace

void readAnimations(Document& document)
{
    const std::size_t count = topLevelCount(document, "animations");
    for (std::size_t i = 0; i < count; ++i) {
        document.scene.animations.push_back(readAnimation(document, document.root.at("animations").element(i)));
    }
}

} // namespace gnomon::scene::gltf
