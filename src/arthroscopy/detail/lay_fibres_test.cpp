// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/detail/lay_fibres.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace carpus::arthroscopy::detail {
namespace {

using soft_tissue::Ligament;
using soft_tissue::Lining;
using soft_tissue::SoftTissue;

constexpr std::uint32_t kAcross = 25;
constexpr std::uint32_t kAlong = 9;

std::uint32_t vertex(std::uint32_t x, std::uint32_t y, std::uint32_t layer = 0) {
  return (layer * kAlong + y) * kAcross + x;
}

/// A closed plate, a vertex each mm: its top at z = 0, its bottom 10 mm below.
TriangleMesh plate() {
  TriangleMesh made;
  for (std::uint32_t layer = 0; layer < 2; ++layer) {
    for (std::uint32_t y = 0; y < kAlong; ++y) {
      for (std::uint32_t x = 0; x < kAcross; ++x) {
        made.vertices.push_back({double(x), double(y), -10.0 * layer});
      }
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    made.facets.push_back({a, b, c});
    made.facets.push_back({a, c, d});
  };
  for (std::uint32_t y = 0; y + 1 < kAlong; ++y) {
    for (std::uint32_t x = 0; x + 1 < kAcross; ++x) {
      quad(vertex(x, y), vertex(x + 1, y), vertex(x + 1, y + 1), vertex(x, y + 1));
      quad(vertex(x, y, 1), vertex(x, y + 1, 1), vertex(x + 1, y + 1, 1), vertex(x + 1, y, 1));
    }
  }
  for (std::uint32_t x = 0; x + 1 < kAcross; ++x) {
    const std::uint32_t last = kAlong - 1;
    quad(vertex(x, 0, 1), vertex(x + 1, 0, 1), vertex(x + 1, 0), vertex(x, 0));
    quad(vertex(x, last), vertex(x + 1, last), vertex(x + 1, last, 1), vertex(x, last, 1));
  }
  for (std::uint32_t y = 0; y + 1 < kAlong; ++y) {
    const std::uint32_t last = kAcross - 1;
    quad(vertex(0, y), vertex(0, y + 1), vertex(0, y + 1, 1), vertex(0, y, 1));
    quad(vertex(last, y, 1), vertex(last, y + 1, 1), vertex(last, y + 1), vertex(last, y));
  }
  return made;
}

/// Three strands along y, 2 mm apart from the first on.
Ligament along_y(const std::string& id, double first_mm) {
  Ligament made;
  made.id = id;
  made.width_mm = 4;
  for (int s = 0; s < 3; ++s) {
    soft_tissue::Strand strand;
    for (std::uint32_t y = 0; y < kAlong; ++y)
      strand.course.push_back({first_mm + 2 * s, double(y), 0});
    made.strands.push_back(strand);
  }
  return made;
}

struct Laid {
  SoftTissue tissue;
  TriangleMesh wall = plate();
  std::vector<Lining> lining;
  LaidFibres fibres;
};

/// Two ligaments beside each other on the top, synovium about them.
Laid two_ligaments() {
  Laid made;
  made.tissue.ligaments = {along_y("left", 4), along_y("right", 12)};
  made.lining.assign(made.wall.vertices.size(), Lining::Synovium);
  for (std::uint32_t y = 0; y < kAlong; ++y) {
    for (std::uint32_t x = 4; x <= 16; ++x) made.lining[vertex(x, y)] = Lining::Ligament;
  }
  made.fibres = lay_fibres(made.wall, made.lining, made.tissue);
  return made;
}

TEST(LayFibres, TheNearestLigamentLinesAPlaceAndNoneWhereSomethingElseDoes) {
  const Laid made = two_ligaments();
  ASSERT_EQ(check_surface(made.wall), SurfaceStatus::Ok);
  for (std::uint32_t y = 0; y < kAlong; ++y) {
    for (std::uint32_t x = 0; x < kAcross; ++x) {
      const Ligament* lines = made.fibres.ligament[vertex(x, y)];
      if (x < 4 || x > 16) {
        EXPECT_EQ(lines, nullptr);
      } else if (x != 10) {  // as far from one as from the other
        ASSERT_NE(lines, nullptr);
        EXPECT_EQ(lines->id, x < 10 ? "left" : "right") << x;
      }
      EXPECT_EQ(made.fibres.ligament[vertex(x, y, 1)], nullptr);
    }
  }
}

TEST(LayFibres, APlaceIsToldAcrossAndAlongTheStrandsInMillimetres) {
  const Laid made = two_ligaments();
  for (std::uint32_t y = 0; y < kAlong; ++y) {
    for (std::uint32_t x = 4; x <= 8; ++x) {
      const Vec3 fibre = made.fibres.fibre[vertex(x, y)];
      EXPECT_NEAR(fibre.x, x - 4.0, 1e-9);
      EXPECT_NEAR(fibre.y, y, 1e-9);
    }
    const double apart_mm = made.fibres.fibre[vertex(12, y)].x - made.fibres.fibre[vertex(4, y)].x;
    EXPECT_GT(apart_mm, made.tissue.ligaments[0].width_mm * 3) << "no two show the same bundles";
  }
}

TEST(LayFibres, FibresRunOutBesideALigamentAndFadeBetweenTwo) {
  const Laid made = two_ligaments();
  const std::uint32_t y = kAlong / 2;
  const auto well_on = [&](std::uint32_t x) { return made.fibres.fibre[vertex(x, y)].z; };
  EXPECT_EQ(well_on(6), 1);
  EXPECT_EQ(well_on(14), 1);
  EXPECT_GT(well_on(3), 0) << "beside it";
  EXPECT_EQ(well_on(22), 0) << "far from both";
  EXPECT_LT(std::min(well_on(9), std::min(well_on(10), well_on(11))), 0.5) << "between the two";
}

}  // namespace
}  // namespace carpus::arthroscopy::detail
