// Spectra of signals of every length and kind against FFTW and the twin.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "spectrum/signals.h"

namespace scene_analyzer::spectrum {
namespace {

class SpectrumTest : public test::GpuTest {
 protected:
  static SpectrumBuilder& builder() {
    static auto& kept = *new SpectrumBuilder(device());
    return kept;
  }
  static void expect_like_fftw(SpectrumBuilder& tested, const std::vector<std::uint64_t>& lengths) {
    std::vector<Samples> signals;
    for (const std::uint64_t length : lengths) signals.push_back(random_samples(length, length));
    const Found found = transformed(tested, signals);
    for (std::size_t i = 0; i < signals.size(); ++i) {
      SCOPED_TRACE(std::to_string(signals[i].size()) + " samples");
      expect_spectrum(found.totals[i], found.magnitudes[i], fftw_spectrum(signals[i]));
    }
  }
};

std::vector<std::uint64_t> range(std::uint64_t first, std::uint64_t last) {
  std::vector<std::uint64_t> numbers(last - first + 1);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

TEST_F(SpectrumTest, EveryShortLength) {
  expect_like_fftw(builder(), range(1, 300));
}

TEST_F(SpectrumTest, EveryShortLengthByTheChirpTransform) {
  SpectrumBuilder chirps_only(device(), {.short_samples = 1});
  expect_like_fftw(chirps_only, range(1, 300));
}

TEST_F(SpectrumTest, EveryShortLengthDirectly) {
  SpectrumBuilder direct(device(), {.short_samples = 700});
  expect_like_fftw(direct, range(250, 700));
}

// Rows of every radix, with all of their last element used and with one lag too many for them.
TEST_F(SpectrumTest, LengthsAroundThoseOfRows) {
  std::vector<std::uint64_t> lengths;
  for (const std::uint64_t row : {256U, 512U, 768U, 1024U, 1536U, 2048U, 3072U, 4096U, 6144U, 8192U, 12288U,
                                  16384U, 24576U, 32768U, 49152U, 65536U, 98304U})
    for (const std::uint64_t length : {row - 2, row, row + 2, row / 3 * 2 - 1, row / 3 * 2, row / 3 * 2 + 1})
      lengths.push_back(length);
  expect_like_fftw(builder(), lengths);
}

TEST_F(SpectrumTest, NastyLengths) {
  std::vector<std::uint64_t> lengths{4404, 40612, 40609, 94074, 1000003, 65537, 7919, 31957};
  for (std::uint64_t power = 512; power <= 1U << 20; power *= 2)
    for (const std::uint64_t length : {power - 1, power, power + 1})
      if (power < 1U << 17 || power == 1U << 20) lengths.push_back(length);
  expect_like_fftw(builder(), lengths);
}

// Where k^2 is a multiple of the chirp's period and the quotient in double precision comes out below it. One
// signal at a time: a wrong index would otherwise meet another chirp's table.
TEST_F(SpectrumTest, SquaresThatAreMultiplesOfThePeriod) {
  for (const std::uint64_t length : {1568U, 3136U, 6272U, 6592U, 6848U, 7168U, 12544U})
    expect_like_fftw(builder(), {length});
}

// More than one batch, lengths that share chirps, in an order that is none.
TEST_F(SpectrumTest, ManySignalsOfMixedLengths) {
  test_meshes::Random random(5);
  std::vector<std::uint64_t> lengths;
  for (int i = 0; i < 1500; ++i) lengths.push_back(random.below(i % 3 == 0 ? 40 : 3000));
  SpectrumBuilder small_batches(device(), {.batch = 1U << 16});
  std::vector<Samples> signals;
  for (const std::uint64_t length : lengths) signals.push_back(random_samples(length, signals.size()));
  const Found found = transformed(small_batches, signals);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    SCOPED_TRACE(std::to_string(i) + ": " + std::to_string(signals[i].size()) + " samples");
    if (signals[i].empty()) {
      EXPECT_EQ(found.totals[i], SpectrumTotals{});
      EXPECT_TRUE(found.magnitudes[i].empty());
    } else {
      expect_spectrum(found.totals[i], found.magnitudes[i], fftw_spectrum(signals[i]));
    }
  }
}

// Windows of 4096 elements: rows in one to four of them, for odd and for even lengths.
TEST_F(SpectrumTest, RowsInSeveralBuffers) {
  SpectrumBuilder windows(device(), {.window = 1U << 12});
  std::vector<std::uint64_t> lengths{1500, 2001, 2049, 2731, 2733, 4095, 4096, 4097, 4098, 5461,
                                     5463, 6144, 6145, 6146, 8191, 8192, 8193, 8194, 8195, 10921};
  for (const std::uint64_t length : {10000U, 12287U, 12288U, 12290U, 16383U, 16384U})
    lengths.push_back(length / 2 * 2);
  expect_like_fftw(windows, lengths);
}

std::vector<std::pair<std::string, Samples>> kinds_of_signals(std::size_t size) {
  std::vector<std::pair<std::string, Samples>> kinds;
  const auto add = [&](const char* name, auto sample) {
    Samples samples(size);
    for (std::size_t i = 0; i < size; ++i) samples[i] = sample(i);
    kinds.emplace_back(name, std::move(samples));
  };
  test_meshes::Random random(size);
  add("zeros", [](std::size_t) { return 0.0; });
  add("ones", [](std::size_t) { return 1.0; });
  add("impulse", [](std::size_t i) { return i == 0 ? 1.0 : 0.0; });
  add("last", [&](std::size_t i) { return i + 1 == size ? -3.0 : 0.0; });
  add("alternating", [](std::size_t i) { return i % 2 == 0 ? 2.0 : 1.0; });
  add("ramp", [](std::size_t i) { return static_cast<double>(i); });
  add("signs", [&](std::size_t) { return random.between(-1, 1); });
  add("nearly constant", [&](std::size_t) { return 1e6 + random.unit() * 1e-3; });
  add("large", [&](std::size_t) { return 1e290 * random.unit(); });
  add("small", [&](std::size_t) { return 1e-300 * random.unit(); });
  add("wide", [&](std::size_t) { return std::exp2(random.between(-100, 100)); });
  return kinds;
}

TEST_F(SpectrumTest, KindsOfSignalsLikeTheTwin) {
  std::vector<Samples> signals;
  std::vector<std::string> names;
  for (const std::size_t size : {2U, 3U, 12U, 97U, 255U, 256U, 300U, 331U, 640U, 1023U})
    for (auto& [name, samples] : kinds_of_signals(size)) {
      names.push_back(name + " of " + std::to_string(size));
      signals.push_back(std::move(samples));
    }
  const Found found = transformed(builder(), signals);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    SCOPED_TRACE(names[i]);
    expect_spectrum(found.totals[i], found.magnitudes[i], reference::spectrum(signals[i]));
  }
}

// The rating takes alternating components below 1e-12 |X_0| for none.
TEST_F(SpectrumTest, ConstantsHaveNoAlternatingComponents) {
  std::vector<Samples> signals;
  for (const std::size_t size : {2U, 7U, 100U, 255U, 300U, 1001U, 40612U, 100003U})
    signals.emplace_back(size, 0.1);
  for (const SpectrumTotals& totals : builder().transform(spans_of(signals))) {
    EXPECT_GT(totals.zero, 0.1);
    EXPECT_LE(totals.sum, 1e-14 * totals.zero);
  }
}

TEST_F(SpectrumTest, NothingAndSingleSamples) {
  EXPECT_TRUE(builder().transform({}).empty());
  const Found found = transformed(builder(), {{}, {-2.5}, {}, {7}});
  EXPECT_EQ(found.totals[0], SpectrumTotals{});
  EXPECT_EQ(found.totals[1], SpectrumTotals{.zero = 2.5});
  EXPECT_EQ(found.totals[2], SpectrumTotals{});
  EXPECT_EQ(found.totals[3], SpectrumTotals{.zero = 7});
  EXPECT_THAT(found.magnitudes, testing::ElementsAre(testing::IsEmpty(), testing::ElementsAre(2.5),
                                                     testing::IsEmpty(), testing::ElementsAre(7)));
}

TEST_F(SpectrumTest, SameBitsEveryTimeAndInEveryCompany) {
  std::vector<Samples> signals;
  for (const std::uint64_t length :
       {5U, 200U, 256U, 257U, 600U, 600U, 601U, 2999U, 3000U, 5000U, 40612U, 50001U})
    signals.push_back(random_samples(length, length));
  const std::vector<SpectrumTotals> together = builder().transform(spans_of(signals));
  EXPECT_EQ(together, builder().transform(spans_of(signals)));
  EXPECT_EQ(together, transformed(builder(), signals).totals);
  SpectrumBuilder another(device(), {.batch = 1U << 13});
  for (std::size_t i = 0; i < signals.size(); ++i)
    EXPECT_EQ(another.transform(spans_of({signals[i]})).front(), together[i]) << signals[i].size();
}

TEST_F(SpectrumTest, KeepsLittleMemoryBetweenCalls) {
  builder().transform(spans_of({random_samples(20000, 1), random_samples(100, 2)}));
  const std::uint64_t kept = device().buffer_bytes();
  EXPECT_LT(kept, 4U << 20);
  device().reset_peak();
  builder().transform(spans_of({random_samples(100000, 1)}));
  EXPECT_EQ(device().buffer_bytes(), kept);
  // 32 bytes per element of the row, 8 per sample, and tables.
  EXPECT_LT(device().peak_buffer_bytes() - kept, 131072U * 32 + 100000 * 8 + 100000);
}

}  // namespace
}  // namespace scene_analyzer::spectrum
