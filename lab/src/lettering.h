// SPDX-License-Identifier: Apache-2.0
// Letters and rectangles in RGB pictures. The fonts are those built into libgd: no font file is read.
#pragma once

#include "false_colour.h"
#include "image/image.h"

#include <cstdint>
#include <string_view>

namespace gnomon::lab {

enum class Font : std::uint8_t {
    normal, // 6 x 13 px for each letter
    bold,   // 7 x 13 px
};
inline constexpr std::int64_t kLetterHeight = 13;

/// Width of ASCII `text` in px at scale 1.
[[nodiscard]] std::int64_t textWidth(std::string_view text, Font font);

/// Writes ASCII `text` with its upper left corner at (x, y), each of the font's pixels a square of `scale` px. Parts
/// outside the picture are cut. Throws std::bad_alloc when libgd finds no memory.
void drawText(Image8& picture, std::int64_t x, std::int64_t y, std::string_view text, Font font, std::int64_t scale,
              Colour colour);

/// Fills a rectangle, cut at the picture's border.
void fillRectangle(Image8& picture, std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                   Colour colour);

inline void setPixel(Image8& picture, std::uint32_t x, std::uint32_t y, Colour colour)
{
    std::uint8_t* const rgb = picture.pixel(x, y);
    rgb[0] = colour.red;
    rgb[1] = colour.green;
    rgb[2] = colour.blue;
}

} // namespace gnomon::lab
