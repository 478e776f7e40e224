#include <gmock/gmock.h>
#include <sys/stat.h>

#include "analysis_file/codec.h"
#include "analysis_file/envelope.h"
#include "analysis_file/sample.h"
#include "base/error.h"
#include "base/version.h"

namespace scene_analyzer::analysis_file {
namespace {

using testing::HasSubstr;

// An asset with a buffer that is there and a material library that is not.
class Stale : public FolderTest {
 protected:
  Stale() {
    fs::create_directory(folder / "sub");
    write_text(asset, "asset");
    write_text(folder / "sub/x.bin", "buffer");
    analysis = full_analysis();
    analysis.files = fingerprint(asset, {{"room.gltf", true}, {"sub/x.bin", true}, {"lost.mtl", false}});
    store(file, analysis);
  }

  // Why the file cannot be used; "" when it can.
  std::string reason(const analysis::Parameters& parameters) {
    const auto loaded = load_valid(file, asset, parameters);
    const auto* unusable = std::get_if<Unusable>(&loaded);
    return unusable != nullptr ? unusable->reason : "";
  }
  std::string reason() { return reason(analysis.parameters); }

  fs::path asset = folder / "room.gltf";
  fs::path file = folder / "room.gltf.analysis";
  analysis::AssetAnalysis analysis;
};

TEST_F(Stale, UnchangedIsValidAndCarriesThePathAsGivenNow) {
  const auto loaded = load_valid(file, asset, analysis.parameters);
  ASSERT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(loaded)) << reason();
  auto expected = analysis;
  expected.asset = asset.string();
  expect_same(std::get<analysis::AssetAnalysis>(loaded), expected);
}

TEST_F(Stale, ChangedAssetIsNoticedEvenAtTheSameSize) {
  write_text(asset, "Asset");
  EXPECT_THAT(reason(), HasSubstr("'room.gltf' has changed"));
  write_text(asset, "asset");
  EXPECT_EQ(reason(), "");
}

TEST_F(Stale, ChangedReferenceIsNoticed) {
  write_text(folder / "sub/x.bin", "Buffer");
  EXPECT_THAT(reason(), HasSubstr("'sub/x.bin' has changed"));
  fs::remove(folder / "sub/x.bin");
  EXPECT_THAT(reason(), HasSubstr("'sub/x.bin' is missing"));
}

TEST_F(Stale, MissingReferenceThatAppearsIsNoticed) {
  write_text(folder / "lost.mtl", "");
  EXPECT_THAT(reason(), HasSubstr("'lost.mtl', missing before, is there now"));
}

TEST_F(Stale, EachParameterCounts) {
  auto other = analysis.parameters;
  other.alpha_degrees = 1;
  EXPECT_THAT(reason(other), HasSubstr("alpha 12.5 instead of 1"));
  other = analysis.parameters;
  other.dim = 301;
  EXPECT_THAT(reason(other), HasSubstr("dim 300 instead of 301"));
  other = analysis.parameters;
  other.weld_tolerance = 0;
  EXPECT_THAT(reason(other), HasSubstr("weld tolerance 1e-07 instead of 0"));
}

TEST_F(Stale, RotationsAreTheRenderingTimesOwn) {
  auto other = analysis.parameters;
  other.steps = 9;
  EXPECT_EQ(reason(other), "");
  const auto loaded = std::get<analysis::AssetAnalysis>(load_valid(file, asset, other));
  EXPECT_EQ(loaded.parameters, other);
  EXPECT_EQ(loaded.timings.at(0).conditions.steps, 4U);
}

TEST_F(Stale, StartSearchesCountOnceTheFourierRatingWasComputed) {
  auto other = analysis.parameters;
  other.start_searches = 7;
  EXPECT_EQ(reason(other), "");
  EXPECT_EQ(std::get<analysis::AssetAnalysis>(load_valid(file, asset, other)).parameters, other);
  analysis.computed.set(analysis::index_of(analysis::Metric::kFourierTransform));
  store(file, analysis);
  EXPECT_EQ(reason(), "");
  EXPECT_THAT(reason(other), HasSubstr("start searches 5000000002 instead of 7"));
}

TEST_F(Stale, AFileFromBeforeStartSearchesIsStillGood) {
  analysis.parameters.start_searches = 0;  // what an absent field is read as
  store(file, analysis);
  EXPECT_EQ(reason(), "");
  EXPECT_EQ(content_key(analysis), [&] {
    auto now = analysis;
    now.parameters.start_searches = 20000;
    return content_key(now);
  }());
}

TEST_F(Stale, OtherProgramVersionIsNoticed) {
  write_text(file, seal(encode(analysis, "0.0.1-other")));
  EXPECT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(load(file))) << "readable, only not current";
  EXPECT_THAT(reason(), HasSubstr("version 0.0.1-other"));
}

TEST_F(Stale, AnotherAssetsFileIsNoticed) {
  const fs::path copy = folder / "copy.gltf";
  fs::copy_file(asset, copy);
  const auto loaded = load_valid(file, copy, analysis.parameters);
  EXPECT_THAT(std::get<Unusable>(loaded).reason, HasSubstr("another asset"));
}

TEST_F(Stale, VanishedAssetIsNoCrash) {
  fs::remove(asset);
  EXPECT_THAT(reason(), HasSubstr("cannot be compared with its asset"));
}

TEST_F(Stale, UseIsRemembered) {
  const auto old = fs::last_write_time(file) - std::chrono::hours(100);
  fs::last_write_time(file, old);
  EXPECT_TRUE(std::holds_alternative<analysis::AssetAnalysis>(load(file)));
  EXPECT_EQ(fs::last_write_time(file), old) << "only a hit is a use";
  EXPECT_EQ(reason(), "");
  EXPECT_GT(fs::last_write_time(file), old + std::chrono::hours(99));
}

TEST_F(Stale, KeyDependsOnFilesParametersAndNothingElse) {
  const std::string key = content_key(analysis);
  EXPECT_EQ(key.size(), 32u);
  EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos);
  auto other = analysis;
  other.asset = "elsewhere";
  other.warnings.clear();
  other.geometries.clear();
  EXPECT_EQ(content_key(other), key);
  other.files[2].found = true;
  EXPECT_NE(content_key(other), key);
  other = analysis;
  other.parameters.alpha_degrees += 1e-12;
  EXPECT_NE(content_key(other), key);
  EXPECT_NE(content_key_of(analysis, "other"), key);
  other = analysis;
  other.computed.set(analysis::index_of(analysis::Metric::kFourierTransform));
  const std::string with_signal = content_key(other);
  EXPECT_NE(with_signal, key);
  ++other.parameters.start_searches;
  EXPECT_NE(content_key(other), with_signal);
}

TEST_F(Stale, FingerprintsAreXxh3AndListEachFileOnce) {
  const auto files =
      fingerprint(asset, {{"room.gltf", true}, {"sub/x.bin", true}, {"sub/x.bin", true}, {"", true}});
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].path, "room.gltf");
  EXPECT_EQ(files[0].size, 5u);
  EXPECT_EQ(files[1].path, "sub/x.bin");
  write_text(asset, "");  // XXH3-128 of nothing, a published constant
  EXPECT_EQ(fingerprint(asset, {})[0].hash,
            (std::array<std::uint64_t, 2>{0x6001c324468d497f, 0x99aa06d3014798d8}));
}

TEST_F(Stale, LargeFilesAreStreamedToTheSameHash) {
  std::string large(5 * 1024 * 1024 + 17, '\0');
  for (std::size_t i = 0; i < large.size(); ++i) large[i] = static_cast<char>(i * 2654435761u >> 13);
  write_text(asset, large);
  const auto before = fingerprint(asset, {})[0];
  EXPECT_EQ(before.size, large.size());
  large.back() ^= 1;
  write_text(asset, large);
  EXPECT_NE(fingerprint(asset, {})[0].hash, before.hash);
}

TEST_F(Stale, ReferencesNeverOpenDevicesOrLeaveTheFolderUnasked) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/zero", folder / "zero");
  write_text(folder / "outside.bin", "secret");
  const fs::path inner = folder / "sub" / "a.gltf";
  write_text(inner, "inner");
  EXPECT_FALSE(fingerprint(asset, {{"pipe", true}})[1].found);
  EXPECT_FALSE(fingerprint(asset, {{"zero", true}})[1].found);
  EXPECT_FALSE(fingerprint(asset, {{"sub", true}})[1].found);
  EXPECT_FALSE(fingerprint(asset, {{std::string("sub/x.bin\0", 10), true}})[1].found);
  EXPECT_FALSE(fingerprint(inner, {{"../outside.bin", false}})[1].found);
  EXPECT_FALSE(fingerprint(inner, {{"y/../../outside.bin", false}})[1].found);
  EXPECT_FALSE(fingerprint(inner, {{(folder / "outside.bin").string(), false}})[1].found);
  EXPECT_TRUE(fingerprint(inner, {{"../outside.bin", true}})[1].found) << "the import was given it";
  EXPECT_TRUE(fingerprint(asset, {{"sub/../outside.bin", false}})[1].found) << "does not leave the folder";
}

TEST_F(Stale, UnreadableAssetIsNamed) {
  for (const fs::path& bad : {folder / "absent.obj", folder, fs::path("/dev/null")}) {
    try {
      fingerprint(bad, {});
      FAIL() << bad;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(bad.string()));
    }
  }
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
