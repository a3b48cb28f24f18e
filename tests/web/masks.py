# SPDX-License-Identifier: Apache-2.0
"""Masks as bytes, and how far apart two of one frame are (tests/drivers/beyond_edges.h)."""


class Mask:
    def __init__(self, texels: bytes, width: int, height: int, channels: int, layers: int):
        if len(texels) != width * height * channels * layers:
            raise ValueError(f"{len(texels)} bytes, and not {width * height * channels * layers}")
        self.texels, self.width, self.height, self.channels, self.layers = texels, width, height, channels, layers

    def spread(self) -> int:
        return max(self.texels) - min(self.texels)


def farthest(mask: Mask, reference: Mask) -> int:
    """Steps of 255 that they are apart at most."""
    return max(abs(a - b) for a, b in zip(mask.texels, reference.texels, strict=True))


def beyond_edges(mask: Mask, reference: Mask) -> int:
    """How many values of `mask` are outside the range of the 3 x 3 pixels of `reference` around them, by more than a tenth."""
    row, step, tolerance, count = reference.width * reference.channels, reference.channels, 25.5, 0
    for at, (value, same) in enumerate(zip(mask.texels, reference.texels, strict=True)):
        if abs(value - same) <= tolerance:
            continue
        x, y = at // step % reference.width, at // row % reference.height
        near = [reference.texels[at + i * step + j * row] for i in (-1, 0, 1) for j in (-1, 0, 1)
                if 0 <= x + i < reference.width and 0 <= y + j < reference.height]
        count += not min(near) - tolerance <= value <= max(near) + tolerance
    return count
