// SPDX-License-Identifier: Apache-2.0
// The values of options by name, in the order of their enumerations.
#include <gnomon/options.h>

#include <array>
#include <string_view>

namespace gnomon {
namespace {

template <class Enum, std::size_t n>
std::string_view nameIn(const std::array<std::string_view, n>& names, Enum value)
{
    const auto i = static_cast<std::size_t>(value);
    return i < n ? names[i] : "?";
}

} // namespace

std::string_view nameOf(CascadePass value)
{
    return nameIn(std::array<std::string_view, 3>{"auto", "each", "layered"}, value);
}
std::string_view nameOf(MultiDivide value)
{
    return nameIn(std::array<std::string_view, 2>{"space", "receivers"}, value);
}
std::string_view nameOf(Quality value)
{
    return nameIn(std::array<std::string_view, 3>{"fast", "balanced", "best"}, value);
}
std::string_view nameOf(CasterFaces value)
{
    return nameIn(std::array<std::string_view, 3>{"nearest", "back", "midpoint"}, value);
}
std::string_view nameOf(CasterCull value)
{
    return nameIn(std::array<std::string_view, 3>{"none", "back", "front"}, value);
}
std::string_view nameOf(OpenCasters value)
{
    return nameIn(std::array<std::string_view, 2>{"refuse", "skip"}, value);
}
std::string_view nameOf(Translucent value)
{
    return nameIn(std::array<std::string_view, 3>{"none", "grey", "colour"}, value);
}
std::string_view nameOf(IdTest value)
{
    return nameIn(std::array<std::string_view, 4>{"auto", "any", "priority", "nearest"}, value);
}
std::string_view nameOf(IdOf value)
{
    return nameIn(std::array<std::string_view, 2>{"object", "face"}, value);
}
std::string_view nameOf(IdDepth value)
{
    return nameIn(std::array<std::string_view, 2>{"object", "global"}, value);
}
std::string_view nameOf(LightenAs value)
{
    return nameIn(std::array<std::string_view, 2>{"remap", "add"}, value);
}
std::string_view nameOf(StepBy value)
{
    return nameIn(std::array<std::string_view, 2>{"angle", "time"}, value);
}
std::string_view nameOf(StepWait value)
{
    return nameIn(std::array<std::string_view, 2>{"none", "camera"}, value);
}
std::string_view nameOf(ScreenKernel value)
{
    return nameIn(std::array<std::string_view, 3>{"gaussian", "box", "poisson"}, value);
}
std::string_view nameOf(ScreenSize value)
{
    return nameIn(std::array<std::string_view, 3>{"full", "half", "quarter"}, value);
}
std::string_view nameOf(ScreenEdges value)
{
    return nameIn(std::array<std::string_view, 2>{"edge-aware", "plain"}, value);
}
std::string_view nameOf(ScreenTaps value)
{
    return nameIn(std::array<std::string_view, 2>{"symmetric", "published"}, value);
}
std::string_view nameOf(MaskSize value)
{
    return nameIn(std::array<std::string_view, 2>{"full", "half"}, value);
}
std::string_view nameOf(KeepStill value)
{
    return nameIn(std::array<std::string_view, 3>{"auto", "never", "always"}, value);
}

} // namespace gnomon
