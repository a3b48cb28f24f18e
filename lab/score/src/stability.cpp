// SPDX-License-Identifier: Apache-2.0
#include "lab/score/stability.h"

#include "lab/metrics/same_shape.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::lab {
namespace {

// A place so near to a pixel's centre is that centre. Points are single numbers relative to the eye, so that even at
// rest the place is off by about 2^-24 of the focal length in pixels; that of the largest picture is 2^14.
constexpr double kSamePlace_px = 1e-3;

glm::dvec3 vectorAt(const ImageF& image, std::size_t pixel)
{
    const float* v = image.values.data() + 3 * pixel;
    return {v[0], v[1], v[2]};
}

/// A row of a matrix that multiplies columns.
glm::dvec4 rowOf(const glm::dmat4& matrix, int row)
{
    return {matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]};
}

/// Finds pixels of one frame in the frame before.
class Matcher {
public:
    Matcher(const SeenFrame& now, const SeenFrame& before)
        : now_(now), before_(before), row_x_(rowOf(before.camera.clip_from_world, 0)),
          row_y_(rowOf(before.camera.clip_from_world, 1)), row_w_(rowOf(before.camera.clip_from_world, 3)),
          size_px_(before.counted.width, before.counted.height)
    {
    }

    /// `take` is called with each matching pixel and its bilinear weight, above 0.
    template <typename Take>
    void match(std::size_t pixel, const Take& take)
    {
        if (now_.counted.values[pixel] == 0 || !project(pixel)) {
            return;
        }
        const glm::dvec2 corner = glm::floor(place_px_);
        const glm::dvec2 share = place_px_ - corner;
        for (int i = 0; i < 4; ++i) {
            const double x = corner.x + (i & 1);
            const double y = corner.y + (i >> 1);
            const double weight = ((i & 1) != 0 ? share.x : 1.0 - share.x) * ((i >> 1) != 0 ? share.y : 1.0 - share.y);
            if (weight > 0.0 && x >= 0.0 && y >= 0.0 && x < size_px_.x && y < size_px_.y) {
                const auto other = static_cast<std::uint32_t>(y * size_px_.x + x);
                if (isSameSurface(pixel, other)) {
                    take(other, weight);
                }
            }
        }
    }

private:
    /// Sets place_px_, in pixels from the first one's centre, and pixel_m_.
    bool project(std::size_t pixel)
    {
        const glm::dvec4 point(now_.camera.eye_ws + vectorAt(now_.surfaces.points, pixel), 1.0);
        const double w = glm::dot(row_w_, point);
        if (!(w > 0.0)) {
            return false;
        }
        const glm::dvec2 ndc = glm::dvec2(glm::dot(row_x_, point), glm::dot(row_y_, point)) / w;
        place_px_ = (ndc * 0.5 + 0.5) * size_px_ - 0.5;
        if (!(place_px_.x > -1.0 && place_px_.y > -1.0 && place_px_.x < size_px_.x && place_px_.y < size_px_.y)) {
            return false;
        }
        for (int i = 0; i < 2; ++i) {
            const double nearest = std::round(place_px_[i]);
            place_px_[i] = std::abs(place_px_[i] - nearest) < kSamePlace_px ? nearest : place_px_[i];
        }
        // How far the place moves for a metre in the direction in which it moves most, d(place) / d(point).
        const double across = glm::length(glm::dvec3(row_x_) - ndc.x * glm::dvec3(row_w_)) * size_px_.x;
        const double down = glm::length(glm::dvec3(row_y_) - ndc.y * glm::dvec3(row_w_)) * size_px_.y;
        pixel_m_ = 2.0 * w / std::min(across, down);
        return true;
    }

    [[nodiscard]] bool isSameSurface(std::size_t pixel, std::size_t other) const
    {
        if (before_.counted.values[other] == 0 ||
            before_.surfaces.object_ids.values[other] != now_.surfaces.object_ids.values[pixel]) {
            return false;
        }
        constexpr double kRounding = 1.0 / (1U << 22U);
        const glm::dvec3 p = vectorAt(now_.surfaces.points, pixel);
        const glm::dvec3 q = vectorAt(before_.surfaces.points, other);
        const glm::dvec3 from_p_to_q = (before_.camera.eye_ws - now_.camera.eye_ws) + (q - p);
        const double off_plane_m = std::abs(glm::dot(vectorAt(now_.surfaces.normals, pixel), from_p_to_q));
        return off_plane_m <= pixel_m_ + kRounding * (glm::length(p) + glm::length(q));
    }

    const SeenFrame& now_;
    const SeenFrame& before_;
    glm::dvec4 row_x_;
    glm::dvec4 row_y_;
    glm::dvec4 row_w_;
    glm::dvec2 size_px_;
    glm::dvec2 place_px_{0.0};
    double pixel_m_ = 0.0;
};

} // namespace

Reprojection::Reprojection(const SeenFrame& now, const SeenFrame& before)
{
    assert(areMasksOfOneSize(now.counted, before.counted));
    assert(areMasksOfOneSize(now.counted, now.surfaces.object_ids));
    assert(areMasksOfOneSize(before.counted, before.surfaces.object_ids));
    fetches_.resize(now.counted.values.size());
    Matcher matcher(now, before);
    for (std::size_t pixel = 0; pixel < fetches_.size(); ++pixel) {
        Fetch& fetch = fetches_[pixel];
        std::size_t count = 0;
        double sum = 0.0;
        matcher.match(pixel, [&](std::uint32_t other, double weight) {
            fetch.pixels[count] = other;
            fetch.weights[count++] = static_cast<float>(weight);
            sum += weight;
        });
        for (float& weight : fetch.weights) {
            weight = sum > 0.0 ? static_cast<float>(weight / sum) : 0.0F;
        }
        matched_ += count != 0 ? 1 : 0;
    }
}

std::optional<double> Reprojection::fetch(const ImageF& before, std::size_t pixel) const
{
    const Fetch& fetch = fetches_[pixel];
    double value = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < fetch.weights.size(); ++i) {
        if (fetch.weights[i] != 0.0F) { // a value that does not match may be anything, NaN too
            value += static_cast<double>(fetch.weights[i]) * before.values[fetch.pixels[i]];
            sum += fetch.weights[i];
        }
    }
    return sum > 0.0 ? std::optional(value / sum) : std::nullopt;
}

ImageF errorOf(const ImageF& mask, const ImageF& truth)
{
    assert(areMasksOfOneSize(mask, truth));
    ImageF error(mask.width, mask.height, 1);
    for (std::size_t i = 0; i < error.values.size(); ++i) {
        error.values[i] = mask.values[i] - truth.values[i];
    }
    return error;
}

void StabilityMeter::add(const ImageF& mask, const ImageF& truth, const FrameBefore* before)
{
    assert((before == nullptr) == error_before_.values.empty());
    assert(before == nullptr || (before->here == nullptr) == (before->error_here == nullptr));
    ImageF error = errorOf(mask, truth);
    if (before != nullptr) {
        Step step;
        for (std::size_t i = 0; i < error.values.size(); ++i) {
            std::optional<double> error_then = before->match.fetch(error_before_, i);
            if (error_then && before->here != nullptr) {
                error_then = before->here->fetch(*before->error_here, i);
            }
            if (error_then) {
                const double change = error.values[i] - *error_then;
                step.mean_abs += std::abs(change);
                step.mean_squared += change * change;
                ++step.matched;
            }
        }
        if (step.matched != 0) {
            step.mean_abs /= static_cast<double>(step.matched);
            step.mean_squared /= static_cast<double>(step.matched);
        }
        steps_.push_back(step);
    }
    error_before_ = std::move(error);
}

std::optional<Stability> StabilityMeter::stability() const
{
    Stability result;
    double squares = 0.0;
    std::uint64_t matched = 0;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        const Step& step = steps_[i];
        squares += step.mean_squared * static_cast<double>(step.matched);
        matched += step.matched;
        if (!(step.mean_abs <= result.pop) && !std::isnan(result.pop)) { // also when it is not a number
            result.pop = step.mean_abs;
            result.pop_frame = i + 1;
        }
    }
    if (matched == 0) {
        return std::nullopt;
    }
    result.shimmer = std::sqrt(squares / static_cast<double>(matched));
    return result;
}

} // namespace gnomon::lab
