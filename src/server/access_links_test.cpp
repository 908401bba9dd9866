// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/access_links.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "core/error.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class AccessLinksTest : public ::testing::Test {
 protected:
  AccessLinksTest() {
    std::string name = (fs::temp_directory_path() / "carpus-links-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    file_ = folder_ / "links";
  }
  ~AccessLinksTest() override { fs::remove_all(folder_); }

  void write(const std::string& text) const {
    std::ofstream(file_) << text;
    fs::permissions(file_, fs::perms::owner_read | fs::perms::owner_write);
  }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)keep_access_links(file_, false);
    } catch (const IoError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder_;
  fs::path file_;
};

TEST(AccessToken, IsLongAndNeverTheSame) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::string token = make_token();
    EXPECT_TRUE(is_token(token)) << token;
    seen.insert(token);
  }
  EXPECT_EQ(seen.size(), 1000U);
  EXPECT_FALSE(is_token(""));
  EXPECT_FALSE(is_token(std::string(kTokenLength, '.')));
  EXPECT_FALSE(is_token(make_token() + "A"));
}

TEST(AccessToken, IsComparedWhole) {
  const std::string token = make_token();
  EXPECT_TRUE(same_secret(token, std::string(token)));
  EXPECT_FALSE(same_secret(token, token.substr(1)));
  EXPECT_FALSE(same_secret(token, make_token()));
  EXPECT_FALSE(same_secret(token, ""));
}

TEST_F(AccessLinksTest, AreTheSameAfterARestartAndOtherOnesAnew) {
  const AccessLinks first = keep_access_links(file_, false);
  EXPECT_NE(first.trainee, first.instructor);
  EXPECT_EQ(keep_access_links(file_, false), first);
  const AccessLinks second = keep_access_links(file_, true);
  EXPECT_NE(second.trainee, first.trainee);
  EXPECT_NE(second.instructor, first.instructor);
  EXPECT_EQ(keep_access_links(file_, false), second);
}

TEST_F(AccessLinksTest, AreForTheirOwnerAlone) {
  const ::mode_t before = ::umask(0);
  (void)keep_access_links(file_, false);
  ::umask(before);
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(file_, fs::perms::group_read, fs::perm_options::add);
  EXPECT_THAT(refusal(), HasSubstr("others may read it"));
}

TEST_F(AccessLinksTest, FileThatIsNoneOfOursIsRefusedAndSaysWhatToDo) {
  const std::string good = make_token();
  for (const std::string& text :
       {std::string(), std::string("carpus links 1\n"), "carpus links 1\ntrainee " + good + "\n",
        "carpus links 1\ntrainee " + good + "\ninstructor short\n",
        "carpus links 1\ntrainee " + good + "\ninstructor " + good + "\n",
        "carpus links 1\ntrainee " + good + "\ninstructor " + make_token() + "\nmore",
        std::string(100'000, 'x')}) {
    write(text);
    EXPECT_THAT(refusal(), HasSubstr("remove it, and new ones are made")) << text.substr(0, 100);
  }
  fs::remove(file_);
  fs::create_symlink("/dev/zero", file_);
  EXPECT_THAT(refusal(), HasSubstr("symbolic link"));
  fs::remove(file_);
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_THAT(refusal(), HasSubstr("is no file"));
  EXPECT_THAT([&] { (void)keep_access_links(folder_ / "none" / "links", false); },
              ::testing::ThrowsMessage<IoError>(HasSubstr("cannot be made")));
}

}  // namespace
}  // namespace carpus::server
