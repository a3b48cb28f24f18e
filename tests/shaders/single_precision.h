// SPDX-License-Identifier: Apache-2.0
// From a map of 32-bit floats to visibility in the precision of the includer, once for each, after the
// shaders' files.
GN_BEGIN
namespace single {

inline MomentRule ruleOf(const test::SingleOptions& o)
{
    MomentRule rule{};
    rule.flags = o.flags;
    rule.sampling = 1; // bilinear
    rule.layers = 2;
    rule.exponent = real(o.exponent);
    rule.exponent_negative = real(5.0);
    rule.moment_bias = real(o.moment_bias);
    rule.min_variance = real(o.min_variance);
    rule.min_variance_texels = real(0.5);
    rule.rounding = real(o.rounding);
    rule.rounding_negative = real(o.rounding_negative);
    rule.power = real(1.0);
    return rule;
}

inline real visibilityOf(const test::DepthDraw& draw, const test::SingleOptions& o)
{
    MapPoint point{};
    point.texel = real2(8.0);
    point.depth = real(draw.receiver);
    point.cap = real(1.0);
    point.w = real(1.0);
    point.texel_depth = real(draw.texel_depth);
    FilterInput f{};
    f.moments = ruleOf(o);
    f.tile = real4(0.0, 0.0, 16.0, 16.0);
    f.near_over_far = real(1.0);
    return boundedVisibility(applyFilter(o.filter, point, f));
}

} // namespace single
GN_END
