// SPDX-License-Identifier: Apache-2.0
#include "report_pictures.h"

#include "report_html.h"

#include "app/visual.h"
#include "image/image_io.h"
#include "lab/report.h"

#include <algorithm>
#include <cmath>

namespace gnomon::app {
namespace {

/// [0, 1] to 0 .. 255, to nearest; NaN becomes 0, so that it shows.
Image8 maskAs8Bit(const ImageF& mask)
{
    Image8 picture(mask.width, mask.height, 1);
    std::transform(mask.values.begin(), mask.values.end(), picture.values.begin(), [](float value) {
        const float kept = std::isnan(value) ? 0.0F : std::clamp(value, 0.0F, 1.0F);
        return static_cast<std::uint8_t>(std::lround(kept * 255.0F));
    });
    return picture;
}

/// The pictures of one frame in the page, all reduced alike.
class FrameOfPage {
public:
    explicit FrameOfPage(std::uint32_t reduction) : reduction_(reduction) { json_["reduction"] = reduction; }

    [[nodiscard]] std::string uri(const Image8& picture) const
    {
        return dataUri(encodePng(reduction_ == 1 ? picture : reduced(picture, reduction_)));
    }
    [[nodiscard]] Json& json() { return json_; }

    /// Its picture, or the place of the one that shows the same.
    std::size_t density(const ImageF& map)
    {
        std::string shown = uri(lab::densityPixels(map));
        Json& all = json_["densities"];
        const auto same = std::find(all.begin(), all.end(), shown);
        const auto place = static_cast<std::size_t>(same - all.begin());
        if (same == all.end()) {
            all.push_back(std::move(shown));
        }
        return place;
    }

private:
    std::uint32_t reduction_;
    Json json_;
};

Json techniquePictures(FrameOfPage& page, const lab::ShownFrame& shown, const ImageF& truth)
{
    return {{"mask", page.uri(maskAs8Bit(shown.mask))},
            {"error", page.uri(lab::errorPixels(shown.mask, truth, shown.counted))},
            {"classes", page.uri(lab::classPixels(shown.classes, shown.mask, truth))}};
}

Json framePictures(const CompareResult& result, std::size_t frame, std::uint32_t reduction)
{
    FrameOfPage page(reduction);
    const ImageF& truth = result.path ? result.path->truths[frame] : result.judged.truth.visibility.visibility;
    if (result.path) {
        page.json()["frame"] = result.path->shown[frame];
    }
    page.json()["truth"] = page.uri(maskAs8Bit(truth));
    page.json()["lit"] = page.uri(result.shades[frame].lit);
    page.json()["unlit"] = page.uri(result.shades[frame].unlit);
    page.json()["densities"] = Json::array();
    Json techniques = Json::array();
    for (const ComparedTechnique& technique : result.techniques) {
        techniques.push_back(techniquePictures(page, technique.shown[frame], truth));
        if (!result.path) {
            techniques.back()["density"] = page.density(technique.score.density.map);
        }
    }
    page.json()["techniques"] = std::move(techniques);
    return std::move(page.json());
}

} // namespace

Shades drawShades(const host::SceneOnGpu& scene, const lab::Subject& subject, const Settings& settings)
{
    host::RenderOptions options = lab::judgedOptions(renderOptions(settings), settings.size_px);
    options.shadows = false;
    options.ambient_occlusion.on = true;       // as pictures that are looked at
    options.shading = host::Shading::deferred; // masks of someone else's are shaded so
    host::FrameRenderer renderer(scene, options);
    const auto shaded = [&](float visibility) {
        const std::vector<ImageF> masks(subject.lights.size(), ImageF(options.width, options.height, 1, visibility));
        renderer.draw(*subject.state, subject.eye, subject.lights, &masks);
        return renderer.read({.colour = true}).colour;
    };
    return {shaded(1.0F), shaded(0.0F)};
}

std::uint32_t pageReduction(std::uint64_t pixels)
{
    std::uint32_t reduction = 1;
    while (pixels / (std::uint64_t{reduction} * reduction) > kMostPagePixels) {
        ++reduction;
    }
    return reduction;
}

Image8 reduced(const Image8& picture, std::uint32_t reduction)
{
    const auto part = [&](std::uint32_t side) {
        return (side + reduction - 1) / reduction;
    };
    Image8 small(part(picture.width), part(picture.height), picture.channels);
    for (std::uint32_t y = 0; y < small.height; ++y) {
        for (std::uint32_t x = 0; x < small.width; ++x) {
            const std::uint32_t right = std::min((x + 1) * reduction, picture.width);
            const std::uint32_t below = std::min((y + 1) * reduction, picture.height);
            for (std::uint32_t channel = 0; channel < picture.channels; ++channel) {
                std::uint32_t sum = 0;
                std::uint32_t count = 0;
                for (std::uint32_t from_y = y * reduction; from_y < below; ++from_y) {
                    for (std::uint32_t from_x = x * reduction; from_x < right; ++from_x, ++count) {
                        sum += picture.pixel(from_x, from_y)[channel];
                    }
                }
                small.pixel(x, y)[channel] = static_cast<std::uint8_t>((sum + count / 2) / count);
            }
        }
    }
    return small;
}

Json pagePictures(const CompareResult& result)
{
    const Image8& lit = result.shades.front().lit;
    const std::uint64_t shown = result.shades.size() * std::max<std::size_t>(result.techniques.size(), 1);
    const std::uint32_t reduction = pageReduction(std::uint64_t{lit.width} * lit.height * shown);
    Json frames = Json::array();
    for (std::size_t frame = 0; frame < result.shades.size(); ++frame) {
        frames.push_back(framePictures(result, frame, reduction));
    }
    return frames;
}

} // namespace gnomon::app
