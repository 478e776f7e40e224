#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/fixture.h"

namespace scene_analyzer::report {
namespace {

using nlohmann::ordered_json;
using Table = std::vector<std::vector<std::string>>;

// An RFC 4180 reader of its own.
Table read_csv(const std::string& text) {
  Table rows;
  std::vector<std::string> row;
  std::string cell;
  bool in_quotes = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_quotes && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      cell.push_back(text[++i]);
    else if (c == '"')
      in_quotes = !in_quotes;
    else if (!in_quotes && (c == ',' || c == '\n')) {
      row.push_back(cell);
      cell.clear();
      if (c == '\n') rows.push_back(std::exchange(row, {}));
    } else
      cell.push_back(c);
  }
  EXPECT_FALSE(in_quotes);
  EXPECT_TRUE(row.empty() && cell.empty());
  return rows;
}

// The JSON value that a column's dotted name leads to.
ordered_json value_at(ordered_json value, std::string name) {
  for (std::size_t dot = 0; dot != std::string::npos && !value.is_null(); name = name.substr(dot + 1)) {
    dot = name.find('.');
    const std::string key = name.substr(0, dot);
    ordered_json child = value.is_array() ? value.at(static_cast<std::size_t>(key[0] - 'x')) : value.at(key);
    value = std::move(child);
    if (dot == std::string::npos) break;
  }
  return value;
}

TEST(Csv, HoldsExactlyTheJson) {
  const Fixture fixture = two_assets();
  const SceneReport report = fixture.report();
  const Table rows = read_csv(csv(report));
  const ordered_json meshes = ordered_json::parse(json(report))["meshes"];
  ASSERT_EQ(rows.size(), 1 + meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    ASSERT_EQ(rows[i + 1].size(), rows[0].size());
    for (std::size_t column = 0; column < rows[0].size(); ++column) {
      const ordered_json value = value_at(meshes[i], rows[0][column]);
      const std::string expected = value.is_null()     ? ""
                                   : value.is_string() ? value.get<std::string>()
                                                       : value.dump();
      EXPECT_EQ(rows[i + 1][column], expected) << rows[0][column] << " of mesh " << i;
    }
  }
}

TEST(Csv, HasAColumnForEveryField) {
  const Fixture fixture;
  const std::string text = csv(fixture.report());
  const Table rows = read_csv(text);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].size(),
            20 + 4 + 5 + 10 + 12 + 2 * 7 + 5u);  // 20 plain with signal, bounds and rendering time as one
                                                 // each, 4, 5 and 10 more for them, 12 defects, 2 x 7
                                                 // ratings, 5
  EXPECT_THAT(
      text, ::testing::StartsWith("index,asset,node,mesh,source_triangles,degenerate_triangles,triangles,"));
  EXPECT_THAT(text, ::testing::HasSubstr(",area_classes,defects.counts.degenerate_by_index,"));
  EXPECT_THAT(text, ::testing::HasSubstr(",defects.counts.far_from_origin,signal.length,signal.start_"
                                         "triangle,signal.mean_distance,signal.gap,"
                                         "signal.searches,rendering_time.device,rendering_time.device_type,"
                                         "rendering_time.mean_ns,rendering_time.confidence_ns,"));
  EXPECT_THAT(text, ::testing::HasSubstr(",bounds.min.x,bounds.min.y,"));
  EXPECT_THAT(text, ::testing::HasSubstr(",bounds.max.z,distance,ratings.polygons_per_planar_group,"));
  EXPECT_THAT(text, ::testing::HasSubstr(
                        ",relative_ratings.rendering_time,aggregate,color,not_analysed,no_fourier_transform,"
                        "no_rendering_time\n"));
}

TEST(Csv, CountsDefectsAndLeavesTheirPlacesOut) {
  const Fixture fixture = two_assets();
  const Table rows = read_csv(csv(fixture.report()));
  const auto column = std::ranges::find(rows[0], "defects.counts.inconsistent_winding") - rows[0].begin();
  ASSERT_LT(static_cast<std::size_t>(column), rows[0].size());
  EXPECT_EQ(rows[1].at(static_cast<std::size_t>(column)), "12");
  EXPECT_EQ(rows[3].at(static_cast<std::size_t>(column)), "") << "a mesh without triangles";
  for (const std::string& name : rows[0]) EXPECT_THAT(name, ::testing::Not(::testing::HasSubstr("places")));
}

TEST(Csv, QuotesCommasQuotesAndLineBreaks) {
  const Fixture fixture = two_assets();
  EXPECT_THAT(csv(fixture.report()),
              ::testing::HasSubstr(",\"say \"\"hi\"\", \x1b[31mred\x1b[0m\nnew\xef\xbf\xbd line "));
}

}  // namespace
}  // namespace scene_analyzer::report
