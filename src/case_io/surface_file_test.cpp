// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/surface_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "core/rng.hpp"

namespace carpus::case_io {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SurfaceFile : public ::testing::Test {
 protected:
  SurfaceFile()
      : folder_(fs::temp_directory_path() /
                ("carpus_surface_" + std::to_string(::getpid()) +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~SurfaceFile() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const std::string& extension) const {
    return folder_ / ("surface" + extension);
  }
  [[nodiscard]] TriangleMesh read(const std::string& extension, const std::string& content) const {
    fs::remove(file(extension));
    std::ofstream(file(extension), std::ios::binary) << content;
    return read_surface(file(extension));
  }
  [[nodiscard]] std::string refusal(const std::string& extension,
                                    const std::string& content) const {
    try {
      (void)read(extension, content);
    } catch (const IoError& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  fs::path folder_;
};

const TriangleMesh kTetrahedron{{{0, 0, 0}, {1.0 / 3.0, 0, 0}, {0, 1e-17, 0}, {0, 0, -4e8}},
                                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};

TEST_F(SurfaceFile, GivesTheSameBitsBack) {
  for (const std::string extension : {".ply", ".obj", ".off", ".OFF"}) {
    write_surface(file(extension), kTetrahedron);
    const TriangleMesh mesh = read_surface(file(extension));
    EXPECT_EQ(mesh.vertices, kTetrahedron.vertices) << extension;
    EXPECT_EQ(mesh.facets, kTetrahedron.facets) << extension;
  }
}

TEST_F(SurfaceFile, KeepsSinglePrecisionInStl) {
  write_surface(file(".stl"), kTetrahedron);
  const TriangleMesh mesh = read_surface(file(".stl"));
  ASSERT_EQ(mesh.vertices.size(), 4U);
  ASSERT_EQ(mesh.facets.size(), 4U);
  EXPECT_EQ(check_surface(mesh), SurfaceStatus::Ok);
  EXPECT_NEAR(mesh.vertices[2].x, 1.0 / 3.0, 1e-7);
}

TEST_F(SurfaceFile, ReadsWhatOthersWrite) {
  const std::string facet =
      "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1e0 +0 0\n"
      "  vertex 0 1 0\n endloop\nendfacet\n";
  EXPECT_EQ(read(".stl", "solid a\n" + facet + facet + "endsolid a\n").vertices.size(), 3U);
  const TriangleMesh obj = read(
      ".obj",
      "# quad\nv 0 0 0\nv 1 0 0\r\nv 1 1 0 0.5\nvn 0 0 1\nv 0 1 0\ns off\nf 1/1 2//1 3/2/1 -1\n");
  EXPECT_EQ(obj.facets, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(
      read(".off", "OFF 3 1 0\n0 0 0\n1 0 0 # right\n\n0 1 0\n3 0 1 2 255 0 0\n").facets.size(),
      1U);
  const TriangleMesh xyz = read(".xyz", "1 2 3\n# none\n\n4\t5 6 0.1 0.2 0.3\n7 8 9");
  EXPECT_EQ(xyz.vertices, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
}

TEST_F(SurfaceFile, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(refusal(".xyz", "1 2 3\n1 2\n"), HasSubstr("line 2: ends too early"));
  EXPECT_THAT(refusal(".xyz", "1 2 x3\n"), HasSubstr("'x3' is no number"));
  EXPECT_THAT(refusal(".xyz", "1 2 nan\n"), HasSubstr("not finite"));
  EXPECT_THAT(refusal(".xyz", "1 2 1e999\n"), HasSubstr("no number"));
  EXPECT_THAT(refusal(".obj", "v 0 0 0\nf 1 1 2\n"), HasSubstr("vertex that is not there"));
  EXPECT_THAT(refusal(".obj", "v 0 0 0\nf 1 1 0\n"), HasSubstr("vertex that is not there"));
  EXPECT_THAT(refusal(".obj", "v 0 0 0\nf 1 1 -9223372036854775808\n"), HasSubstr("not there"));
  EXPECT_THAT(refusal(".obj", "v 0 0 0\nf 1 1\n"), HasSubstr("fewer than three"));
  EXPECT_THAT(refusal(".off", "COFF\n"), HasSubstr("begins with OFF"));
  EXPECT_THAT(refusal(".off", ""), HasSubstr("begins with OFF"));
  EXPECT_THAT(refusal(".off", "OFF\n4000000000 4 0\n0 0 0\n"), HasSubstr("fewer vertices"));
  EXPECT_THAT(refusal(".off", "OFF\n-1 4 0\n"), HasSubstr("impossible count"));
  EXPECT_THAT(refusal(".off", "OFF\n1 1 0\n0 0 0\n3 0 0\n"), HasSubstr("fewer corners"));
  EXPECT_THAT(refusal(".stl", "junk"), HasSubstr("neither text STL nor"));
  EXPECT_THAT(refusal(".stl", "solid\nvertex 0 0 0\n"), HasSubstr("cut short"));
  EXPECT_THAT(refusal(".stl", "solid\nvertex 0 0 0\nendfacet\n"), HasSubstr("three corners"));
  EXPECT_THAT(refusal(".stl", "solid a\n"), HasSubstr("not endsolid"));
  EXPECT_THAT(refusal(".off", "OFF\n1 0 0\n0 0 0\n1 1 1\n"), HasSubstr("more lines"));
  EXPECT_THAT(refusal(".step", ""), HasSubstr("no known format"));
  EXPECT_THROW((void)read_surface(file(".nowhere.xyz")), IoError);
  EXPECT_THROW(write_surface(file(".xyz"), kTetrahedron), IoError);
}

TEST_F(SurfaceFile, SurvivesDamagedBytes) {
  Rng rng(1);
  for (const std::string extension : {".stl", ".obj", ".off", ".ply"}) {
    write_surface(file(extension), kTetrahedron);
    std::ifstream in(file(extension), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    for (int i = 0; i < 150; ++i) {
      std::string damaged = whole.substr(0, 1 + rng.below(whole.size()));
      for (int k = 0; k < 3; ++k)
        damaged[rng.below(damaged.size())] = static_cast<char>(rng.below(256));
      try {
        const TriangleMesh mesh = read(extension, damaged);
        for (const Vec3& p : mesh.vertices) ASSERT_TRUE(is_finite(p));
        for (const Triangle& t : mesh.facets) {
          for (const std::uint32_t v : t) ASSERT_LT(v, mesh.vertices.size());
        }
      } catch (const IoError&) {
        continue;
      }
    }
  }
}

TEST_F(SurfaceFile, ReadsPlanarPointsFromCsv) {
  std::ofstream(file(".csv")) << "x_mm,y_mm\n1,2\n3.5; -4,note\n\n 5 6\n";
  EXPECT_EQ(read_planar_points(file(".csv")), (std::vector<Vec2>{{1, 2}, {3.5, -4}, {5, 6}}));
  std::ofstream(file(".bad.csv")) << "x,y\nx,y\n";
  EXPECT_THROW((void)read_planar_points(file(".bad.csv")), IoError);
  std::ofstream(file(".space.csv")) << "x,y,z\n0,0,1\n";
  EXPECT_THROW((void)read_planar_points(file(".space.csv")), IoError);
}

TEST_F(SurfaceFile, KeepsWholeFaces) {
  const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  const std::vector<std::vector<std::uint32_t>> faces{
      {3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  for (const char* extension : {".obj", ".off"}) {
    write_polygons(file(extension), corners, faces);
    const TriangleMesh mesh = read_surface(file(extension));
    EXPECT_EQ(mesh.vertices, corners);
    EXPECT_EQ(mesh.facets.size(), 6U);  // the square is cut in two
    EXPECT_EQ(check_surface(mesh), SurfaceStatus::Ok);
  }
  EXPECT_THROW(write_polygons(file(".stl"), corners, faces), IoError);
}

}  // namespace
}  // namespace carpus::case_io
