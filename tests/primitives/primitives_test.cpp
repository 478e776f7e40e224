// Scan and radix sort against the standard library, on nasty sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "primitives/radix_sort.h"
#include "primitives/scan.h"
#include "support/gpu_test.h"
#include "support/meshes.h"

namespace scene_analyzer::primitives {
namespace {

class PrimitivesTest : public test::GpuTest {
 protected:
  template <typename T>
  std::vector<T> scanned(const std::vector<T>& values) {
    gpu::Array<T> array(device(), "values", values.size());
    array.upload(device(), values);
    gpu::Recorder recorder(device());
    scan().record(recorder, array, values.size());
    recorder.submit_and_wait();
    return array.download(device());
  }

  std::vector<std::uint32_t> order_of(const std::vector<std::uint64_t>& keys, std::uint32_t bits) {
    KeyedValues list = make_keyed_values(device(), "keys", keys.size());
    std::vector<std::uint32_t> low, high, values(keys.size());
    for (const std::uint64_t key : keys) {
      low.push_back(static_cast<std::uint32_t>(key));
      high.push_back(static_cast<std::uint32_t>(key >> 32));
    }
    std::iota(values.begin(), values.end(), 0U);
    list.low.upload(device(), low);
    list.high.upload(device(), high);
    list.values.upload(device(), values);
    gpu::Recorder recorder(device());
    list = sort().record(recorder, std::move(list), keys.size(), bits);
    recorder.submit_and_wait();
    return list.values.download(device());
  }

  const RadixSort& sort() {
    static auto& kept = *new RadixSort(device(), scan());
    return kept;
  }

  const Scan& scan() {
    static auto& kept = *new Scan(device());
    return kept;
  }
};

std::vector<std::uint32_t> sizes() {
  std::vector<std::uint32_t> all = test_meshes::nasty_sizes();
  all.insert(all.end(), {4095, 4096, 4097, 16384, 16385, 70000});
  return all;
}

TEST_F(PrimitivesTest, ScanAddsUpUnsignedNumbersAndWraps) {
  test_meshes::Random random(1);
  for (const std::uint32_t size : sizes()) {
    std::vector<std::uint32_t> values(size), expected(size);
    for (auto& value : values) value = static_cast<std::uint32_t>(random.below(std::uint64_t{1} << 32));
    std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0U);
    EXPECT_EQ(scanned(values), expected) << size;
  }
}

TEST_F(PrimitivesTest, ScanAddsUpDoublesTheSameWayEveryTime) {
  test_meshes::Random random(2);
  std::vector<double> values(70000), expected(70000);
  for (auto& value : values) value = random.unit();
  std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0.0);
  const std::vector<double> once = scanned(values);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(once[i], expected[i], 1e-9);
  EXPECT_EQ(once, scanned(values));
}

TEST_F(PrimitivesTest, SortIsStableAndLooksAtTheBitsAskedFor) {
  test_meshes::Random random(3);
  for (const std::uint32_t size : sizes()) {
    for (const std::uint32_t bits : {1U, 8U, 9U, 33U, 64U}) {
      const std::uint64_t mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
      std::vector<std::uint64_t> keys(size);
      // Few distinct keys in every other round, so that stability shows.
      for (auto& key : keys)
        key = (random.below(size % 2 == 0 ? 5 : ~std::uint64_t{0}) * 0x9E3779B97F4A7C15U) & mask;
      std::vector<std::uint32_t> expected(size);
      std::iota(expected.begin(), expected.end(), 0U);
      std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
      ASSERT_EQ(order_of(keys, bits), expected) << size << " keys of " << bits << " bits";
    }
  }
}

}  // namespace
}  // namespace scene_analyzer::primitives
