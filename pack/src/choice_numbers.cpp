// SPDX-License-Identifier: Apache-2.0
// The numbers by which shaders tell choices apart are those of the enums.
#include <gnomon/choices.h>
#include <gnomon/moment_options.h>

#include <choice_numbers.h>

namespace gnomon::pack {
namespace {

template <class Enum>
constexpr bool is(int number, Enum value)
{
    return number == static_cast<int>(value);
}

static_assert(is(shared::kFilterHard, Filter::hard) && is(shared::kFilterPcf, Filter::pcf) &&
              is(shared::kFilterPcss, Filter::pcss) && is(shared::kFilterRaymarch, Filter::raymarch) &&
              is(shared::kFilterVsm, Filter::vsm) && is(shared::kFilterLvsm, Filter::lvsm) &&
              is(shared::kFilterEsm, Filter::esm) && is(shared::kFilterEvsm, Filter::evsm) &&
              is(shared::kFilterMsm, Filter::msm));
static_assert(is(shared::kSamplingNearest, MapSampling::nearest) &&
              is(shared::kSamplingBilinear, MapSampling::bilinear) &&
              is(shared::kSamplingTrilinear, MapSampling::trilinear) &&
              is(shared::kSamplingAnisotropic, MapSampling::anisotropic));

} // namespace
} // namespace gnomon::pack
