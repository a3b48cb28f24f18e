// SPDX-License-Identifier: Apache-2.0
// Wrong uses of sweeps and of metrics of images.
#include "wrong_usage.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using test::Wrong;

const std::vector<Wrong> kWrongMeasures{
    {"SweepOfAnother", {"bench", "--sweep", "map-size=64:128:2"}, 2, "--sweep is not an option of bench"},
    {"SweepWithoutSteps", {"compare", "--sweep", "map-size=64:128"}, 2, "KEY=FROM:TO:STEPS"},
    {"SweepOfNothing", {"compare", "--sweep", "map-size"}, 2, "KEY=FROM:TO:STEPS"},
    {"SweepOddEnd", {"compare", "--sweep", "map-size=64:128:2:lin"}, 2, "KEY=FROM:TO:STEPS"},
    {"SweepUnknown", {"compare", "--sweep", "map-sise=64:128:2"}, 2, "did you mean \"map-size\""},
    {"SweepOfAChoice", {"compare", "--sweep", "pcf.kernel=2:3:2"}, 2, "no number that errors depend on"},
    {"SweepOfTimes", {"compare", "--sweep", "repetitions=4:8:2"}, 2, "no number that errors depend on"},
    {"SweepOfAnothersNumber", {"compare", "--sweep", "repetitions=4:8:2"}, 2, "no number that errors depend on"},
    {"SweepOfHardTruthsSamples",
     {"compare", "--truth", "hard", "--sweep", "samples=4:8:2"},
     2,
     "samples has an effect only with --truth area"},
    {"SweepOfNoMultiples", {"compare", "--sweep", "samples=4:10:2"}, 2, "samples takes multiples of 4"},
    {"SweepOfTooFewMultiples", {"compare", "--sweep", "samples=4:12:4"}, 2, "samples has only 3 values from 4 to 12"},
    {"SweepOfAnotherLightsSize",
     {"compare", "planes", "--sun", "1,-1,0", "--sweep", "light-size=0:1:2"},
     2,
     "--light-size has an effect only on a spot or point light"},
    {"SweepBeyondRange", {"compare", "--sweep", "map-size=8:128:2"}, 2, "\"8\" is not in the range 16 to 16384"},
    {"SweepNan", {"compare", "--sweep", "pcf.radius=nan:2:2"}, 2, "not in the range"},
    {"SweepNotWhole", {"compare", "--sweep", "map-size=64.5:128:2"}, 2, "whole numbers"},
    {"SweepOneStep", {"compare", "--sweep", "map-size=64:128:1"}, 2, "2 to 1000"},
    {"SweepOnTheSpot", {"compare", "--sweep", "map-size=64:64:2"}, 2, "same value"},
    {"SweepTooFine", {"compare", "--sweep", "pcf.taps=4:8:6"}, 2, "pcf.taps has only 5 values"},
    {"SweepLogOfZero", {"compare", "--sweep", "bias.slope=0:2:3:log"}, 2, "above 0"},
    {"SweepAndTheOption", {"compare", "--map-size", "64", "--sweep", "map-size=64:128:2"}, 2, "give one"},
    {"MetricsOfNothing", {"metrics"}, 2, "two images, the test and the truth; 0 are given"},
    {"MetricsOfOne", {"metrics", "a.png"}, 2, "one is given"},
    {"MetricsOfThree", {"metrics", "a.png", "b.png", "c.png"}, 2, "3 are given"},
    {"MetricsWithAScenesOption", {"metrics", "a.png", "b.png", "--size", "8x8"}, 2, "not an option of metrics"},
    {"MetricsWithAPreset", {"metrics", "a.png", "b.png", "--preset", "demo"}, 2, "not an option of metrics"},
    {"ListWithASetting", {"list", "--set", "map-size=64"}, 2, "--set is not an option of list"},
    {"MetricsJsonOfAnotherName", {"metrics", "a.png", "b.png", "--json", "out.txt"}, 2, "no image, and a file"},
    {"MetricsMissing", {"metrics", "a.png", "b.png"}, 1, "a.png"},
    {"MetricsOfAFolder", {"metrics", "a_folder", "b.png"}, 1, "a_folder"},
    {"MetricsOfText", {"metrics", "broken.json", "broken.json"}, 1, "neither a PNG nor an EXR"},
    {"BenchJsonIsAFolder", {"bench", "planes", "--json=a_folder"}, 1, "directory"}};

class WrongMeasure : public testing::TestWithParam<Wrong> {};

TEST_P(WrongMeasure, IsOneLineAndLeavesNothing)
{
    test::expectOneLineAndNothingLeft(GetParam(), true);
}

INSTANTIATE_TEST_SUITE_P(Table, WrongMeasure, testing::ValuesIn(kWrongMeasures),
                         [](const auto& test) { return std::string(test.param.name); });

} // namespace
} // namespace gnomon
