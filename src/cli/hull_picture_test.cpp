// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/hull_picture.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::cli {
namespace {

std::array<int, 3> pixel(const Picture& p, std::uint32_t x, std::uint32_t y) {
  const std::size_t at = 3 * (std::size_t{y} * p.width + x);
  return {p.rgb[at], p.rgb[at + 1], p.rgb[at + 2]};
}
constexpr std::array kPaper{255, 255, 255};

std::vector<Vec3> cube() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back({10.0 * (i & 1), 10.0 * (i >> 1 & 1), 10.0 * (i >> 2)});
  }
  return points;
}

TEST(HullPicture, ShowsTheHullOverTheObject) {
  const auto hull = hull::build_fast_hull(cube());
  const Picture cloud = draw_hull({cube(), {}}, hull.polytope);
  const Picture solid = draw_hull(hull.polytope.surface(), hull.polytope);
  ASSERT_EQ(cloud.rgb.size(), std::size_t{3} * cloud.width * cloud.height);
  EXPECT_EQ(pixel(solid, 5, 5), kPaper);
  const std::uint32_t mid = solid.width / 2;
  const auto through = pixel(cloud, mid - 40, mid + 60);  // only the translucent hull
  const auto on_object = pixel(solid, mid - 40, mid + 60);
  EXPECT_NE(through, kPaper);
  EXPECT_GT(through[2], through[0]);  // bluish
  EXPECT_LT(on_object[2], through[2]);
}

TEST(HullPicture, ShowsPointsInThePlaneWithinTheirHull) {
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 2}, {0, 2}, {2, 1}};
  const Picture picture = draw_planar_hull(points, std::vector<std::uint32_t>{0, 1, 2, 3});
  EXPECT_NE(pixel(picture, picture.width / 2, picture.height / 2), kPaper);  // the inner point
  EXPECT_EQ(pixel(picture, picture.width / 2 + 50, picture.height / 2), kPaper);
  EXPECT_NE(pixel(picture, 40, picture.height / 2), kPaper);  // the left edge of the hull
  EXPECT_EQ(pixel(picture, 30, picture.height / 2), kPaper);
}

TEST(HullPicture, IsWrittenAsPng) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("carpus_picture_" + std::to_string(::getpid()) + ".png");
  write_png(file, {2, 1, {0, 0, 0, 255, 255, 255}});
  std::string start(8, '\0');
  std::ifstream(file, std::ios::binary).read(start.data(), 8);
  std::filesystem::remove(file);
  EXPECT_EQ(start, "\x89PNG\r\n\x1a\n");
  EXPECT_THROW(write_png("/nowhere/at/all.png", {1, 1, {0, 0, 0}}), IoError);
}

}  // namespace
}  // namespace carpus::cli
