// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/detail/tube_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"

namespace carpus::cases::detail {
namespace {

constexpr int kPasses = 40;
constexpr int kLastPasses = 8;  ///< that only push out of bone
/// Least room between a tube's surface and bone, skin or another tube [mm].
constexpr double kFromBoneMm = 0.2;
constexpr double kFromSkinMm = 0.5;
constexpr double kFromTubeMm = 0.1;
/// How far a pass spreads a push to its neighbours, and lets a given point back to its place.
constexpr double kSpreading = 0.5;
constexpr double kHold = 0.3;

Vec3 catmull_rom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return 0.5 * (b * 2.0 + (c - a) * t + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2 +
                (b * 3.0 - a - c * 3.0 + d) * t3);
}

/// Where a point was when bone was asked for, and how far bone was from there: as far as it moved
/// since, bone can have come nearer.
struct BoneAsked {
  Vec3 at;
  double bone_mm = -std::numeric_limits<double>::infinity();
};

Vec3 out_of_bone(const Vec3& p, double radius_mm, const WristSurfaces& surfaces, BoneAsked& asked) {
  const double room = radius_mm + kFromBoneMm;
  if (asked.bone_mm - distance(p, asked.at) >= room) return p;
  const WristSurfaces::Near near = surfaces.bone_near(p);
  asked = {p, near.distance_mm};
  return near.distance_mm < room ? near.point + near.outwards * room : p;
}

Vec3 under_skin(const Vec3& p, double radius_mm, const WristSurfaces& surfaces) {
  const auto depth = surfaces.depth_at(p);
  const double room = radius_mm + kFromSkinMm;
  return depth && depth->mm < room ? depth->point - depth->outwards * room : p;
}

/// Spreads pushes along the line. The ends' pushes stay theirs.
void spread(LaidTube& tube) {
  std::vector<Vec3> push(tube.line.size());
  for (std::size_t i = 0; i < push.size(); ++i) push[i] = tube.line[i] - tube.drawn[i];
  for (const std::size_t i : tube.anchored) push[i] *= 1 - kHold;
  for (std::size_t i = 0; i < push.size(); ++i) {
    const Vec3& before = push[i > 0 ? i - 1 : 0];
    const Vec3& after = push[std::min(i + 1, push.size() - 1)];
    const Vec3 spread = push[i] + ((before + after) * 0.5 - push[i]) * kSpreading;
    tube.line[i] = tube.drawn[i] + spread;
  }
}

/// Parts two tubes where they cross or lie in each other; each gives way by half.
void part(LaidTube& a, LaidTube& b) {
  const double room = a.radius_mm + b.radius_mm + kFromTubeMm;
  for (Vec3& p : a.line) {
    Vec3* nearest = nullptr;
    double least = room;
    for (Vec3& q : b.line) {
      const double away = distance(p, q);
      if (away < least) {
        least = away;
        nearest = &q;
      }
    }
    if (nearest == nullptr || !(least > 0)) continue;
    const Vec3 way = (p - *nearest) * (0.25 * (room - least) / least);
    p += way;
    *nearest -= way;
  }
}

}  // namespace

LaidTube through(const std::vector<Vec3>& given, double radius_mm) {
  LaidTube tube;
  tube.radius_mm = radius_mm;
  const auto point = [&](std::ptrdiff_t i) {
    const auto last = static_cast<std::ptrdiff_t>(given.size()) - 1;
    // Beyond the ends the line goes on as it came.
    if (i < 0) return given[0] * 2.0 - given[1];
    if (i > last) return given[given.size() - 1] * 2.0 - given[given.size() - 2];
    return given[static_cast<std::size_t>(i)];
  };
  for (std::size_t k = 0; k + 1 < given.size(); ++k) {
    const auto i = static_cast<std::ptrdiff_t>(k);
    const double way = distance(given[k], given[k + 1]);
    const int steps = std::max(1, static_cast<int>(std::lround(way / kCourseStepMm)));
    tube.anchored.push_back(tube.drawn.size());
    for (int s = 0; s < steps; ++s) {
      tube.drawn.push_back(catmull_rom(point(i - 1), point(i), point(i + 1), point(i + 2),
                                       static_cast<double>(s) / steps));
    }
  }
  tube.anchored.push_back(tube.drawn.size());
  tube.drawn.push_back(given.back());
  tube.line = tube.drawn;
  return tube;
}

void settle(std::vector<LaidTube>& tubes, const WristSurfaces& surfaces) {
  std::vector<std::vector<BoneAsked>> asked;
  for (const LaidTube& tube : tubes) asked.emplace_back(tube.line.size());
  const auto push = [&](bool skin_too) {
    parallel_for(tubes.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t k = 0; k < tubes[i].line.size(); ++k) {
          Vec3& p = tubes[i].line[k];
          if (skin_too) p = under_skin(p, tubes[i].radius_mm, surfaces);
          p = out_of_bone(p, tubes[i].radius_mm, surfaces, asked[i][k]);
        }
      }
    });
  };
  for (int pass = 0; pass < kPasses; ++pass) {
    for (LaidTube& tube : tubes) spread(tube);
    for (std::size_t a = 0; a < tubes.size(); ++a) {
      for (std::size_t b = a + 1; b < tubes.size(); ++b) part(tubes[a], tubes[b]);
    }
    push(true);
  }
  for (int pass = 0; pass < kLastPasses; ++pass) push(false);
}

}  // namespace carpus::cases::detail
