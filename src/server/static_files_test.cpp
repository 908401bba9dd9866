// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/static_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/error.hpp"
#include "server/origin_guard.hpp"

namespace carpus::server {
namespace {

namespace fs = std::filesystem;

/// root/{index.html, assets/a.js, link -> ../secret.txt} beside secret.txt
class StaticFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "carpus-web-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
    fs::create_directories(folder_ / "root/assets");
    std::ofstream(folder_ / "root/index.html") << "<html>";
    std::ofstream(folder_ / "root/.hidden") << "hidden";
    std::ofstream(folder_ / "root/assets/a.js") << "let a;";
    std::ofstream(folder_ / "secret.txt") << "secret";
    fs::create_symlink("../secret.txt", folder_ / "root/link.txt");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(StaticFilesTest, ServesTheIndexAndAssetsWithTheirTypes) {
  const StaticFiles files(folder_ / "root");
  const HttpResponse index = files.get("/");
  EXPECT_EQ(*index.body, "<html>");
  EXPECT_EQ(index.content_type, "text/html; charset=utf-8");
  EXPECT_EQ(index.cache_control, "no-cache");
  const HttpResponse script = files.get("/assets/a.js");
  EXPECT_EQ(script.content_type, "text/javascript; charset=utf-8");
  EXPECT_THAT(script.cache_control, ::testing::HasSubstr("immutable"));
}

TEST_F(StaticFilesTest, ServesNothingElse) {
  const StaticFiles files(folder_ / "root");
  for (const char* path : {"/../secret.txt", "/assets/../../secret.txt", "/link.txt", "/assets",
                           "/.hidden", "/no", "//etc/passwd", "/assets/", "secret.txt", ""}) {
    EXPECT_EQ(files.get(path).status, 404U) << path;
    EXPECT_EQ(files.get(path).body->find("secret"), std::string::npos) << path;
  }
}

TEST_F(StaticFilesTest, FolderWithoutAPageIsRefusedWithWhatToDo) {
  try {
    StaticFiles files(folder_ / "root/assets");
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("--web"));
  }
}

TEST(DecodePath, DecodesPlainPathsAndDropsTheQuery) {
  EXPECT_EQ(decode_path("/"), "/");
  EXPECT_EQ(decode_path("/a%20b/c.js?x=/../y"), "/a b/c.js");
  EXPECT_EQ(decode_path("/%C3%A9.png#top"), "/é.png");
}

TEST(DecodePath, RefusesWhateverTriesToLeave) {
  for (const char* target : {"",
                             "x",
                             "/..",
                             "/../etc/passwd",
                             "/a/../b",
                             "/%2e%2e/x",
                             "/%2E%2e/x",
                             "/..%2fx",
                             "/a%2fb",
                             "/a\\b",
                             "/%5c..%5cx",
                             "/a%00b",
                             "/%",
                             "/%4",
                             "/%zz",
                             "//x",
                             "/a//b",
                             "/a/",
                             "/.git/config",
                             "/C:/x",
                             "http://other/x",
                             "/a%0d%0ab"}) {
    EXPECT_EQ(decode_path(target), std::nullopt) << target;
  }
}

TEST(OriginGuard, AcceptsAddressesOfThisStationOnly) {
  const OriginGuard guard(8080, {"Station-3"});
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "LOCALHOST:8080", "[::1]:8080",
                           "192.168.1.7:8080", "station-3:8080"}) {
    EXPECT_TRUE(guard.accepts_host(host)) << host;
    EXPECT_TRUE(guard.accepts_origin(std::string("http://") + host, host)) << host;
  }
  for (const char* host : {"", "localhost", "localhost:80", "localhost:8081", "evil.example:8080",
                           "127.0.0.1.evil.example:8080", "1.2.3.4.5:8080", "[evil]:8080", ":8080",
                           "station-3.evil.example:8080", "localhost:8080:8080"}) {
    EXPECT_FALSE(guard.accepts_host(host)) << host;
  }
  EXPECT_FALSE(guard.accepts_origin("http://localhost:8080", "127.0.0.1:8080"));
  EXPECT_FALSE(guard.accepts_origin("https://localhost:8080", "localhost:8080"));
  EXPECT_FALSE(guard.accepts_origin("null", "localhost:8080"));
  EXPECT_TRUE(OriginGuard(80, {}).accepts_host("localhost"));
}

}  // namespace
}  // namespace carpus::server
