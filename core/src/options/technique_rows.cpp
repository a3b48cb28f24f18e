// SPDX-License-Identifier: Apache-2.0
// The options of a technique. A new one is one row here.
#include "options/option_access.h"
#include "options/option_rows.h"

namespace gnomon {
namespace {

using enum OptionType;

bool lightens(const ShadowOptions& o)
{
    return o.lighten > 0.0F;
}
bool isPcf(const ShadowOptions& o)
{
    return filterOf(o) == Filter::pcf || filterOf(o) == Filter::smoothies; // whose map is tested as pcf tests it
}
bool choosesByQuality(const ShadowOptions& o)
{
    return hasMaps(o) && (o.technique.partition == Partition::automatic || o.technique.filter == Filter::automatic);
}
bool sizesItself(const ShadowOptions& o)
{
    return !o.map_size && hasMaps(o);
}
bool goesByMemory(const ShadowOptions& o)
{
    return sizesItself(o) && !o.max_texels;
}
bool isVolumes(const ShadowOptions& o)
{
    return filterOf(o) == Filter::volumes;
}
bool isDisc(const ShadowOptions& o)
{
    return isPcf(o) && kernelWidth(o.pcf.kernel) == 0;
}
bool hasIds(const ShadowOptions& o)
{
    const FilterTraits* const traits = filterTraits(filterOf(o));
    return traits != nullptr && traits->ids;
}
bool isDepthId(const ShadowOptions& o)
{
    return filterOf(o) == Filter::depth_id;
}
/// Ids alone compare no depths, and id.bias says it instead.
bool hasBias(const ShadowOptions& o)
{
    return hasMaps(o) && filterOf(o) != Filter::id && !(isDepthId(o) && o.ids.bias);
}
bool isGaussian(const ShadowOptions& o)
{
    return isPcf(o) && kernelWidth(o.pcf.kernel) > 1;
}

/// Setting a part of the bias turns the automatic bias off, and taking its value away turns it on.
template <auto path>
void setBias(ShadowOptions& options, const OptionValue& value)
{
    if (value.none) {
        options.bias = BiasOptions{};
        return;
    }
    options.bias.automatic = false;
    assign(path(options.bias), value);
}
template <auto path>
OptionValue getBias(const ShadowOptions& options)
{
    if (!options.bias.automatic) {
        return valueOf(path(options.bias));
    }
    OptionValue none;
    none.none = true;
    return none;
}
#define GNOMON_BIAS(PATH)                                                                                              \
    .get = getBias < [](auto& b) -> auto&                                                                              \
    {                                                                                                                  \
        return b.PATH;                                                                                                 \
    }                                                                                                                  \
    >, .set = setBias < [](auto& b) -> auto&                                                                           \
    {                                                                                                                  \
        return b.PATH;                                                                                                 \
    }                                                                                                                  \
    >

} // namespace

void addTechniqueRows(std::vector<OptionRow>& table)
{
    const OptionRow rows[]{
        // clang-format off
        {.key = "filter", .type = choice, .form = "NAME", .choices = namesOf<Filter>, .doc = "what a texel stores and how it is tested", .own_option = true, GNOMON_MEMBER(technique.filter)},
        {.key = "fit", .type = choice, .form = "NAME", .choices = namesOf<Fit>, .doc = "how one frustum's projection is shaped", .own_option = true, GNOMON_MEMBER(technique.fit)},
        {.key = "partition", .type = choice, .form = "NAME", .choices = namesOf<Partition>, .doc = "how a light's receivers are divided among frustums", .own_option = true, GNOMON_MEMBER(technique.partition)},
        {.key = "soften", .type = choice, .form = "NAME", .choices = namesOf<Soften>, .doc = "what happens to the visibility in screen space", .own_option = true, GNOMON_MEMBER(technique.soften)},
        {.key = "motion", .type = choice, .form = "NAME", .choices = namesOf<Motion>, .doc = "how the map follows a moving camera or sun", .own_option = true, GNOMON_MEMBER(technique.motion)},
        {.key = "quality", .type = choice, .form = "NAME", .choices = namesOf<Quality>, .doc = "what auto may spend: pcf and one map, or rays and cascades too, or one map fitted to the camera's depth", .own_option = true, .used = choosesByQuality, .used_when = "partition or filter auto, but filter volumes", GNOMON_MEMBER(quality)},
        {.key = "map-size", .type = integer, .form = "N", .unit = "texels", .min = 16, .max = 16384, .none_text = "auto", .doc = "side of one map; auto: as large as texels lets it be, or less where no more is of use", .own_option = true, .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(map_size)},
        {.key = "texels", .type = integer, .form = "N", .unit = "texels", .min = 1024, .max = 268435456, .none_text = "auto", .doc = "that a light's maps may have together; auto: as memory has room for, as far as they are worth their time", .own_option = true, .used = sizesItself, .used_when = "map-size auto, but filter volumes", GNOMON_MEMBER(max_texels)},
        {.key = "sun-memory", .type = real, .form = "M", .unit = "MiB", .min = 0.0625, .max = 1024, .doc = "that all maps of a sun may take", .used = goesByMemory, .used_when = "map-size and texels auto, but filter volumes", GNOMON_MEMBER(sun_memory_mib)},
        {.key = "lamp-memory", .type = real, .form = "M", .unit = "MiB", .min = 0.0625, .max = 1024, .doc = "that all maps of a spot or point light may take", .used = goesByMemory, .used_when = "map-size and texels auto, but filter volumes", GNOMON_MEMBER(lamp_memory_mib)},
        {.key = "map-format", .type = choice, .form = "FORMAT", .choices = namesOf<MapFormat>, .doc = "what a texel is stored as; else the filter's own", .own_option = true, .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(format)},
        {.key = "bias.constant", .type = real, .form = "M", .unit = "m", .min = -1e6, .max = 1e6, .doc = "towards the light; ends bias=auto", .used = hasBias, .used_when = "every filter but volumes and id, and no id.bias", GNOMON_BIAS(constant_m)},
        {.key = "bias.slope", .type = real, .form = "S", .unit = "texel depths", .min = 0, .max = 16, .doc = "times the depth that one texel spans; ends bias=auto", .used = hasBias, .used_when = "every filter but volumes and id, and no id.bias", GNOMON_BIAS(slope)},
        {.key = "bias.normal", .type = real, .form = "T", .unit = "texels", .min = 0, .max = 16, .doc = "receiver moved along its normal; ends bias=auto", .used = hasBias, .used_when = "every filter but volumes and id, and no id.bias", GNOMON_BIAS(normal_texels)},
        {.key = "bias.receiver-plane", .type = flag, .form = "0|1", .doc = "each tap against the receiver's plane there; ends bias=auto", .used = hasBias, .used_when = "every filter but volumes and id, and no id.bias", GNOMON_BIAS(receiver_plane)},
        {.key = "caster-faces", .type = choice, .form = "NAME", .choices = namesOf<CasterFaces>, .doc = "what of casters a map holds: the nearest surface, the nearest that faces away from the light, or midway between first and second", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(faces)},
        {.key = "caster-cull", .type = choice, .form = "NAME", .choices = namesOf<CasterCull>, .doc = "triangles of all casters that are left out, seen from the light: none, back or front faces", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(cull)},
        {.key = "translucent", .type = choice, .form = "NAME", .choices = namesOf<Translucent>, .doc = "what blended casters do to light: nothing, tint it by a grey, or in colour, for which a light takes a layer of the mask", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(translucent)},
        {.key = "lighten", .type = real, .form = "V", .unit = "visibility", .min = 0, .max = 1, .doc = "what full shadow becomes, last of all", GNOMON_MEMBER(lighten)},
        {.key = "lighten.as", .type = choice, .form = "KIND", .choices = namesOf<LightenAs>, .doc = "remap: V (1 - b) + b; add: V + b, at most 1, which eats penumbrae", .used = lightens, .used_when = "lighten above 0", GNOMON_MEMBER(lighten_as)},
        {.key = "mask-size", .type = choice, .form = "NAME", .choices = namesOf<MaskSize>, .doc = "half: one pixel of each 2 x 2 reads maps, the others take from those of their surface where these agree, and read maps where not", .used = hasMaps, .used_when = "every filter but volumes", GNOMON_MEMBER(mask_size)},
        {.key = "pcf.kernel", .type = choice, .form = "NAME", .choices = namesOf<PcfKernel>, .doc = "2x2 is bilinear; 3x3, 5x5, 7x7 Gaussian; poisson, vogel discs; 3x3-box nine equal points, 3x3-projected the same as published in 2005", .used = isPcf, .used_when = "filter pcf or smoothies", GNOMON_MEMBER(pcf.kernel)},
        {.key = "pcf.taps", .type = integer, .form = "N", .unit = "taps", .min = 4, .max = 64, .doc = "of a disc", .used = isDisc, .used_when = "pcf.kernel poisson or vogel", GNOMON_MEMBER(pcf.taps)},
        {.key = "pcf.radius", .type = real, .form = "R", .unit = "texels", .min = 0.5, .max = 16, .doc = "of a disc", .used = isDisc, .used_when = "pcf.kernel poisson or vogel", GNOMON_MEMBER(pcf.radius_texels)},
        {.key = "pcf.sigma", .type = real, .form = "S", .unit = "texels", .min = 0.3, .max = 4, .doc = "of a Gaussian kernel; else its width / 4", .used = isGaussian, .used_when = "pcf.kernel 3x3, 5x5 or 7x7", GNOMON_MEMBER(pcf.sigma_texels)},
        {.key = "smoothies.reach", .type = integer, .form = "N", .unit = "texels", .min = 4, .max = 32, .doc = "that edges are widened by: no penumbra is wider", .used = hasSmoothies, .used_when = "filter or soften smoothies", GNOMON_MEMBER(smoothies.reach_texels)},
        {.key = "id.test", .type = choice, .form = "NAME", .choices = namesOf<IdTest>, .doc = "which texels count: any of the four nearest, the nearest by priority of what is in front, or the nearest alone; auto: any, of depth-id priority", .used = hasIds, .used_when = "filter id or depth-id", GNOMON_MEMBER(ids.test)},
        {.key = "id.of", .type = choice, .form = "NAME", .choices = namesOf<IdOf>, .doc = "what has an id: an object, which then does not shade itself, or each of its faces, which are pieces without a crease", .used = hasIds, .used_when = "filter id or depth-id", GNOMON_MEMBER(ids.of)},
        {.key = "id.depth", .type = choice, .form = "NAME", .choices = namesOf<IdDepth>, .doc = "what depth-id keeps beside an id: depth within the object's own range, or the map's", .used = isDepthId, .used_when = "filter depth-id", GNOMON_MEMBER(ids.depth)},
        {.key = "id.bias", .type = real, .form = "V", .unit = "of the radius", .min = 0, .max = 1, .none_text = "auto", .doc = "how far towards the light an object is compared with itself; auto: as bias.* say", .used = isDepthId, .used_when = "filter depth-id", GNOMON_MEMBER(ids.bias)},
        {.key = "volumes.open", .type = choice, .form = "NAME", .choices = namesOf<OpenCasters>, .doc = "casters that are open, masked, blended or cut: refuse them by name, or leave them out", .used = isVolumes, .used_when = "filter volumes", GNOMON_MEMBER(volumes.open)},
        // clang-format on
    };
    table.insert(table.end(), std::begin(rows), std::end(rows));
}

} // namespace gnomon
