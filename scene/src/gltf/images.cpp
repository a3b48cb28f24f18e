// SPDX-License-Identifier: Apache-2.0
// Images, samplers and textures.
#include "gltf/decode.h"
#include "gltf/document.h"
#include "gltf/uri.h"

#include <cstring>

namespace gnomon::scene::gltf {

namespace {

/// Encoded data of an image, wherever they are.
struct Encoded {
    Resource resource; // owns the bytes when they come from a URI
    std::span<const std::byte> bytes;
    bool has_content = true;
    JsonView where; // whom to blame for a wrong media type
};

Encoded findEncoded(const Document& document, const JsonView& view)
{
    const std::optional<JsonView> uri = view.find("uri");
    const std::optional<JsonView> buffer_view = view.find("bufferView");
    if (uri.has_value() == buffer_view.has_value()) {
        view.failFound("an image needs either a uri or a bufferView", uri ? "both" : "neither");
    }
    if (uri) {
        Encoded out{fetch(*uri), {}, true, *uri};
        out.bytes = out.resource.bytes;
        return out;
    }
    const BufferView& data = document.views[buffer_view->index(document.views.size())];
    if (data.stride != 0) {
        view.context().notice("the buffer view of image " + view.pointer() + " has a byteStride, which has no effect");
    }
    return {{}, data.bytes, data.has_content, *buffer_view};
}

/// One white texel, for what cannot be decoded or has no data.
void makeWhite(Image& image)
{
    image.width = 1;
    image.height = 1;
    image.rgba.assign(4, 0xFF);
}

void checkMediaType(const Encoded& encoded, const std::string& declared, ImageFormat format)
{
    if (!declared.empty() && declared != mediaType(format)) {
        encoded.where.failFound(
            "the image's data are " + std::string(mediaType(format)) + ", not what its media type says", declared);
    }
}

void decode(const JsonView& view, std::span<const std::byte> bytes, ImageFormat format, Image& image)
{
    Context& context = view.context();
    const SizeCheck check = [&](std::uint32_t width, std::uint32_t height) {
        const std::uint32_t side = std::max(width, height);
        if (side > context.limits().max_image_side) {
            context.failLimit(view.pointer(), "the image's larger side in texels", "image-side",
                              context.limits().max_image_side, side);
        }
        context.chargeBytes(std::uint64_t{width} * height * 4, view.pointer());
    };
    const std::string wrong =
        format == ImageFormat::png ? decodePng(bytes, check, image) : decodeJpeg(bytes, check, image);
    if (!wrong.empty()) {
        view.failFound("the image's data are invalid", wrong);
    }
}

/// Returns the format, so that textures can refuse what core glTF has no decoder for.
ImageFormat readImage(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::other);
    Image image;
    image.name = view.string("name", "");
    const Encoded encoded = findEncoded(document, view);
    const std::string declared = view.string("mimeType", encoded.resource.media_type);
    ImageFormat format = ImageFormat::png;
    if (!encoded.has_content) {
        makeWhite(image);
        document.context().notice("image " + view.pointer() + " has no data and was replaced by white");
    } else {
        format = sniff(encoded.bytes);
        if (format == ImageFormat::unknown) {
            view.failFound("the image is neither PNG nor JPEG",
                           encoded.bytes.empty() ? "no data" : "an unknown format");
        }
        // A data URI may be vague about its type; it must not be wrong about it.
        const bool vague = declared.empty() || declared == "application/octet-stream";
        checkMediaType(encoded, vague ? std::string() : declared, format);
        if (format == ImageFormat::png || format == ImageFormat::jpeg) {
            decode(view, encoded.bytes, format, image);
        } else {
            makeWhite(image);
            document.context().notice("image " + view.pointer() + " is " + mediaType(format) +
                                      ", which is not decoded; textures use their PNG or JPEG fallback");
        }
    }
    document.scene.images.push_back(std::move(image));
    return format;
}

Wrap readWrap(const JsonView& view, const char* key)
{
    const std::optional<JsonView> member = view.find(key);
    const std::uint64_t value = member ? member->uint() : 10497;
    switch (value) {
    case 33071:
        return Wrap::clamp_to_edge;
    case 33648:
        return Wrap::mirrored_repeat;
    case 10497:
        return Wrap::repeat;
    default:
        member->fail("the wrap mode must be 33071, 33648 or 10497");
    }
}

/// The sampler's part of a texture.
Texture readSampler(const JsonView& view)
{
    checkExtensions(view, Place::other);
    Texture texture;
    texture.wrap_u = readWrap(view, "wrapS");
    texture.wrap_v = readWrap(view, "wrapT");
    if (const std::optional<JsonView> filter = view.find("magFilter")) {
        const std::uint64_t value = filter->uint();
        if (value != 9728 && value != 9729) {
            filter->fail("the magnification filter must be 9728 or 9729");
        }
        texture.magnify_linear = value == 9729;
    }
    if (const std::optional<JsonView> filter = view.find("minFilter")) {
        const std::uint64_t value = filter->uint();
        const bool mipmapped = value >= 9984 && value <= 9987;
        if (!mipmapped && value != 9728 && value != 9729) {
            filter->fail("the minification filter must be 9728, 9729 or 9984 to 9987");
        }
        texture.mipmaps = mipmapped;
        texture.minify_linear = value % 2 == 1; // the odd codes are the linear ones
    }
    return texture;
}

/// Checks the source of EXT_texture_webp, which we do not decode.
void checkWebp(const Document& document, const JsonView& view)
{
    const std::optional<JsonView> webp = extension(view, "EXT_texture_webp");
    const std::optional<JsonView> source = webp ? webp->find("source") : std::nullopt;
    if (!source) {
        return;
    }
    const std::uint32_t image = source->index(document.scene.images.size());
    if (document.image_formats[image] != ImageFormat::webp) {
        source->failFound("the texture's image must be image/webp", mediaType(document.image_formats[image]));
    }
}

} // namespace

void readImages(Document& document)
{
    const std::size_t count = topLevelCount(document, "images");
    for (std::size_t i = 0; i < count; ++i) {
        document.image_formats.push_back(readImage(document, document.root.at("images").element(i)));
    }
}

void readTextures(Document& document)
{
    std::vector<Texture> samplers;
    const std::size_t sampler_count = topLevelCount(document, "samplers");
    for (std::size_t i = 0; i < sampler_count; ++i) {
        samplers.push_back(readSampler(document.root.at("samplers").element(i)));
    }
    const std::size_t count = topLevelCount(document, "textures");
    for (std::size_t i = 0; i < count; ++i) {
        const JsonView view = document.root.at("textures").element(i);
        checkExtensions(view, Place::texture);
        const std::uint32_t sampler = view.index("sampler", samplers.size());
        Texture texture = sampler == kNone ? Texture{} : samplers[sampler];
        texture.image = view.index("source", document.scene.images.size());
        if (texture.image != kNone) {
            const ImageFormat format = document.image_formats[texture.image];
            if (format != ImageFormat::png && format != ImageFormat::jpeg) {
                view.at("source").failFound("a texture's image must be image/png or image/jpeg", mediaType(format));
            }
        }
        checkWebp(document, view);
        document.scene.textures.push_back(texture);
    }
}

} // namespace gnomon::scene::gltf
