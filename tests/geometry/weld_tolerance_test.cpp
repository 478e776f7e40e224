#include "geometry/weld_tolerance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>

namespace scene_analyzer::geometry {
namespace {

using Positions = std::vector<float>;
using Random = std::mt19937;

void add(Positions& positions, double x, double y, double z) {
  for (const double value : {x, y, z}) positions.push_back(static_cast<float>(value));
}

// The rule itself: every pair, then whatever is reachable.
std::vector<std::uint32_t> brute_force(const Positions& positions, double tolerance) {
  const auto count = static_cast<std::uint32_t>(positions.size() / 3);
  std::vector<std::uint32_t> lowest(count, UINT32_MAX);
  const auto near = [&](std::uint32_t a, std::uint32_t b) {
    double sum = 0;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const double difference = double{positions[3 * a + axis]} - double{positions[3 * b + axis]};
      sum += difference * difference;
    }
    return std::isfinite(sum) && sum <= tolerance * tolerance;
  };
  for (std::uint32_t start = 0; start < count; ++start) {
    if (lowest[start] != UINT32_MAX) continue;
    lowest[start] = start;
    std::vector<std::uint32_t> open = {start};
    while (!open.empty()) {
      const std::uint32_t from = open.back();
      open.pop_back();
      for (std::uint32_t to = 0; to < count; ++to)
        if (lowest[to] == UINT32_MAX && near(from, to)) {
          lowest[to] = start;
          open.push_back(to);
        }
    }
  }
  return lowest;
}

std::size_t clusters(const std::vector<std::uint32_t>& lowest) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < lowest.size(); ++i) count += lowest[i] == i ? 1 : 0;
  return count;
}

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

struct Shape {
  const char* name;
  std::function<void(Random&, Positions&)> add_point;
};

std::array<double, 3> on_sphere(Random& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> kShapes = {
      {"cube",
       [](Random& r, Positions& p) { add(p, uniform(r, -1, 1), uniform(r, -1, 1), uniform(r, -1, 1)); }},
      {"line", [](Random& r, Positions& p) { add(p, uniform(r, -1, 1), 0, 0); }},
      {"diagonal",
       [](Random& r, Positions& p) {
         const double t = uniform(r, -1, 1);
         add(p, t, t, t);
       }},
      {"plane", [](Random& r, Positions& p) { add(p, uniform(r, -1, 1), uniform(r, -1, 1), 0.25); }},
      {"sphere",
       [](Random& r, Positions& p) {
         const auto s = on_sphere(r);
         add(p, s[0], s[1], s[2]);
       }},
      {"lattice", [](Random& r, Positions& p) { add(p, r() % 8 * 0.25, r() % 8 * 0.25, r() % 8 * 0.25); }},
      {"thirds", [](Random& r, Positions& p) { add(p, r() % 8 / 3.0, r() % 8 / 3.0, r() % 8 / 3.0); }},
      {"lumps",
       [](Random& r, Positions& p) {
         add(p, r() % 3 + uniform(r, -0.02, 0.02), r() % 3 + uniform(r, -0.02, 0.02), uniform(r, 0, 0.01));
       }},
      {"far away",
       [](Random& r, Positions& p) {
         add(p, 1e6 + uniform(r, -1, 1), -3e6 + uniform(r, -1, 1), uniform(r, -1, 1));
       }},
      {"all magnitudes",
       [](Random& r, Positions& p) {
         add(p, std::exp2(uniform(r, -149, 127)), -std::exp2(uniform(r, -149, 127)),
             std::exp2(uniform(r, -60, 60)));
       }},
      {"one place", [](Random&, Positions& p) { add(p, 0.1, -0.2, 0.3); }},
      {"broken",
       [](Random& r, Positions& p) {
         const double odd[] = {0, -0.0, 1, NAN, INFINITY, -INFINITY};
         add(p, odd[r() % 6], odd[r() % 6], uniform(r, 0, 0.1));
       }},
  };
  return kShapes;
}

TEST(WeldTolerance, AgreesWithEveryPairOnRandomClouds) {
  Random random(20260101);
  std::size_t compared = 0, mixed = 0;
  for (const Shape& shape : shapes()) {
    for (const double tolerance :
         {1e-300, 1e-45, 1e-20, 1e-6, 1e-3, 0.01, 0.05, 0.1, 0.25, 1.0 / 3, 0.5, 1.0, 10.0, 1e20, 1e200}) {
      for (const int count : {1, 2, 40, 300}) {
        Positions positions;
        for (int i = 0; i < count; ++i) shape.add_point(random, positions);
        const auto expected = brute_force(positions, tolerance);
        ASSERT_EQ(weld_within(positions, tolerance), expected)
            << shape.name << " " << count << " within " << tolerance;
        const std::size_t found = clusters(expected);
        mixed += found > 1 && found < static_cast<std::size_t>(count) ? 1 : 0;
        ++compared;
      }
    }
  }
  std::printf("%zu clouds compared, %zu with some vertices welded and others not\n", compared, mixed);
  EXPECT_GT(mixed, 100U);
}

// Distances of exactly, just under and just over the tolerance, wherever the grid's lines fall.
TEST(WeldTolerance, TheToleranceItselfIsWithin) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const auto direction = on_sphere(random);
    const double tolerance = std::exp2(uniform(random, -20, 20));
    const double size = tolerance * std::exp2(uniform(random, -3, 12));
    Positions pair;
    const double x = uniform(random, -size, size), y = uniform(random, -size, size),
                 z = uniform(random, -size, size);
    add(pair, x, y, z);
    add(pair, x + tolerance * direction[0], y + tolerance * direction[1], z + tolerance * direction[2]);
    ASSERT_EQ(weld_within(pair, tolerance), brute_force(pair, tolerance)) << i;
  }
  EXPECT_EQ(weld_within(Positions{0, 0, 0, 3, 4, 0}, 5), (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(weld_within(Positions{0, 0, 0, 3, 4, 0}, std::nextafter(5, 0)),
            (std::vector<std::uint32_t>{0, 1}));
}

// Cells large enough for trees: two sets that just miss or just meet each other.
TEST(WeldTolerance, LargeCellsAgreeWithEveryPair) {
  Random random(11);
  std::size_t linked = 0, apart = 0;
  for (int round = 0; round < 60; ++round) {
    Positions positions;
    const double gap = 1 + uniform(random, -0.03, 0.03);
    for (int i = 0; i < 600; ++i) {
      const bool first = random() % 2 == 0;
      const double bend = uniform(random, 0, 0.02);
      add(positions, first ? -bend : gap + bend, uniform(random, 0, 0.4), uniform(random, 0, 0.4));
    }
    const auto expected = brute_force(positions, 1.0);
    (clusters(expected) == 1 ? linked : apart) += 1;
    ASSERT_EQ(weld_within(positions, 1.0), expected) << round;
  }
  EXPECT_GT(linked, 5U);
  EXPECT_GT(apart, 5U);
}

TEST(WeldTolerance, LinksAreTransitive) {
  Positions chain;
  for (int i = 0; i < 1000; ++i) add(chain, 0.9 * ((i * 7) % 1000), 0, 0);
  EXPECT_EQ(weld_within(chain, 1.0), std::vector<std::uint32_t>(1000, 0));
  EXPECT_EQ(clusters(weld_within(chain, 0.89)), 1000U);
}

TEST(WeldTolerance, NonFiniteVerticesStayAlone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Positions positions = {kNan, 0, 0, kNan, 0, 0, kInfinity, 0, 0, kInfinity, 0, 0, 1, 0, 0, -1, 0, 0};
  EXPECT_EQ(weld_within(positions, INFINITY), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 4}));
}

TEST(WeldTolerance, LargestCoordinates) {
  constexpr float kMax = std::numeric_limits<float>::max();
  const Positions positions = {kMax, kMax, kMax, -kMax, -kMax, -kMax, std::nextafter(kMax, 0.0F), kMax, kMax};
  EXPECT_EQ(weld_within(positions, 1e-300), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(weld_within(positions, 1e38), (std::vector<std::uint32_t>{0, 1, 0}));
  EXPECT_EQ(weld_within(positions, 2e39), (std::vector<std::uint32_t>{0, 0, 0}));
}

TEST(WeldTolerance, NothingAndNonsense) {
  EXPECT_TRUE(weld_within({}, 1).empty());
  EXPECT_THROW(weld_within(Positions{0, 0, 0}, 0), std::invalid_argument);
  EXPECT_THROW(weld_within(Positions{0, 0, 0}, -1), std::invalid_argument);
  EXPECT_THROW(weld_within(Positions{0, 0, 0}, NAN), std::invalid_argument);
  EXPECT_THROW(weld_within(Positions{0, 0}, 1), std::invalid_argument);
}

// Many vertices in the worst places, where looking at every pair would take hours.
class WeldToleranceLarge : public testing::Test {
 protected:
#ifdef __SANITIZE_ADDRESS__
  static constexpr int kCount = 100'000;  // everything is many times slower there
#else
  static constexpr int kCount = 1'000'000;
#endif

  static std::vector<std::uint32_t> timed(const char* what, const Positions& positions, double tolerance) {
    const auto start = std::chrono::steady_clock::now();
    auto result = weld_within(positions, tolerance);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%-40s %7.0f ms, %zu clusters\n", what, 1000 * seconds.count(), clusters(result));
    EXPECT_LT(seconds.count(), 60)
        << what;  // tens of times what it takes here, far from what every pair would
    return result;
  }

  static Positions cloud(const std::function<void(Random&, Positions&)>& add_point, int count = kCount) {
    Random random(3);
    Positions positions;
    positions.reserve(3 * static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) add_point(random, positions);
    return positions;
  }
};

TEST_F(WeldToleranceLarge, AnyTolerance) {
  const Positions cube = cloud(shapes()[0].add_point);
  EXPECT_EQ(clusters(timed("cube, larger than the mesh", cube, 100)), 1U);
  EXPECT_EQ(clusters(timed("cube, a quarter of the mesh", cube, 0.5)), 1U);
  timed("cube, near the spacing", cube, 0.01);
  timed("cube, below the spacing", cube, 1e-5);
  timed("cube, below the spacing of floats", cube, 1e-40);
  timed("line", cloud(shapes()[1].add_point), 1e-6);
  timed("sphere", cloud(shapes()[4].add_point), 1e-3);
}

TEST_F(WeldToleranceLarge, OnePlace) {
  EXPECT_EQ(clusters(timed("one place", cloud(shapes()[10].add_point), 1e-6)), 1U);
}

// Two crowded cells that are two columns apart and miss each other by a little, everywhere.
TEST_F(WeldToleranceLarge, ParallelSheetsThatMiss) {
  const Positions sheets = cloud([](Random& random, Positions& p) {
    const double thickness = uniform(random, 0, 1e-3);
    add(p, random() % 2 == 0 ? -thickness : 1 + 2e-7 + thickness, uniform(random, 0, 0.5),
        uniform(random, 0, 0.5));
  });
  EXPECT_EQ(clusters(timed("sheets that miss", sheets, 1.0)), 2U);
}

// Every pair of the two sets is just beyond the tolerance: a crowd in the centre of a shell.
TEST_F(WeldToleranceLarge, CrowdInTheCentreOfAShell) {
  const Positions shell = cloud([](Random& random, Positions& p) {
    const auto s = on_sphere(random);
    const double r = random() % 2 == 0 ? 1e-7 * uniform(random, 0, 1) : 1 + 1e-6;
    add(p, r * s[0], r * s[1], r * s[2]);
  });
  EXPECT_EQ(clusters(timed("crowd within a shell", shell, 1.0)), 2U);
}

// An axis and a ring around it: every point of the ring is as near to the middle of the axis. The slowest
// known.
TEST_F(WeldToleranceLarge, AxisAndRing) {
  const Positions ring = cloud(
      [](Random& random, Positions& p) {
        const double angle = uniform(random, 0, 2 * std::numbers::pi);
        if (random() % 2 == 0)
          add(p, 0, 0, uniform(random, -0.1, 0.1));
        else
          add(p, (1 + 1e-6) * std::cos(angle), (1 + 1e-6) * std::sin(angle), 0);
      },
      kCount / 4);
  EXPECT_EQ(clusters(timed("axis and ring", ring, 1.0)), 2U);
}

}  // namespace
}  // namespace scene_analyzer::geometry
