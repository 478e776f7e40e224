#include <gmock/gmock.h>

#include <cstdio>
#include <functional>

#include "analysis_file/codec.h"
#include "analysis_file/envelope.h"
#include "analysis_file/little_endian.h"
#include "analysis_file/sample.h"
#include "base/version.h"
#include "scene_analyzer/v1/analysis.pb.h"

namespace scene_analyzer::analysis_file {
namespace {

using testing::HasSubstr;

v1::Defect& defect(v1::Analysis& message, int which) {
  return *message.mutable_geometries(0)->mutable_defects()->mutable_found(which);
}

class Damaged : public FolderTest {
 protected:
  Damaged() {
    store(file, full_analysis());
    whole = read_text(file);
  }

  // Why load() refuses `bytes`; "" when it does not.
  std::string reason_for(const std::string& bytes) {
    fs::remove(
        file);  // some file systems sync a file that is truncated and written again, thousands of times here
    write_text(file, bytes);
    const auto loaded = load(file);
    const auto* unusable = std::get_if<Unusable>(&loaded);
    if (unusable == nullptr) return "";
    EXPECT_FALSE(unusable->absent);
    EXPECT_FALSE(unusable->reason.empty());
    return unusable->reason;
  }

  // The same for a payload under a right checksum, changed through protobuf.
  std::string reason_after(const std::function<void(v1::Analysis&)>& change) {
    v1::Analysis message;
    EXPECT_TRUE(message.ParseFromString(encode(full_analysis(), version())));
    change(message);
    return reason_for(seal(message.SerializeAsString()));
  }

  fs::path file = folder / "x.analysis";
  std::string whole;
};

TEST_F(Damaged, EveryFlippedByteIsNoticed) {
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int mask : {0x01, 0x80, 0xFF}) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(bytes[i] ^ mask);
      ASSERT_NE(reason_for(bytes), "") << "byte " << i << " mask " << mask;
    }
  }
  EXPECT_EQ(reason_for(whole), "") << "the undamaged file is still good";
}

// All 255 other values of every byte, without the file system.
TEST_F(Damaged, EveryValueOfEveryByteIsNoticed) {
  ASSERT_TRUE(std::holds_alternative<std::string_view>(unseal(whole)));
  std::string bytes = whole;
  std::size_t changes = 0;
  for (char& byte : bytes) {
    const char right = byte;
    for (int mask = 1; mask < 256; ++mask, ++changes) {
      byte = static_cast<char>(right ^ mask);
      const auto unsealed = unseal(bytes);
      ASSERT_TRUE(std::holds_alternative<Unusable>(unsealed))
          << "byte " << &byte - bytes.data() << " mask " << mask;
    }
    byte = right;
  }
  std::printf("%zu changes of a file of %zu bytes, all noticed\n", changes, whole.size());
}

TEST_F(Damaged, ProtobufsOwnWordsDoNotReachUsers) {
  const std::string payload = encode(full_analysis(), version());
  testing::internal::CaptureStderr();
  for (std::size_t i = 0; i < payload.size(); ++i) {
    std::string bytes = payload;
    bytes[i] = '\xFF';
    decode(bytes);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(Damaged, EveryTruncationIsNoticed) {
  for (std::size_t length = 0; length < whole.size(); ++length)
    ASSERT_NE(reason_for(whole.substr(0, length)), "") << length << " bytes";
  EXPECT_THAT(reason_for(whole.substr(0, whole.size() / 2)), HasSubstr("truncated"));
  EXPECT_THAT(reason_for(""), HasSubstr("empty"));
}

TEST_F(Damaged, AppendedBytesAreNoticed) {
  EXPECT_THAT(reason_for(whole + "x"), HasSubstr("corrupt"));
  EXPECT_THAT(reason_for(whole + whole), HasSubstr("corrupt"));
}

TEST_F(Damaged, OtherFilesAreNotAnalysisFiles) {
  EXPECT_THAT(reason_for("# Blender OBJ\nv 0 0 0\n"), HasSubstr("not an analysis file"));
  EXPECT_THAT(reason_for(std::string(4096, '\0')), HasSubstr("not an analysis file"));
}

TEST_F(Damaged, NewerVersionIsNamed) {
  EXPECT_THAT(reason_for(seal(encode(full_analysis(), version()), kFormatVersion + 1)),
              HasSubstr("newer version"));
  EXPECT_THAT(reason_for(seal(encode(full_analysis(), version()), 0)), HasSubstr("unknown format version"));
}

TEST_F(Damaged, HugeDeclaredPayloadIsNotBelieved) {
  for (const std::uint64_t size :
       {std::uint64_t{1} << 40, UINT64_MAX, UINT64_MAX - 39, std::uint64_t{0x7FFFFFFF}}) {
    std::string bytes = whole.substr(0, 16);
    append(bytes, size);
    bytes += whole.substr(24);
    EXPECT_THAT(reason_for(bytes), HasSubstr("truncated")) << size;
  }
}

TEST_F(Damaged, SparseGiantIsRefusedUnread) {
  fs::resize_file(file, std::uintmax_t{1} << 36);
  const auto loaded = load(file);
  EXPECT_THAT(std::get<Unusable>(loaded).reason, HasSubstr("too large"));
}

TEST_F(Damaged, AbsentIsSilentAndOtherKindsAreNot) {
  EXPECT_TRUE(std::get<Unusable>(load(folder / "nothing")).absent);
  EXPECT_TRUE(std::get<Unusable>(load(folder / "no" / "folder")).absent);
  EXPECT_TRUE(std::get<Unusable>(load(file / "below a file")).absent);
  EXPECT_THAT(std::get<Unusable>(load(folder)).reason, HasSubstr("folder"));
  EXPECT_THAT(std::get<Unusable>(load("/dev/zero")).reason, HasSubstr("not a regular file"));
}

TEST_F(Damaged, GarbageUnderARightChecksumIsRefused) {
  EXPECT_THAT(reason_for(seal("\xff\xff\xff\xff")), HasSubstr("cannot be parsed"));
  EXPECT_NE(reason_for(seal("")), "");
  const std::string payload = encode(full_analysis(), version());
  // Never a crash, whatever parses; the sanitizer build looks closer.
  for (std::size_t i = 0; i < payload.size(); ++i) {
    std::string bytes = payload;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x55);
    reason_for(seal(bytes));
    reason_for(seal(payload.substr(0, i)));
  }
}

TEST_F(Damaged, ContradictionsUnderARightChecksumAreNamed) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reason_after([](v1::Analysis&) {}), "");
  const std::vector<std::pair<std::function<void(v1::Analysis&)>, std::string>> cases = {
      {[](auto& m) { m.mutable_instances(1)->set_geometry(3); }, "instance 1: geometry 3 of 3"},
      {[](auto& m) { m.mutable_instances(0)->set_area_scale(-1); }, "area scale"},
      {[](auto& m) { m.mutable_instances(0)->add_world(1); }, "world"},
      {[](auto& m) { m.mutable_instances(1)->mutable_bounds()->set_min(0, 5); }, "bounds inverted"},
      {[](auto& m) { m.mutable_instances(1)->mutable_bounds()->set_max(2, kNan); }, "bounds inverted"},
      {[](auto& m) { m.mutable_instances(1)->mutable_bounds()->add_max(1); }, "bounds"},
      {[](auto& m) { m.mutable_geometries(0)->add_linear(1); }, "linear"},
      {[](auto& m) { m.mutable_geometries(0)->set_triangles(1); }, "geometry 0: source triangles"},
      {[](auto& m) { m.mutable_geometries(0)->set_degenerate_triangles(UINT64_MAX); }, "source triangles"},
      {[](auto& m) { m.mutable_geometries(0)->set_surface_area(kNan); }, "surface area"},
      {[](auto& m) { m.mutable_geometries(1)->set_planar_groups(1); }, "more parts"},
      {[](auto& m) { m.mutable_geometries(1)->set_largest_planar_group(1); }, "more parts"},
      {[](auto& m) { m.mutable_geometries(1)->set_components(1); }, "more parts"},
      {[](auto& m) { m.mutable_geometries(1)->set_isolated_triangles(1); }, "more parts"},
      {[](auto& m) { m.mutable_geometries(1)->set_area_classes(1); }, "more parts"},
      {[](auto& m) { m.mutable_geometries(1)->set_boundary_edges(1); }, "more edges"},
      {[](auto& m) { m.mutable_geometries(1)->set_non_manifold_edges(1); }, "more edges"},
      {[](auto& m) { m.mutable_geometries(0)->set_polygons_per_planar_group(kNan); }, "rating"},
      {[](auto& m) { m.mutable_geometries(0)->set_planar_group_variation(1.5); }, "rating"},
      {[](auto& m) { m.mutable_geometries(0)->set_cooccurrence_contrast(-1); }, "rating"},
      {[](auto& m) { m.mutable_geometries(0)->set_fourier_transform(2); }, "rating"},
      {[](auto& m) { m.mutable_geometries(0)->set_fourier_transform(kNan); }, "rating"},
      {[](auto& m) { m.mutable_geometries(0)->clear_fourier_transform(); }, "only one"},
      {[](auto& m) { m.mutable_geometries(0)->clear_signal(); }, "only one"},
      {[](auto& m) { m.mutable_geometries(1)->mutable_signal()->set_length(1); }, "a signal of more"},
      {[](auto& m) { m.mutable_geometries(0)->mutable_signal()->set_mean_distance(kNan); }, "mean distance"},
      {[](auto& m) { m.mutable_geometries(0)->mutable_signal()->set_mean_distance(-1); }, "mean distance"},
      {[](auto& m) { m.mutable_geometries(0)->mutable_signal()->set_gap(-1e-9); }, "gap negative"},
      {[](auto& m) { m.mutable_geometries(0)->mutable_signal()->set_gap(kInfinity); }, "gap negative"},
      {[](auto& m) {
         m.mutable_geometries(1)->set_source_triangles(7);
         m.mutable_geometries(1)->set_triangles(7);
         m.mutable_geometries(1)->mutable_signal()->set_length(6);
         m.mutable_geometries(1)->mutable_signal()->set_start_triangle(7);
       },
       "start triangle"},
      {[](auto& m) { defect(m, 0).set_kind(static_cast<v1::Defect::Kind>(12)); }, "unknown kind"},
      {[](auto& m) { defect(m, 0).set_kind(v1::Defect::ZERO_AREA); }, "in no order"},
      {[](auto& m) { *m.mutable_geometries(0)->mutable_defects()->add_found() = defect(m, 10); },
       "in no order"},
      {[](auto& m) { defect(m, 8).set_count(0); }, "was not found"},
      {[](auto& m) { defect(m, 8).clear_places(); }, "places of a defect than"},
      {[](auto& m) { defect(m, 8).add_places(2); }, "places of a defect than"},
      {[](auto& m) { defect(m, 2).add_places(9); }, "places of a defect than"},
      {[](auto& m) { defect(m, 8).set_places(1, 0); }, "places of a defect in no order"},
      {[](auto& m) { defect(m, 10).set_count(2); }, "of a whole mesh"},
      {[](auto& m) { defect(m, 10).add_places(0); }, "of a whole mesh"},
      {[](auto& m) { defect(m, 0).set_count(3); }, "contradict the other counts"},
      {[](auto& m) { defect(m, 1).set_count(2); }, "contradict the other counts"},
      {[](auto& m) { defect(m, 2).set_count(5'000'000'001); }, "contradict the other counts"},
      {[](auto& m) { defect(m, 3).set_count(12); }, "contradict the other counts"},
      {[](auto& m) { defect(m, 4).set_count(15); }, "contradict the other counts"},
      {[](auto& m) { defect(m, 6).set_count(11); }, "contradict the other counts"},
      {[](auto& m) { defect(m, 10).set_kind(v1::Defect::ZERO_AREA); }, "contradict the other counts"},
      {[](auto& m) {
         m.mutable_geometries(1)->set_source_triangles(7);
         m.mutable_geometries(1)->set_triangles(7);
         v1::Defect& winding = *m.mutable_geometries(1)->mutable_defects()->add_found();
         winding.set_kind(v1::Defect::INCONSISTENT_WINDING);
         winding.set_count(1);
         winding.add_places(7);
       },
       "a triangle that does not exist"},
      {[](auto& m) {
         m.add_metrics("fourier_transform");
         m.mutable_parameters()->clear_start_searches();
       },
       "start searches"},
      {[](auto& m) { m.add_metrics("fourier_transform"); }, "content key"},
      {[](auto& m) { m.mutable_parameters()->set_alpha_degrees(181); }, "alpha"},
      {[](auto& m) { m.mutable_parameters()->set_dim(1); }, "dim"},
      {[](auto& m) { m.mutable_parameters()->set_weld_tolerance(-1); }, "weld tolerance"},
      {[](auto& m) { m.mutable_parameters()->set_steps(0); }, "steps"},
      {[](auto& m) { m.set_unit_scale(kNan); }, "unit scale"},
      {[](auto& m) { m.set_up_axis("up"); }, "axis"},
      {[](auto& m) { m.mutable_tool()->set_device_type("abacus"); }, "device type"},
      {[](auto& m) { m.mutable_tool()->clear_version(); }, "program version"},
      {[](auto& m) { m.add_metrics("beauty"); }, "unknown metric 'beauty'"},
      {[](auto& m) { m.add_metrics(m.metrics(0)); }, "twice"},
      {[](auto& m) { m.clear_files(); }, "fingerprint of the asset"},
      {[](auto& m) { m.mutable_files(0)->set_found(false); }, "fingerprint of the asset"},
      {[](auto& m) { m.mutable_files(1)->set_size(1); }, "file 1: contents"},
      {[](auto& m) { m.mutable_files(2)->set_path(std::string("a\0b", 3)); }, "file 2: no usable path"},
      {[](auto& m) { m.mutable_files(2)->set_hash_low(99); }, "content key"},
      {[](auto& m) { m.mutable_parameters()->set_dim(301); }, "content key"},
      {[](auto& m) { m.set_content_key("0123"); }, "content key"},
  };
  for (const auto& [change, reason] : cases) EXPECT_THAT(reason_after(change), HasSubstr(reason));
}

}  // namespace
}  // namespace scene_analyzer::analysis_file
