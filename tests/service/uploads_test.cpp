// Files that clients send: which are taken, and under which names they lie.
#include "service/uploads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "import/file_names.h"
#include "service/refused.h"
#include "service/sent_files.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::service {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using testing::UnorderedElementsAre;

class UploadsTest : public testing::Test {
 protected:
  // What an asset of that name is refused with.
  std::string refusal(std::string_view name) {
    Upload upload(space_, kPlenty);
    return refused([&] { send(upload, name, "bytes"); });
  }
  // The same of a file beside it.
  std::string refusal_beside(std::string_view name) {
    Upload upload(space_, kPlenty);
    send(upload, "asset.obj", "bytes");
    return refused([&] { send(upload, name, "bytes"); });
  }

  TemporaryFolder folder_;
  UploadSpace space_{folder_.path(), kPlenty};
};

const std::vector<std::string> kNamesThatLeadOut = {"/etc/passwd",  "//etc/passwd",
                                                    "..",           "../evil.obj",
                                                    "../../evil",   "a/../../evil.obj",
                                                    "\\evil.obj",   "..\\evil.obj",
                                                    "a\\..\\..\\b", "\\\\server\\share\\evil.obj",
                                                    "C:\\evil.obj", "c:evil.obj",
                                                    "C:/evil.obj",  "http://host/evil.obj",
                                                    "file:///evil", "FTP://host/evil.obj"};

TEST_F(UploadsTest, NamesThatLeadOutAreRefused) {
  for (const std::string& name : kNamesThatLeadOut) {
    EXPECT_THAT(refusal(name), AllOf(StartsWith("invalid: "), HasSubstr(name)));
    EXPECT_THAT(refusal_beside(name), AllOf(StartsWith("invalid: "), HasSubstr(name)));
  }
}

TEST_F(UploadsTest, NamesOfNothingOrOfFoldersAreRefused) {
  for (const char* name : {".", "./", "a/..", "a/", "a/b/", "./a/", "a/.", "a/b/..", "a\\", "a\\."}) {
    EXPECT_THAT(refusal(name), StartsWith("invalid: '" + std::string(name) + "' is no file's name"));
    EXPECT_THAT(refusal_beside(name), StartsWith("invalid: '" + std::string(name) + "' is no file's name"));
  }
  EXPECT_THAT(refusal(""), StartsWith("invalid: a file has no name"));
  EXPECT_THAT(refusal_beside(""), StartsWith("invalid: a file has no name"));
  EXPECT_THAT(refusal(std::string("a\0.obj", 6)), StartsWith("invalid: a file's name holds a zero byte"));
  EXPECT_THAT(refusal_beside(std::string(1, '\0')), StartsWith("invalid: a file's name holds a zero byte"));
}

TEST_F(UploadsTest, NamesMayHaveThatManyBytes) {
  const std::string longest = std::string(kLongestFileName - 4, 'x') + ".obj";
  EXPECT_EQ(refusal(longest), "");
  EXPECT_EQ(refusal_beside(longest), "");
  EXPECT_THAT(refusal("x" + longest), AllOf(StartsWith("invalid: "), HasSubstr("1025"), HasSubstr("1024")));
  EXPECT_THAT(refusal_beside("x" + longest), AllOf(StartsWith("invalid: "), HasSubstr("1025")));
}

TEST_F(UploadsTest, TheAssetLiesInNoSubfolderAndTheOthersMay) {
  for (const char* name : {"sub/a.obj", "sub\\a.obj", "./sub/a.obj"})
    EXPECT_THAT(refusal(name), AllOf(StartsWith("invalid: '" + std::string(name)), HasSubstr("has no '/'")));
  EXPECT_EQ(refusal("sub/../a.obj"), "") << "it does not";
  EXPECT_EQ(refusal_beside("sub/a.obj"), "");
}

TEST_F(UploadsTest, TheSameNameTwiceIsRefusedHoweverItIsWritten) {
  Upload upload(space_, kPlenty);
  send(upload, "asset.obj", "1");
  send(upload, "a/b", "2");
  for (const char* name : {"a/b", "a/./b", "./a/b", "a//b", "a\\b", "a/c/../b", "asset.obj", "./asset.obj"})
    EXPECT_THAT(refused([&] { upload.begin_file(name, {}); }),
                AllOf(StartsWith("invalid: '" + std::string(name)), HasSubstr("sent already")));
  EXPECT_EQ(refused([&] { send(upload, "A/B", "3"); }), "");
  EXPECT_EQ(refused([&] { send(upload, "a%2fb", "4"); }), "") << "escapes are the asset's affair";
  EXPECT_THAT(*upload.finish().file_names, ElementsAre("asset.obj", "a/b", "A/B", "a%2fb"));
}

TEST_F(UploadsTest, TheAssetsExtensionTellsItsFormat) {
  for (const auto& [name, stored] : {std::pair{"a.obj", "0.obj"},
                                     {"A.OBJ", "0.obj"},
                                     {"a.tar.GlTf", "0.gltf"},
                                     {"plain", "0"},
                                     {".obj", "0"}}) {
    Upload upload(space_, kPlenty);
    send(upload, name, "bytes");
    const mesh::AssetSource asset = upload.finish();
    EXPECT_EQ(asset.file.filename(), stored) << name;
    EXPECT_EQ(asset.name, name);
  }
  EXPECT_THAT(refusal("notes.docx"),
              AllOf(StartsWith("invalid: notes.docx: "), HasSubstr("unsupported format"), HasSubstr("glTF")));
  EXPECT_EQ(refusal_beside("notes.docx"), "") << "the asset may refer to anything";
}

TEST_F(UploadsTest, FilesLieUnderNumbers) {
  Upload upload(space_, kPlenty);
  upload.begin_file("Stuhl äöü.obj", {});
  upload.add("first ");
  upload.add("");
  upload.add("and more");
  send(upload, "sub\\../textures\\a b.png", std::string("zero\0byte", 9));
  send(upload, "names", "a file called so");
  send(upload, "lock", "");
  const mesh::AssetSource asset = upload.finish();
  EXPECT_EQ(asset.file, only_upload(space_) / "0.obj");
  EXPECT_EQ(asset.name, "Stuhl äöü.obj");
  ASSERT_NE(asset.file_names, nullptr);
  EXPECT_THAT(*asset.file_names, ElementsAre("Stuhl äöü.obj", "textures/a b.png", "names", "lock"));
  EXPECT_EQ(import::read_file_names(only_upload(space_)), *asset.file_names);
  EXPECT_EQ(TemporaryFolder::read(asset.file), "first and more");
  EXPECT_EQ(TemporaryFolder::read(only_upload(space_) / "1"), std::string("zero\0byte", 9));
  EXPECT_EQ(TemporaryFolder::read(only_upload(space_) / "2"), "a file called so");
  EXPECT_EQ(TemporaryFolder::read(only_upload(space_) / "3"), "");
  EXPECT_THAT(everything_below(only_upload(space_)), UnorderedElementsAre("0.obj", "1", "2", "3", "names"));
}

TEST_F(UploadsTest, NoNameLeadsOutOfTheUploadsFolder) {
  const TemporaryFolder around;
  fs::create_directories(around.path() / "a/b");
  const std::set<std::string> before = everything_below(around.path());
  {
    UploadSpace space(around.path() / "a/b", kPlenty);
    std::vector<std::string> names = kNamesThatLeadOut;
    for (const char* name : {"%2e%2e/evil.obj", "..%2fevil.obj", "...", "~/evil.obj", "~", "-rf.obj",
                             "a:b.obj", "names", "lock", "0.obj", "1", "nul", "evil.obj ", "\xff\xfe.obj"})
      names.emplace_back(name);
    std::size_t taken = 0;
    for (const std::string& name : names) {
      Upload first(space, kPlenty), beside(space, kPlenty);
      send(beside, "asset.obj", "bytes");
      for (Upload* upload : {&first, &beside})
        if (refused([&] { send(*upload, name, "bytes"); }).empty()) ++taken;
      refused([&] { first.finish(); });
      beside.finish();
      for (const std::string& made : everything_below(around.path()))
        EXPECT_TRUE(before.contains(made) ||
                    (around.path() / made).string().starts_with(space.folder().string()))
            << made << " by " << name;
      for (const auto& entry : fs::recursive_directory_iterator(space.folder())) {
        const std::string stem = entry.path().stem().string();
        EXPECT_TRUE(stem == "lock" || stem == "names" ||
                    stem.find_first_not_of("0123456789") == std::string::npos)
            << entry.path() << " by " << name;
      }
    }
    EXPECT_GT(taken, 10U) << "some of these names are fine";
  }
  EXPECT_EQ(everything_below(around.path()), before);
}

TEST_F(UploadsTest, AnUploadIsGoneWithItsObject) {
  const std::set<std::string> before = everything_below(folder_.path());
  {
    Upload whole(space_, kPlenty), begun(space_, kPlenty), empty(space_, kPlenty);
    send(whole, "a.obj", "bytes");
    whole.finish();
    begun.begin_file("a.obj", 100);
    begun.add("bytes");
    EXPECT_GT(space_.used_bytes(), 0U);
  }
  EXPECT_EQ(everything_below(folder_.path()), before);
  EXPECT_EQ(space_.used_bytes(), 0U);
}

TEST_F(UploadsTest, HeadersThatAnnounceTheWrongSizeAreRefused) {
  {
    Upload more(space_, kPlenty);
    more.begin_file("a.obj", 5);
    more.add("12345");
    EXPECT_EQ(refused([&] { more.add(""); }), "");
    EXPECT_THAT(refused([&] { more.add("6"); }),
                AllOf(StartsWith("invalid: 'a.obj' has more than the 5 bytes")));
  }
  {
    Upload less(space_, kPlenty);
    less.begin_file("a.obj", 5);
    less.add("1234");
    EXPECT_THAT(refused([&] { less.finish(); }), StartsWith("invalid: 'a.obj' ended after 4 of the 5 bytes"));
    EXPECT_THAT(refused([&] { less.begin_file("b", {}); }),
                StartsWith("invalid: 'a.obj' ended after 4 of the 5 bytes"));
  }
  Upload nothing(space_, kPlenty);
  nothing.begin_file("a.obj", 0);
  EXPECT_THAT(refused([&] { nothing.add("1"); }), StartsWith("invalid: 'a.obj' has more than the 0 bytes"));
  EXPECT_EQ(refused([&] { nothing.finish(); }), "");
}

TEST_F(UploadsTest, DataBeforeAHeaderIsRefused) {
  Upload upload(space_, kPlenty);
  EXPECT_THAT(refused([&] { upload.add("bytes"); }), StartsWith("invalid: data came before the header"));
}

TEST_F(UploadsTest, AnUploadWithoutFilesIsRefused) {
  Upload upload(space_, kPlenty);
  EXPECT_THAT(refused([&] { upload.finish(); }), StartsWith("invalid: no file was sent"));
}

TEST_F(UploadsTest, OneUploadHasItsLimit) {
  const auto too_large = AllOf(StartsWith("too_large: "), HasSubstr("10 bytes"), HasSubstr("--max-upload"));
  {
    Upload exact(space_, 10);
    send(exact, "a.obj", "12345");
    send(exact, "b", "67890");
    EXPECT_EQ(refused([&] { exact.finish(); }), "");
    EXPECT_THAT(refused([&] { send(exact, "c", "1"); }), too_large);
  }
  {
    Upload announced(space_, 10);
    EXPECT_THAT(refused([&] { announced.begin_file("a.obj", 11); }), too_large) << "before anything is sent";
    EXPECT_THAT(refused([&] { announced.begin_file("a.obj", UINT64_MAX); }), too_large);
  }
  {
    Upload second(space_, 10);
    send(second, "a.obj", "12345");
    EXPECT_THAT(refused([&] { second.begin_file("b", 6); }), too_large);
  }
  Upload silent(space_, 10);
  silent.begin_file("a.obj", {});
  silent.add("12345");
  EXPECT_THAT(refused([&] { silent.add("678901"); }), too_large);
  EXPECT_EQ(refused([&] { silent.add("67890"); }), "");
}

TEST_F(UploadsTest, OneUploadHasSoManyFilesAtMost) {
  Upload upload(space_, kPlenty);
  upload.begin_file("a.obj", {});
  for (std::size_t i = 1; i < kMostFiles; ++i) upload.begin_file(std::to_string(i), {});
  EXPECT_THAT(refused([&] { upload.begin_file("one more", {}); }),
              AllOf(StartsWith("too_large: "), HasSubstr("10000 files")));
}

}  // namespace
}  // namespace scene_analyzer::service
