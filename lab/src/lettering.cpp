// SPDX-License-Identifier: Apache-2.0
#include "lettering.h"

#include <gd.h>
#include <gdfontmb.h>
#include <gdfonts.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string>

namespace gnomon::lab {
namespace {

gdFontPtr fontOf(Font font)
{
    return font == Font::bold ? gdFontGetMediumBold() : gdFontGetSmall();
}

struct GdDeleter {
    void operator()(gdImage* image) const { gdImageDestroy(image); }
};

} // namespace

std::int64_t textWidth(std::string_view text, Font font)
{
    return static_cast<std::int64_t>(text.size()) * fontOf(font)->w;
}

void drawText(Image8& picture, std::int64_t x, std::int64_t y, std::string_view text, Font font, std::int64_t scale,
              Colour colour)
{
    if (text.empty()) {
        return;
    }
    const gdFontPtr face = fontOf(font);
    const int width = static_cast<int>(textWidth(text, font));
    const std::unique_ptr<gdImage, GdDeleter> letters(gdImageCreateTrueColor(width, face->h));
    if (!letters) {
        throw std::bad_alloc();
    }
    constexpr int ink = 0xffffff; // on gd's black
    std::string bytes(text);
    gdImageString(letters.get(), face, 0, 0, reinterpret_cast<unsigned char*>(bytes.data()), ink);
    for (int row = 0; row < face->h; ++row) {
        for (int column = 0; column < width; ++column) {
            if (gdImageGetTrueColorPixel(letters.get(), column, row) == ink) {
                fillRectangle(picture, x + column * scale, y + row * scale, scale, scale, colour);
            }
        }
    }
}

void fillRectangle(Image8& picture, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                   Colour colour)
{
    const std::int64_t right = std::min<std::int64_t>(x + width, picture.width);
    const std::int64_t bottom = std::min<std::int64_t>(y + height, picture.height);
    for (std::int64_t row = std::max<std::int64_t>(y, 0); row < bottom; ++row) {
        for (std::int64_t column = std::max<std::int64_t>(x, 0); column < right; ++column) {
            setPixel(picture, static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), colour);
        }
    }
}

} // namespace gnomon::lab
