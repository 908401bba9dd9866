// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct/surface_truth.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "case_io/surface_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace carpus::reconstruct {
namespace {

namespace fs = std::filesystem;

/// A rod along z from 0, with a round head there and cut flat at `length`.
TriangleMesh rod(double radius, double length) {
  constexpr std::uint32_t kAround = 64;
  constexpr std::uint32_t kRings = 40;
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, -radius});
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    const double t = static_cast<double>(ring) / kRings;
    // A half ball, then the shaft.
    const double angle = std::min(1.0, 2 * t) * kPi / 2;
    const double r = radius * std::sin(angle);
    const double z = t <= 0.5 ? -radius * std::cos(angle) : length * (2 * t - 1);
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double a = 2 * kPi * i / kAround;
      mesh.vertices.push_back({r * std::cos(a), r * std::sin(a), z});
    }
  }
  mesh.vertices.push_back({0, 0, length});
  const auto at = [](std::uint32_t ring, std::uint32_t i) {
    return 1 + ring * kAround + i % kAround;
  };
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t i = 0; i < kAround; ++i) {
    mesh.facets.push_back({0, at(0, i + 1), at(0, i)});
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      mesh.facets.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i)});
      mesh.facets.push_back({at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)});
    }
    mesh.facets.push_back({last, at(kRings - 1, i), at(kRings - 1, i + 1)});
  }
  return mesh;
}

TEST(SurfaceTruth, OfTheSameSurfaceIsZeroAndOfAWiderOneTheDifference) {
  const SurfaceDistance same = distance_between(rod(4, 12), rod(4, 12));
  EXPECT_EQ(same.most_mm, 0);
  const SurfaceDistance wider = distance_between(rod(4.1, 12), rod(4, 12));
  EXPECT_NEAR(wider.mean_mm, 0.1, 0.01);
  EXPECT_NEAR(wider.p95_mm, 0.1, 0.01);
}

TEST(SurfaceTruth, BeyondATruthThatWasCutNothingIsCompared) {
  // The shaft goes on in the scan; its rim is not the bone's.
  EXPECT_LT(distance_between(rod(4, 20), rod(4, 12)).most_mm, 0.01);
  // The other way round part of the bone was not found.
  EXPECT_NEAR(distance_between(rod(4, 12), rod(4, 20)).most_mm, 20 - 12 - 1.5, 0.5);
}

class TrueSurfaces : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("carpus_true_surfaces_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(TrueSurfaces, AreReadByTheirNames) {
  case_io::write_surface(folder_ / "scaphoid_distal_fragment.ply", rod(3, 8));
  case_io::write_surface(folder_ / "radius.stl", rod(4, 8));
  std::ofstream(folder_ / "notes.txt") << "not a bone";
  const auto found = read_true_surfaces(folder_);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].label, 1);
  EXPECT_EQ(found[1].label, kScaphoidDistalLabel);
  EXPECT_FALSE(found[1].surface.facets.empty());
}

TEST_F(TrueSurfaces, SayWhatIsWrong) {
  EXPECT_THROW((void)read_true_surfaces(folder_ / "none"), IoError);
  EXPECT_THROW((void)read_true_surfaces(folder_), InvalidInput);
  std::ofstream(folder_ / "radius.ply")
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n";
  EXPECT_THROW((void)read_true_surfaces(folder_), IoError);
}

/// What reading `folder` says; "no error" where it is read.
std::string complaint_of(const fs::path& folder) {
  try {
    (void)read_true_surfaces(folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// A surface of two triangles with a first vertex at `x` and facets as given.
void write_off(const fs::path& file, const std::string& x, const std::string& facets, int count) {
  std::ofstream(file) << "OFF\n4 " << count << " 0\n"
                      << x << " 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                      << facets;
}

TEST_F(TrueSurfaces, ThatHaveNoNumbersAreRefusedByName) {
  for (const char* const x : {"nan", "inf", "-inf", "1e300", "20000"}) {
    write_off(folder_ / "radius.off", x, "3 0 1 2\n3 0 2 3\n", 2);
    const std::string said = complaint_of(folder_);
    EXPECT_NE(said.find("radius.off"), std::string::npos) << x << ": " << said;
  }
  write_off(folder_ / "radius.off", "20000", "3 0 1 2\n", 1);
  EXPECT_NE(complaint_of(folder_).find("export it again in mm"), std::string::npos);
  fs::remove(folder_ / "radius.off");
  TriangleMesh mesh = rod(4, 8);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (const char* const name : {"radius.ply", "radius.stl", "radius.obj"}) {
      mesh.vertices[3].y = bad;
      case_io::write_surface(folder_ / name, mesh);
      const std::string said = complaint_of(folder_);
      EXPECT_NE(said.find(name), std::string::npos) << said;
      EXPECT_NE(said.find(';'), std::string::npos) << "does not say what to do: " << said;
      fs::remove(folder_ / name);
    }
  }
}

TEST_F(TrueSurfaces, WithoutASurfaceAreRefused) {
  std::ofstream(folder_ / "lunate.xyz") << "1 2 3\n4 5 6\n";
  EXPECT_NE(complaint_of(folder_).find("holds no facets; give"), std::string::npos);
  fs::remove(folder_ / "lunate.xyz");
  write_off(folder_ / "lunate.off", "0", "", 0);
  EXPECT_NE(complaint_of(folder_).find("holds no facets; give"), std::string::npos);
  write_off(folder_ / "lunate.off", "0", "3 0 0 1\n3 1 1 1\n", 2);
  EXPECT_NE(complaint_of(folder_).find("no facet with an area; export"), std::string::npos);
  std::ofstream(folder_ / "lunate.off").close();
  EXPECT_NE(complaint_of(folder_).find("lunate.off"), std::string::npos);
}

TEST_F(TrueSurfaces, OfMillionsOfFacetsAreRefused) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.facets.assign(2'000'000, {0, 1, 2});
  case_io::write_surface(folder_ / "capitate.ply", mesh);
  EXPECT_EQ(complaint_of(folder_), "no error");
  mesh.facets.push_back({0, 1, 2});
  case_io::write_surface(folder_ / "capitate.ply", mesh);
  EXPECT_NE(complaint_of(folder_).find("has 2000001 facets, more than 2000000; simplify it"),
            std::string::npos);
}

TEST_F(TrueSurfaces, FoldersAndFilesAreToldApart) {
  fs::create_directory(folder_ / "radius.ply");
  EXPECT_NE(complaint_of(folder_).find("is no file; give the bone's surface in its place"),
            std::string::npos);
  fs::remove(folder_ / "radius.ply");
  case_io::write_surface(folder_ / "radius.ply", rod(4, 8));
  EXPECT_NE(complaint_of(folder_ / "radius.ply").find("is no folder; give one"), std::string::npos);
  case_io::write_surface(folder_ / "radius.stl", rod(4, 8));
  EXPECT_NE(complaint_of(folder_).find("keep the one to compare with"), std::string::npos);
}

}  // namespace
}  // namespace carpus::reconstruct
