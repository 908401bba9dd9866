// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/ply.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "case_io/surface_file.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Ply : public ::testing::Test {
 protected:
  Ply()
      : file_(fs::temp_directory_path() /
              ("carpus_ply_" + std::to_string(::getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".ply")) {}
  ~Ply() override { fs::remove(file_); }

  [[nodiscard]] const fs::path& file() const { return file_; }
  [[nodiscard]] std::string refusal(const std::string& content) const {
    fs::remove(file_);  // writing over a file is slow: its old blocks are forced out first
    std::ofstream(file_, std::ios::binary) << content;
    try {
      (void)read_ply(file_);
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  fs::path file_;
};

const TriangleMesh kTetrahedron{{{0, 0, 0}, {1.0 / 3.0, 0, 0}, {0, 1e-17, 0}, {0, 0, -4e8}},
                                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

std::string header(const std::string& vertices, const std::string& faces) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string bytes_of(float v) { return {reinterpret_cast<const char*>(&v), sizeof v}; }
std::string bytes_of(std::int32_t v) { return {reinterpret_cast<const char*>(&v), sizeof v}; }

std::string point(float x) { return bytes_of(x) + bytes_of(0.0F) + bytes_of(1.0F); }
std::string facet(std::int32_t a, std::int32_t b, std::int32_t c, char count = 3) {
  return std::string(1, count) + bytes_of(a) + bytes_of(b) + bytes_of(c);
}

TEST_F(Ply, GivesBackTheSameBits) {
  write_ply(file(), kTetrahedron);
  const TriangleMesh again = read_ply(file());
  EXPECT_EQ(again.vertices, kTetrahedron.vertices);
  EXPECT_EQ(again.facets, kTetrahedron.facets);
}

TEST_F(Ply, ReadsFloatVerticesAndSkipsOtherProperties) {
  std::string content = header("3", "1");
  const std::string before = "property float z\n";
  content.insert(content.find(before) + before.size(), "property uchar red\n");
  for (const float x : {1.0F, 2.0F, 3.5F}) content += point(x) + "r";
  content += facet(0, 1, 2);
  ASSERT_EQ(refusal(content), "no error");
  const TriangleMesh mesh = read_ply(file());
  EXPECT_EQ(mesh.vertices[2], (Vec3{3.5, 0, 1}));
  EXPECT_EQ(mesh.facets[0], (Triangle{0, 1, 2}));
}

TEST_F(Ply, RefusesHostileFiles) {
  const std::string points = point(1) + point(2) + point(3);
  EXPECT_EQ(refusal(header("3", "1") + points + facet(0, 1, 2)), "no error");
  EXPECT_THAT(refusal("solid cube"), HasSubstr("is not a PLY"));
  EXPECT_THAT(refusal(header("3", "1") + points), HasSubstr("cut short"));
  EXPECT_THAT(refusal(header("4000000000", "1") + points), HasSubstr("cut short"));
  EXPECT_THAT(refusal(header("18446744073709551615", "1") + points), HasSubstr("impossible count"));
  EXPECT_THAT(refusal(header("-3", "1") + points), HasSubstr("impossible count"));
  EXPECT_THAT(refusal(header("3", "1") + points + facet(0, 1, 3)), HasSubstr("not there"));
  EXPECT_THAT(refusal(header("3", "1") + points + facet(0, -1, 2)), HasSubstr("not there"));
  EXPECT_THAT(refusal(header("3", "1") + points + facet(0, 1, 2, 4)), HasSubstr("no triangle"));
  EXPECT_THAT(refusal(header("3", "1") + point(std::numeric_limits<float>::quiet_NaN()) + point(2) +
                      point(3) + facet(0, 1, 2)),
              HasSubstr("not finite"));
  EXPECT_THAT(
      refusal("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float "
              "y\nproperty float z\nelement face 0\nproperty list uchar int i\nend_header\n"),
      HasSubstr("not binary"));
}

std::string replaced(std::string content, const std::string& from, const std::string& to) {
  return content.replace(content.find(from), from.size(), to);
}

TEST_F(Ply, RefusesWhatItSaysTwiceOrBesideItsData) {
  const std::string points = point(1) + point(2) + point(3);
  const std::string whole = header("3", "1") + points + facet(0, 1, 2);
  EXPECT_THAT(refusal(whole + "x"), HasSubstr("more than its header says"));
  EXPECT_THAT(refusal(header("3", "0") + points + "x"), HasSubstr("more than its header says"));
  EXPECT_THAT(refusal(replaced(whole, "float y", "float x")), HasSubstr("x twice"));
  EXPECT_THAT(refusal(replaced(whole, "uchar int", "uchar float")), HasSubstr("another form"));
  EXPECT_THAT(refusal(replaced(whole, "uchar int", "float int")), HasSubstr("another form"));
  const std::string again = "element vertex 3\nend_header\n";
  EXPECT_THAT(refusal(replaced(whole, "end_header\n", again)), HasSubstr("twice"));
  // Properties of an element of which there is none are not the vertices'.
  const std::string none = "element edge 0\nproperty float w\nend_header\n";
  EXPECT_EQ(refusal(replaced(whole, "end_header\n", none)), "no error");
}

TEST_F(Ply, SurvivesRandomDamage) {
  std::string content = header("3", "1") + point(1) + point(2) + point(3) + facet(0, 1, 2);
  Rng rng(4);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = content;
    for (std::uint64_t k = 0; k <= rng.below(4); ++k) {
      damaged[rng.below(damaged.size())] = static_cast<char>(rng.below(256));
    }
    damaged.resize(rng.below(damaged.size()) + 1);
    (void)refusal(damaged);  // an error or a mesh, never a crash
  }
}

TEST_F(Ply, ReadsTheReferenceMeshes) {
  const char* set = std::getenv("CARPUS_REFERENCE_WRIST");
  const fs::path reference = set != nullptr ? fs::path(set) : fs::path("../shared/reference-wrist");
  if (!fs::exists(reference / "meshes" / "lunate.ply")) {
    GTEST_SKIP() << "no reference wrist; set CARPUS_REFERENCE_WRIST to its folder";
  }
  const TriangleMesh lunate = read_ply(reference / "meshes" / "lunate.ply");
  EXPECT_EQ(check_surface(lunate), SurfaceStatus::Ok);
  EXPECT_NEAR(volume_of(lunate), 1641, 1);  // as published with it
}

TEST_F(Ply, OfPointsOrOfTextIsReadWhereAHullIsWanted) {
  const std::string text_header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float nx\nproperty float x\n"
      "property float y\nproperty float z\n";
  const std::string points = "9 0 0 0\n9 1 0 0\n9 1 2 0\n9 0 2 3.5\n";
  std::ofstream(file(), std::ios::binary) << text_header << "end_header\n" << points;
  EXPECT_EQ(read_surface(file()).vertices,
            (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 3.5}}));
  EXPECT_THAT(refusal(text_header + "end_header\n" + points), HasSubstr("binary"));

  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  fs::remove(file());
  std::ofstream(file(), std::ios::binary) << text_header << faces << points << "4 0 1 2 3\n";
  EXPECT_EQ(read_surface(file()).facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  for (const std::string wrong : {"4 0 1 2 4\n", "2 0 1\n", "3 0 1\n", "-1\n", "x\n", ""}) {
    fs::remove(file());
    std::ofstream(file(), std::ios::binary) << text_header << faces << points << wrong;
    EXPECT_THROW((void)read_surface(file()), IoError) << wrong;
  }

  fs::remove(file());
  std::ofstream(file(), std::ios::binary)
      << "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
         "property float y\nproperty float z\nend_header\n"
      << bytes_of(1.0F) << bytes_of(2.0F) << bytes_of(3.0F);
  EXPECT_EQ(read_surface(file()).vertices, (std::vector<Vec3>{{1, 2, 3}}));
}

}  // namespace
}  // namespace carpus::case_io
