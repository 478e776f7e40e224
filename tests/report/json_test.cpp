#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/fixture.h"

namespace scene_analyzer::report {
namespace {

using nlohmann::ordered_json;

ordered_json parsed(const SceneReport& report) {
  return ordered_json::parse(json(report));
}

std::vector<std::string> keys_of(const ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

// Exit status of the validator over one document; its findings go to the test's output.
int validate(const std::string& document) {
  const TemporaryFolder folder;
  write_file(folder.path / "report.json", document);
  const std::string source = SCENE_ANALYZER_SOURCE_DIR;
  const std::string command = "/usr/bin/python3 '" + source + "/tests/report/validate_report.py' '" + source +
                              "/docs/schema/report-v1.schema.json' '" +
                              (folder.path / "report.json").string() + "'";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Json, HasItsFieldsInOrder) {
  const Fixture fixture = two_assets();
  const ordered_json document = parsed(fixture.report());
  EXPECT_EQ(keys_of(document), (std::vector<std::string>{"schema_version", "tool", "parameters",
                                                         "render_timing", "scene", "assets", "meshes"}));
  EXPECT_EQ(document["schema_version"], 1);
  const ordered_json tool = {{"version", "0.1.0"},
                             {"device", "llvmpipe (LLVM 15)"},
                             {"driver", "Mesa 22.3.6"},
                             {"device_type", "cpu"}};
  EXPECT_EQ(document["tool"], tool);
  EXPECT_EQ(document["parameters"]["weights"]["distance"], 1.0);
  const ordered_json timing = {{"device", "llvmpipe (LLVM 15)"},
                               {"driver", "Mesa 22.3.6"},
                               {"device_type", "cpu"},
                               {"device_id", "12ab, a processor"},
                               {"width", 640},
                               {"height", 480},
                               {"steps", 8},
                               {"timestamp_period_ns", 1.0}};
  EXPECT_EQ(document["render_timing"], timing);
  EXPECT_EQ(document["parameters"]["metrics"].size(), 7u);
  EXPECT_TRUE(document["parameters"]["eye"].is_null());
  EXPECT_EQ(document["scene"]["mesh_count"], 5);
  EXPECT_EQ(document["scene"]["unique_triangles"], 80);
  EXPECT_EQ(document["scene"]["drawn_triangles"], 120);
  EXPECT_EQ(document["assets"][0]["unit_scale"], 1.0);
  EXPECT_TRUE(document["assets"][1]["up_axis"].is_null());
  EXPECT_EQ(document["assets"][0]["warnings"].size(), 1u);
}

TEST(Json, SaysWhyARenderingTimeIsMissing) {
  Fixture fixture = two_assets();
  analysis::RenderingTime& time = fixture.assets[1].timings[0].times[1];
  time = {};
  time.not_measured = "the device's timestamps ran backwards";
  const ordered_json mesh = parsed(fixture.report())["meshes"][4];
  EXPECT_TRUE(mesh["rendering_time"].is_null());
  EXPECT_TRUE(mesh["ratings"]["rendering_time"].is_null());
  EXPECT_EQ(mesh["no_rendering_time"], time.not_measured);
}

TEST(Json, PrintsAMeshWithNumbersAsNumbers) {
  const Fixture fixture = two_assets();
  const SceneReport report = fixture.report();
  const ordered_json mesh = parsed(report)["meshes"][1];
  EXPECT_EQ(mesh["index"], 1);
  EXPECT_EQ(mesh["asset"], "models/room.glb");
  EXPECT_EQ(mesh["node"], "leg right");
  EXPECT_EQ(mesh["source_triangles"], 41);
  EXPECT_EQ(mesh["degenerate_triangles"], 1);
  EXPECT_EQ(mesh["triangles"], 40);
  EXPECT_EQ(mesh["planar_groups"], 12);
  EXPECT_EQ(mesh["largest_planar_group"], 10);
  EXPECT_EQ(mesh["area_classes"], 2);
  EXPECT_EQ(mesh["surface_area"], 1.0);
  EXPECT_EQ(mesh["density"], 40.0);
  EXPECT_EQ(mesh["bounds"]["min"], ordered_json::parse("[3.0, 0.0, 0.0]"));
  EXPECT_EQ(mesh["ratings"]["cooccurrence_contrast"].get<double>(), 1.0 / 3);  // every digit
  EXPECT_EQ(mesh["ratings"]["fourier_transform"], 0.09168);
  EXPECT_EQ(mesh["ratings"]["rendering_time"], 0);
  EXPECT_EQ(mesh["rendering_time"]["device_type"], "cpu");
  EXPECT_EQ(mesh["rendering_time"]["mean_ns"], 1500.0);
  EXPECT_EQ(mesh["rendering_time"]["confidence_ns"], 12.5);
  EXPECT_EQ(mesh["rendering_time"]["rounds"], 7);
  EXPECT_TRUE(mesh["rendering_time"]["overdraw"].is_null());
  EXPECT_TRUE(mesh["no_rendering_time"].is_null());
  EXPECT_EQ(mesh["aggregate"].get<double>(), *report.rating.meshes[1].aggregate);
  EXPECT_EQ(mesh["color"], ratings::to_hex(ratings::color(*report.rating.meshes[1].aggregate)));
  EXPECT_TRUE(mesh["not_analysed"].is_null());
}

TEST(Json, ListsEveryKindOfDefectWithItsPlaces) {
  const Fixture fixture = two_assets();
  const ordered_json meshes = parsed(fixture.report())["meshes"];
  const ordered_json& defects = meshes[0]["defects"];
  EXPECT_EQ(keys_of(defects), (std::vector<std::string>{"counts", "places"}));
  const std::vector<std::string> kinds(analysis::kDefectKeys.begin(), analysis::kDefectKeys.end());
  EXPECT_EQ(keys_of(defects["counts"]), kinds);
  EXPECT_EQ(keys_of(defects["places"]), std::vector<std::string>(kinds.begin(), kinds.end() - 2))
      << "a whole mesh has no place";
  EXPECT_EQ(defects["counts"]["degenerate_by_shape"], 1);
  EXPECT_EQ(defects["counts"]["inconsistent_winding"], 12);
  EXPECT_EQ(defects["counts"]["far_from_origin"], 1);
  EXPECT_EQ(defects["counts"]["zero_area"], 0);
  EXPECT_EQ(defects["places"]["inconsistent_winding"], ordered_json::parse("[0, 1, 4, 5, 8, 9, 20, 33]"));
  EXPECT_EQ(defects["places"]["mergeable_vertices"], ordered_json::parse("[21, 22, 23]"));
  EXPECT_EQ(defects["places"]["boundary_edges"], ordered_json::array());
  EXPECT_TRUE(meshes[2]["defects"].is_null()) << "no triangles";
  EXPECT_TRUE(meshes[3]["defects"].is_null()) << "not analysed";
}

TEST(Json, PrintsTheSignalInWorldUnits) {
  Fixture fixture = two_assets();
  fixture.assets[0].geometries[0].signal->gap = 0.0125;
  const ordered_json document = parsed(fixture.report());
  EXPECT_EQ(document["parameters"]["start_searches"], 20000);
  const ordered_json& meshes = document["meshes"];
  EXPECT_EQ(keys_of(meshes[0]["signal"]),
            (std::vector<std::string>{"length", "start_triangle", "mean_distance", "gap", "searches"}));
  const ordered_json scaled = {
      {"length", 40}, {"start_triangle", 17}, {"mean_distance", 0.7}, {"gap", 0.0125}, {"searches", 23}};
  EXPECT_EQ(meshes[1]["signal"], scaled) << "an instance twice as large";
  EXPECT_EQ(meshes[0]["signal"]["mean_distance"], 0.35);
  EXPECT_TRUE(meshes[2]["signal"].is_null());
  EXPECT_TRUE(meshes[3]["signal"].is_null());
}

TEST(Json, ASignalOfNothingHasNoStart) {
  Fixture fixture = two_assets();
  fixture.assets[0].geometries[0].signal = analysis::SignalSummary();
  const std::string text = json(fixture.report());
  const ordered_json signal = ordered_json::parse(text)["meshes"][0]["signal"];
  EXPECT_EQ(signal["length"], 0);
  EXPECT_TRUE(signal["start_triangle"].is_null());
  EXPECT_TRUE(signal["mean_distance"].is_null());
  EXPECT_EQ(validate(text), 0);
}

TEST(Json, TheFourierRatingHasItsColor) {
  Fixture fixture = two_assets();
  fixture.options.weights = {0, 0, 0, 0, 0, 1, 0};
  fixture.assets[0].geometries[0].fourier_transform = 1;
  fixture.assets[1].geometries[1].fourier_transform = 0.5;
  const ordered_json meshes = parsed(fixture.report())["meshes"];
  EXPECT_EQ(meshes[0]["color"], "#ff0000");
  EXPECT_EQ(meshes[4]["color"], "#ffff00");
  EXPECT_EQ(meshes[4]["relative_ratings"]["fourier_transform"], 0);
}

TEST(Json, PrintsAbsentFiguresAsNull) {
  const Fixture fixture = two_assets();
  const ordered_json meshes = parsed(fixture.report())["meshes"];
  EXPECT_EQ(meshes[2]["triangles"], 0);  // counted: there are none
  EXPECT_TRUE(meshes[2]["aggregate"].is_null());
  EXPECT_TRUE(meshes[2]["color"].is_null());
  EXPECT_TRUE(meshes[2]["bounds"].is_null());
  EXPECT_EQ(meshes[3]["source_triangles"], 900'000'000);
  EXPECT_TRUE(meshes[3]["triangles"].is_null());  // unknown: beyond the device
  EXPECT_TRUE(meshes[3]["surface_area"].is_null());
  EXPECT_THAT(meshes[3]["not_analysed"].get<std::string>(), ::testing::HasSubstr("40 GiB"));
}

TEST(Json, SaysWhyOneRatingIsMissing) {
  Fixture fixture = two_assets();
  EXPECT_TRUE(parsed(fixture.report())["meshes"][0]["no_fourier_transform"].is_null());
  fixture.assets[0].geometries[0].fourier_transform.reset();
  fixture.assets[0].geometries[0].signal.reset();
  fixture.assets[0].geometries[0].no_fourier_transform = "a signal has 3 samples, but 2 are the most";
  const ordered_json mesh = parsed(fixture.report())["meshes"][0];
  EXPECT_EQ(mesh["no_fourier_transform"], "a signal has 3 samples, but 2 are the most");
  EXPECT_TRUE(mesh["ratings"]["fourier_transform"].is_null());
  EXPECT_TRUE(mesh["not_analysed"].is_null());
  EXPECT_FALSE(mesh["aggregate"].is_null());
}

TEST(Json, NeverPrintsWhatIsNotANumber) {
  Fixture fixture = two_assets();
  const double infinity = std::numeric_limits<double>::infinity();
  fixture.assets[0].instances[0].bounds->max[1] = infinity;
  fixture.assets[0].instances[1].area_scale = infinity;
  fixture.assets[0].geometries[0].cooccurrence_contrast = std::numeric_limits<double>::quiet_NaN();
  const std::string text = json(fixture.report());
  const ordered_json meshes = ordered_json::parse(text)["meshes"];
  EXPECT_TRUE(meshes[0]["bounds"].is_null());
  EXPECT_TRUE(meshes[1]["surface_area"].is_null());
  EXPECT_TRUE(meshes[1]["density"].is_null());
  EXPECT_EQ(text.find("-0.0"), std::string::npos);  // the fixture's bounds have one
  EXPECT_EQ(validate(text), 0);
}

TEST(Json, KeepsHostileNamesAndReplacesBrokenUtf8) {
  const Fixture fixture = two_assets();
  const std::string text = json(fixture.report());
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(ordered_json::parse(text)["meshes"][4]["mesh"],
            "say \"hi\", \x1b[31mred\x1b[0m\nnew\xef\xbf\xbd line \xc3\xa4\xe6\xbc\xa2");
}

TEST(Json, IsDeterministicAndEndsItsLine) {
  const Fixture fixture = two_assets();
  const std::string text = json(fixture.report());
  EXPECT_EQ(text, json(fixture.report()));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(text, ordered_json::parse(text).dump(2) + "\n");  // indented like one document
}

TEST(Json, NamesTheDeviceOfTheAnalysisFilesWhenNothingWasComputed) {
  Fixture fixture = two_assets();
  for (auto& asset : fixture.assets) asset.device = {"GPU", "1.2", "discrete"};
  SceneReport report = fixture.report();
  report.device = {};
  EXPECT_EQ(parsed(report)["tool"]["device"], "GPU");
  fixture.assets[1].device.driver = "1.3";
  report = fixture.report();
  report.device = {};
  EXPECT_TRUE(parsed(report)["tool"]["device"].is_null());
  EXPECT_TRUE(parsed(report)["tool"]["device_type"].is_null());
}

TEST(Json, ColorFollowsRelativeModeAndSignedDensity) {
  Fixture fixture = two_assets();
  fixture.options.metrics.reset().set(analysis::index_of(analysis::Metric::kRelativeDensity));
  fixture.options.relative = true;
  const ordered_json meshes = parsed(fixture.report())["meshes"];
  EXPECT_EQ(meshes[1]["aggregate"], -1.0);
  EXPECT_EQ(meshes[1]["color"], "#0000ff");
  EXPECT_EQ(meshes[0]["color"], "#ff0000");
}

TEST(Schema, AcceptsRealReports) {
  Fixture fixture = two_assets();
  EXPECT_EQ(validate(json(fixture.report())), 0);
  fixture.options.relative = true;
  fixture.options.eye = mesh::Vector3{1, 2, 3};
  fixture.options.weights = {0, 0.5, 2, 0, 0, 0, 0};
  fixture.options.metrics.reset().set(2);
  EXPECT_EQ(validate(json(fixture.report())), 0);
  EXPECT_EQ(validate(json(Fixture().report())), 0);  // a scene of nothing
}

TEST(Schema, RefusesWhatIsNotTheReport) {
  const Fixture fixture = two_assets();
  const ordered_json good = parsed(fixture.report());
  const auto faulty = [&](const std::string& pointer, const ordered_json& value) {
    ordered_json document = good;
    document[ordered_json::json_pointer(pointer)] = value;
    return validate(document.dump());
  };
  EXPECT_EQ(validate(good.dump()), 0);
  EXPECT_EQ(faulty("/meshes/0/triangles", "40"), 1);  // a number as a string
  EXPECT_EQ(faulty("/meshes/0/ratings/distance", 1.5), 1);
  EXPECT_EQ(faulty("/meshes/0/ratings/new_metric", 0.5), 1);
  EXPECT_EQ(faulty("/meshes/0/surprise", 1), 1);
  EXPECT_EQ(faulty("/meshes/0/signal/surprise", 1), 1);
  EXPECT_EQ(faulty("/meshes/0/signal/gap", -0.1), 1);
  EXPECT_EQ(faulty("/meshes/0/signal/length", 1.5), 1);
  EXPECT_EQ(faulty("/meshes/0/defects/counts/zero_area", 2), 1);
  EXPECT_EQ(faulty("/meshes/0/defects/counts/boundary_edges", -1), 1);
  EXPECT_EQ(faulty("/meshes/0/defects/counts/surprise", 0), 1);
  EXPECT_EQ(faulty("/meshes/0/defects/places/boundary_edges", {1, 2, 3, 4, 5, 6, 7, 8, 9}), 1);
  EXPECT_EQ(faulty("/meshes/0/defects/places/far_from_origin", {1}), 1);
  EXPECT_EQ(faulty("/parameters/start_searches", 0), 1);
  EXPECT_EQ(faulty("/scene/surprise", 1), 1);
  EXPECT_EQ(faulty("/meshes/0/color", "red"), 1);
  EXPECT_EQ(faulty("/schema_version", 2), 1);
  ordered_json missing = good;
  missing["meshes"][0].erase("density");
  EXPECT_EQ(validate(missing.dump()), 1);
}

TEST(Json, OfManyMeshesIsWhole) {
  const Fixture fixture = many_instances(5'000);
  const SceneReport report = fixture.report();
  EXPECT_EQ(nlohmann::json::parse(json(report))["meshes"].size(), 5'000u);
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(lines(csv(report)), 5'001);
  EXPECT_GT(lines(table(report, {.color = true})), 3);
}

}  // namespace
}  // namespace scene_analyzer::report
