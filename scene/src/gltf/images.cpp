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
    std::string missing; // why there are none; empty: there are
    JsonView where;      // the place of a wrong media type, for errors
};

Encoded findEncoded(const Document& document, const JsonView& view)
{
    const std::optional<JsonView> uri = view.find("uri");
    const std::optional<JsonView> buffer_view = view.find("bufferView");
    if (uri.has_value() == buffer_view.has_value()) {
        view.failFound("an image needs either a uri or a bufferView", uri ? "both" : "neither");
    }
    if (uri) {
        std::optional<Resource> resource = fetchIfThere(*uri);
        if (!resource) {
            return {{}, {}, "names a file that is not there, " + uri->string(), *uri};
        }
        Encoded out{std::move(*resource), {}, {}, *uri};
        out.bytes = out.resource.bytes;
        return out;
    }
    const BufferView& data = document.views[buffer_view->index(document.views.size())];
    if (data.stride != 0) {
        view.context().notice("the buffer view of image " + view.pointer() + " has a byteStride, which has no effect");
    }
    return {{}, data.bytes, data.has_content ? "" : "has no data", *buffer_view};
}

/// One white texel, for what cannot be decoded or has no data. No texture uses it.
void makeWhite(Image& image)
{
    image.width = 1;
    image.height = 1;
    image.rgba.assign(4, 0xFF);
}

/// The format of the data; fails where it is not the one that the file says, or none at all.
ImageFormat formatOf(const Encoded& encoded, const std::string& declared)
{
    const ImageFormat format = sniff(encoded.bytes);
    if (encoded.bytes.empty()) {
        encoded.where.failFound("the image's data are invalid", "no data");
    }
    // A data URI may be vague about its type; it must not be wrong about it.
    const bool vague = declared.empty() || declared == "application/octet-stream";
    const bool known = format != ImageFormat::unknown || decoderOf(formatNamed(declared)) != nullptr;
    if (!vague && known && declared != mediaType(format)) {
        encoded.where.failFound(format == ImageFormat::unknown
                                    ? "the image's data are not what its media type says"
                                    : "the image's data are " + std::string(mediaType(format)) +
                                          ", not what its media type says",
                                declared);
    }
    return format;
}

void decode(const JsonView& view, std::span<const std::byte> bytes, Decoder decoder, Image& image)
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
    const std::string wrong = decoder(bytes, check, image);
    if (!wrong.empty()) {
        view.failFound("the image's data are invalid", wrong);
    }
}

/// Adds the image to the scene. Returns whether it could be read; textures do without one that could not.
bool readImage(Document& document, const JsonView& view)
{
    checkExtensions(view, Place::other);
    Image image;
    image.name = view.string("name", "");
    const Encoded encoded = findEncoded(document, view);
    std::string missing = encoded.missing;
    if (missing.empty()) {
        const ImageFormat format = formatOf(encoded, view.string("mimeType", encoded.resource.media_type));
        if (const Decoder decoder = decoderOf(format)) {
            decode(view, encoded.bytes, decoder, image);
        } else {
            missing = "is " + std::string(format == ImageFormat::unknown ? "of an unknown format" : mediaType(format)) +
                      ", which cannot be decoded";
        }
    }
    if (!missing.empty()) {
        makeWhite(image);
        document.context().notice("image " + view.pointer() + " " + missing +
                                  "; textures use another source, or are left out");
    }
    document.scene.images.push_back(std::move(image));
    return missing.empty();
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

/// The first image of a texture that could be read, those of extensions before the plain one; kNone without any.
std::uint32_t readSource(const Document& document, const JsonView& view)
{
    std::uint32_t source = kNone;
    const auto take = [&](const JsonView& owner) {
        const std::uint32_t image = owner.index("source", document.scene.images.size());
        if (source == kNone && image != kNone && document.images_read[image]) {
            source = image;
        }
    };
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"}) {
        if (const std::optional<JsonView> other = extension(view, name)) {
            take(*other);
        }
    }
    take(view);
    return source;
}

} // namespace

void readImages(Document& document)
{
    const std::size_t count = topLevelCount(document, "images");
    for (std::size_t i = 0; i < count; ++i) {
        document.images_read.push_back(readImage(document, document.root.at("images").element(i)));
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
        texture.image = readSource(document, view);
        document.scene.textures.push_back(texture);
    }
}

} // namespace gnomon::scene::gltf
