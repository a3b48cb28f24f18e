// SPDX-License-Identifier: Apache-2.0
// Filters on maps with any values at all. Included once for each precision, after the shaders' files, whose maps and
// layers of depth must be hostileTexel().
GN_BEGIN
namespace hostile {

struct Options {
    int filter;
    int flags;
    int sampling;
    real exponent;
};

inline MomentRule ruleOf(const Options& o)
{
    MomentRule rule;
    rule.flags = o.flags;
    rule.sampling = o.sampling;
    rule.layers = 8;
    rule.exponent = o.exponent;
    rule.exponent_negative = real(5.0);
    rule.moment_bias = real(3e-5);
    rule.min_variance = real(1e-6);
    rule.min_variance_texels = real(0.5);
    rule.rounding = real(2e-6);
    rule.rounding_negative = real(1e-3);
    rule.linstep = real(0.3);
    rule.power = real(1.3);
    rule.lighten = real(0.1);
    rule.lighten_cut = real(0.1);
    rule.anisotropy = real(8.0);
    return rule;
}

// A receiver amid a tile of 1000 texels, and a footprint of any length.
template <class Uniform>
std::pair<MapPoint, FilterInput> receiver(const Options& o, Uniform uniform)
{
    MapPoint point{};
    point.texel = real2(uniform(0.0, 1000.0), uniform(0.0, 1000.0));
    point.depth = uniform(-0.1, 1.1);
    point.depth_slope = real2(uniform(-0.1, 0.1), uniform(-0.1, 0.1));
    point.cap = min(point.depth, real(1.0));
    point.w = uniform(0.1, 100.0);
    point.texel_depth = uniform(1e-5, 1e-2);
    FilterInput f{};
    f.moments = ruleOf(o);
    f.tile = real4(0.0, 0.0, 1000.0, 1000.0);
    f.coarsest = real(7.0);
    f.near_over_far = uniform(1e-3, 1.0);
    const real reach = exp2(uniform(-3.0, 20.0));
    f.footprint_x = real2(uniform(-1.0, 1.0), uniform(-1.0, 1.0)) * reach;
    f.footprint_y = real2(uniform(-1.0, 1.0), uniform(-1.0, 1.0)) * reach;
    const auto row = [&](double size) {
        return real4(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)) * real(size);
    };
    f.rows.x = row(1000.0);
    f.rows.y = row(1000.0);
    f.rows.w = row(1.0);
    f.rows.metric = row(0.1);
    f.n = real3(row(1.0));
    f.toward = real3(row(1.0));
    f.spread = uniform(0.0, 0.5);
    return {point, f};
}

inline void expectBounded(const Options& o, int draws)
{
    std::mt19937 rng(11);
    const auto uniform = [&](double a, double b) {
        return static_cast<real>(std::uniform_real_distribution<double>(a, b)(rng));
    };
    for (int i = 0; i < draws; ++i) {
        test::hostile_state = static_cast<std::uint32_t>(rng());
        test::hostile_same = i % 2 == 0; // all reads of a receiver alike, or each another
        const auto [point, f] = receiver(o, uniform);
        const real v = boundedVisibility(applyFilter(o.filter, point, f));
        ASSERT_TRUE(v >= real(0.0) && v <= real(1.0))
            << v << " of filter " << o.filter << ", flags " << o.flags << ", sampling " << o.sampling << ", draw " << i;
    }
}

// Every filter with every way to store and to read.
inline void expectAllBounded()
{
    for (const int filter :
         {GNOMON_FILTER_VSM, GNOMON_FILTER_LVSM, GNOMON_FILTER_ESM, GNOMON_FILTER_EVSM, GNOMON_FILTER_MSM}) {
        for (int flags = 0; flags < 2 * kMomentPenumbra; ++flags) {
            for (const real exponent : {real(5.5), real(88.0)}) {
                expectBounded({filter, flags, flags % 4, exponent}, 60);
            }
        }
        for (int sampling = 0; sampling < 4; ++sampling) {
            expectBounded({filter, kMomentFourChannels, sampling, real(40.0)}, 1000);
        }
    }
    expectBounded({GNOMON_FILTER_RAYMARCH, 0, 0, real(0.0)}, 300);
    expectBounded({GNOMON_FILTER_PCSS, 0, 0, real(0.0)}, 300);
}

} // namespace hostile
GN_END
