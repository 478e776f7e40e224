// Which files hold tokens, and who may ask with them.
#include "service/token_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

#include "base/error.h"
#include "support/temporary_folder.h"

namespace scene_analyzer::service {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kFirst = "first-token-0123456789";
constexpr const char* kSecond = "second-token-0123456789";

class TokenListTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) { return folder_.write("tokens", text); }
  TokenList list(const std::string& text) { return TokenList(write(text)); }
  // What the file is refused with, without its name.
  std::string refusal(const std::string& text) {
    const std::filesystem::path file = write(text);
    try {
      const TokenList list(file);
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_THAT(what, StartsWith(file.string() + ":"));
      return what.substr(file.string().size() + 1);
    }
    return "";
  }

  TemporaryFolder folder_;
};

std::string bearer(const std::string& token) {
  return "Bearer " + token;
}

TEST_F(TokenListTest, OnePerLine) {
  const TokenList tokens = list(std::string(kFirst) + "\n" + kSecond + "\n");
  EXPECT_TRUE(tokens.accepts(bearer(kFirst)));
  EXPECT_TRUE(tokens.accepts(bearer(kSecond)));
}

TEST_F(TokenListTest, CommentsEmptyLinesAndForeignLineEndsDoNotCount) {
  const TokenList tokens =
      list(std::string("# for the farm, with spaces\r\n\r\n") + kFirst + "\r\n\n#" + kSecond + "\n");
  EXPECT_TRUE(tokens.accepts(bearer(kFirst)));
  EXPECT_FALSE(tokens.accepts(bearer(kFirst + std::string("\r"))));
  EXPECT_FALSE(tokens.accepts(bearer(kSecond)));
  EXPECT_FALSE(tokens.accepts(bearer(std::string("#") + kSecond)));
  EXPECT_FALSE(tokens.accepts(bearer("# for the farm, with spaces")));
}

TEST_F(TokenListTest, TheLastLineNeedsNoEnd) {
  EXPECT_TRUE(list(std::string("#\n") + kFirst).accepts(bearer(kFirst)));
}

TEST_F(TokenListTest, SixteenCharactersAreEnoughAndFifteenAreNot) {
  const std::string sixteen = "0123456789abcdef", fifteen = sixteen.substr(1);
  EXPECT_TRUE(list(sixteen).accepts(bearer(sixteen)));
  EXPECT_THAT(refusal(std::string(kFirst) + "\n\n" + fifteen + "\n"),
              AllOf(StartsWith("3:"), HasSubstr("16"), HasSubstr("openssl rand")));
}

TEST_F(TokenListTest, TokensHavePrintableCharactersAndNoSpaces) {
  for (const char* bad : {"with space 0123456789", " first-token-0123456789", "first-token-0123456789 ",
                          "tab\t-token-0123456789", "\xc3\xa4-token-0123456789", "\x7f-token-0123456789"})
    EXPECT_THAT(refusal(bad), StartsWith("1: is no token")) << bad;
  EXPECT_THAT(refusal(std::string("zero-token-\0-0123456789", 23)), StartsWith("1: is no token"));
  EXPECT_EQ(refusal("!\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}~"), "");
}

TEST_F(TokenListTest, TokensAreNotRepeatedInMessages) {
  EXPECT_THAT(refusal("secret 0123456789abcdef"), Not(HasSubstr("secret")));
}

TEST_F(TokenListTest, AFileWithoutTokensIsRefused) {
  for (const char* empty : {"", "\n", "\r\n\n", "# a comment alone"})
    EXPECT_THAT(refusal(empty), HasSubstr("holds no token")) << empty;
}

TEST_F(TokenListTest, WhatCannotBeReadIsRefused) {
  const auto refusal_of = [](const std::filesystem::path& file) -> std::string {
    try {
      const TokenList list(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::filesystem::path missing = folder_.path() / "none", pipe = folder_.path() / "pipe";
  EXPECT_THAT(refusal_of(missing),
              AllOf(StartsWith(missing.string()), EndsWith("No such file or directory")));
  EXPECT_THAT(refusal_of(folder_.path()), HasSubstr("cannot be read"));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal_of(pipe), HasSubstr("cannot be read")) << "a pipe would be waited for";
  EXPECT_THAT(refusal_of(folder_.write("large", std::string((1 << 20) + 1, '\n'))), HasSubstr("too large"));
}

TEST_F(TokenListTest, OnlyAWholeTokenBehindItsSchemeIsAccepted) {
  const TokenList tokens = list(std::string(kFirst) + "\n" + kSecond + "\n");
  const std::string token = kFirst;
  const auto expect_refused = [&](const std::string& wrong) {
    EXPECT_FALSE(tokens.accepts(wrong)) << wrong.substr(0, 100);
  };
  for (const char* before :
       {"", "bearer ", "BEARER ", "Bearer  ", "Bearer\t", " Bearer ", "Basic ", "Bearer 0"})
    expect_refused(before + token);
  for (const char* behind : {"0", " ", "\n", kSecond}) expect_refused("Bearer " + token + behind);
  for (const char* wrong : {"", "Bearer", "Bearer ", "Bearer First-token-0123456789"}) expect_refused(wrong);
  expect_refused("Bearer " + token.substr(0, token.size() - 1));
  expect_refused("Bearer " + token.substr(1));
  expect_refused("Bearer " + token + std::string(1, '\0'));
  expect_refused("Bearer " + std::string(100'000, 'x'));
  EXPECT_TRUE(tokens.accepts("Bearer " + token));
}

TEST_F(TokenListTest, ReadAgainItHasTheNewTokens) {
  TokenList tokens = list(kFirst);
  write(kSecond);
  EXPECT_TRUE(tokens.accepts(bearer(kFirst))) << "nobody has asked for it yet";
  tokens.reload();
  EXPECT_FALSE(tokens.accepts(bearer(kFirst)));
  EXPECT_TRUE(tokens.accepts(bearer(kSecond)));
}

TEST_F(TokenListTest, AfterABadFileTheOldTokensStay) {
  TokenList tokens = list(kFirst);
  for (const std::string& bad : {std::string(), std::string(kSecond) + "\nshort\n"}) {
    write(bad);
    EXPECT_THROW(tokens.reload(), InputError);
    EXPECT_TRUE(tokens.accepts(bearer(kFirst)));
    EXPECT_FALSE(tokens.accepts(bearer(kSecond)));
  }
  std::filesystem::remove(folder_.path() / "tokens");
  EXPECT_THROW(tokens.reload(), InputError);
  EXPECT_TRUE(tokens.accepts(bearer(kFirst)));
  write(kSecond);
  tokens.reload();
  EXPECT_TRUE(tokens.accepts(bearer(kSecond)));
}

}  // namespace
}  // namespace scene_analyzer::service
