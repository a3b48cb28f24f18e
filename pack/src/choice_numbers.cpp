// SPDX-License-Identifier: Apache-2.0
// The numbers by which shaders tell choices apart are those of the enums.
#include <gnomon/object_ids.h>
#include <gnomon/options.h>

#include <gnomon/shared/choice_numbers.h>
#include <gnomon/shared/object_ids.h>

namespace gnomon::pack {
namespace {

template <class Enum>
constexpr bool is(int number, Enum value)
{
    return number == static_cast<int>(value);
}

static_assert(is(shared::kIdTestAny, IdTest::any) && is(shared::kIdTestPriority, IdTest::priority) &&
              is(shared::kIdTestNearest, IdTest::nearest));
static_assert(shared::kMostPieces == int(kMostPieces) && kMostIdObjects == (1U << unsigned(shared::kPieceShift)) - 1U &&
              pixelObject(6, 2) == (7U | (2U << unsigned(shared::kPieceShift))));
static_assert(is(shared::kSamplingNearest, MapSampling::nearest) &&
              is(shared::kSamplingBilinear, MapSampling::bilinear) &&
              is(shared::kSamplingTrilinear, MapSampling::trilinear) &&
              is(shared::kSamplingAnisotropic, MapSampling::anisotropic));

} // namespace
} // namespace gnomon::pack
