// Texts of options: a value within its range, or UsageError. The first byte says which option.
#include "cli/option_parsing.h"

#include <cmath>

#include "base/error.h"
#include "target.h"

namespace scene_analyzer::fuzz {

std::vector<std::string> seeds() {
  return {
      "\x01"
      "-12.5",
      "\x01"
      "1e3",
      "\x02"
      "20000",
      "\x03"
      "1,-2.5,3e2",
      "\x04"
      "1280x720",
      "\x05polygons_per_planar_group,distance",
      "\x06"
      "distance=1,relative_density=0.5",
      "\x07"
      "1.5G",
      "\x07"
      "4096",
      "\x08relative_densty"};
}

namespace {

void parse(unsigned which, std::string_view text) {
  switch (which) {
    case 1: {
      const double value = cli::parse_number("alpha", text, -100, 180, "degrees");
      require(value >= -100 && value <= 180, "a number lies in its range");
      break;
    }
    case 2: {
      const std::uint64_t value = cli::parse_integer("dim", text, 2, 4294967295);
      require(value >= 2 && value <= 4294967295, "a whole number lies in its range");
      break;
    }
    case 3:
      for (const double value : cli::parse_vector3("eye", text))
        require(std::isfinite(value), "points are finite");
      break;
    case 4: {
      const auto [width, height] = cli::parse_pixels("size", text);
      require(width >= 1 && width <= 16384 && height >= 1 && height <= 16384, "pictures have a size");
      break;
    }
    case 5:
      require(cli::parse_metrics("metrics", text).any(), "some metric is named");
      break;
    case 6: {
      double sum = 0;
      for (const double weight : cli::parse_weights("weights", text)) {
        require(weight >= 0 && std::isfinite(weight), "weights are at least 0");
        sum += weight;
      }
      require(sum > 0, "some weight is above 0");
      break;
    }
    case 7:
      require(cli::parse_size("max-size", text) <= std::uint64_t{1} << 60, "sizes have an end");
      break;
    default:
      cli::nearest(text, std::vector<std::string>{"", "a", "relative_density", std::string(300, 'x')});
  }
}

}  // namespace
}  // namespace scene_analyzer::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scene_analyzer;
  if (size == 0) return 0;
  try {
    fuzz::parse(data[0], fuzz::text_of(data + 1, size - 1));
  } catch (const UsageError& error) {
    fuzz::require(std::string_view(error.what()).starts_with("--"), "a refusal names the option");
  }
  return 0;
}
