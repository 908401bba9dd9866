// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cases/detail/tube_course.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "geometry/segment_distance.hpp"

namespace carpus::cases::detail {
namespace {

/// In the first a push spreads, less and less; in the last each place gives way alone.
constexpr int kSpreadingPasses = 60;
constexpr int kLastPasses = 60;
constexpr int kLastRoughPasses = 8;
/// Where lines stay near given points: with no hold left what is short and wedged folds.
constexpr double kLeastRoughShare = 0.4;
/// Walls are flat, and neighbours who they are, for so many passes.
constexpr int kLookEvery = 4;
/// Least room between a tube's surface and bone, a soft body, another tube or the skin [mm].
constexpr double kFromBoneMm = 0.2;
constexpr double kFromSoftMm = 0.1;
constexpr double kFromTubeMm = 0.1;
constexpr double kFromSkinMm = 0.5;
/// Of that room so much may be missing: what was settled stays so [mm].
constexpr double kSettledMm = 0.1;
/// How much farther walls and neighbours are looked for: as far as a tube goes until it looks anew.
constexpr double kReachMm = 1.0;
/// Places on each piece of a line that are asked for walls: half a mm apart.
constexpr int kAskedOnAPiece = 3;
/// How much a sweep spreads a push to its neighbours, how many a pass has; and how far a pass lets
/// a given point back to its place.
constexpr double kSpreading = 0.5;
constexpr int kSweeps = 4;
constexpr double kHold = 0.3;

Vec3 catmull_rom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
  const double t2 = t * t;
  const double t3 = t2 * t;
  return 0.5 * (b * 2.0 + (c - a) * t + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2 +
                (b * 3.0 - a - c * 3.0 + d) * t3);
}

/// A place on a tube's line.
struct OnLine {
  std::size_t piece = 0;
  double t = 0;
};

Vec3 at(const LaidTube& tube, const OnLine& place) {
  const Vec3& a = tube.line[place.piece];
  if (!(place.t > 0)) return a;
  return a + (tube.line[place.piece + 1] - a) * place.t;
}

/// Moves the place by so much, and its piece's ends by the least that does it.
void move(LaidTube& tube, const OnLine& place, const Vec3& by) {
  const double squares = (1 - place.t) * (1 - place.t) + place.t * place.t;
  tube.line[place.piece] += by * ((1 - place.t) / squares);
  if (place.t > 0) tube.line[place.piece + 1] += by * (place.t / squares);
}

/// A flat wall before a place on a tube's line.
struct WallBefore {
  OnLine place;
  Vec3 point;
  Vec3 outwards;
  double room_mm = 0;
};

double missing_mm(const LaidTube& tube, const WallBefore& wall) {
  return wall.room_mm - dot(at(tube, wall.place) - wall.point, wall.outwards);
}

struct Walls {
  std::vector<WallBefore> skin;
  std::vector<WallBefore> hard;  ///< bone and soft bodies
};

Walls walls_of(const LaidTube& tube, const WristSurfaces& surfaces) {
  Walls walls;
  std::vector<WristSurfaces::Wall> near;
  for (std::size_t i = 0; i < tube.line.size(); ++i) {
    const int asked = i + 1 < tube.line.size() ? kAskedOnAPiece : 1;
    for (int k = 0; k < asked; ++k) {
      const OnLine place{i, static_cast<double>(k) / kAskedOnAPiece};
      const Vec3 p = at(tube, place);
      surfaces.walls_near(p, tube.radius_mm, kFromSoftMm, tube.radius_mm + kFromBoneMm + kReachMm,
                          near);
      for (const WristSurfaces::Wall& w : near) {
        walls.hard.push_back({place, w.near.point, w.near.outwards,
                              tube.radius_mm + (w.is_bone ? kFromBoneMm : kFromSoftMm)});
      }
      if (k > 0) continue;
      const auto depth = surfaces.depth_at(p);
      const double room = tube.radius_mm + kFromSkinMm;
      if (depth && depth->mm < room + kReachMm) {
        walls.skin.push_back({place, depth->point, -depth->outwards, room});
      }
    }
  }
  return walls;
}

/// Pieces of two tubes' lines that may come to touch.
struct Neighbours {
  LaidTube* a = nullptr;
  LaidTube* b = nullptr;
  std::size_t on_a = 0;
  std::size_t on_b = 0;
};

double room_between(const Neighbours& n) { return n.a->radius_mm + n.b->radius_mm + kFromTubeMm; }

std::vector<Neighbours> neighbours_among(std::vector<LaidTube>& tubes) {
  std::vector<Neighbours> found;
  for (std::size_t a = 0; a < tubes.size(); ++a) {
    for (std::size_t b = a + 1; b < tubes.size(); ++b) {
      Neighbours n{&tubes[a], &tubes[b]};
      const double near = room_between(n) + kReachMm + 2 * kCourseStepMm;
      for (n.on_a = 0; n.on_a + 1 < n.a->line.size(); ++n.on_a) {
        for (n.on_b = 0; n.on_b + 1 < n.b->line.size(); ++n.on_b) {
          const Vec3 way = n.a->line[n.on_a] - n.b->line[n.on_b];
          if (squared_length(way) < near * near) found.push_back(n);
        }
      }
    }
  }
  return found;
}

/// Parts two pieces by what room they lack; each gives way by half.
/// @return that lack, negative where there is room.
double part(const Neighbours& n, bool only_look) {
  const auto [s, t] = nearest_on_segments(n.a->line[n.on_a], n.a->line[n.on_a + 1],
                                          n.b->line[n.on_b], n.b->line[n.on_b + 1]);
  const OnLine on_a{n.on_a, s};
  const OnLine on_b{n.on_b, t};
  const Vec3 way = at(*n.a, on_a) - at(*n.b, on_b);
  const double away = length(way);
  const double missing = room_between(n) - away;
  if (only_look || !(missing > 0) || !(away > 0)) return missing;
  const Vec3 by = way * (0.5 * missing / away);
  move(*n.a, on_a, by);
  move(*n.b, on_b, -by);
  return missing;
}

/// Spreads pushes along the line, of which a point stays where it was: pushed along the line points
/// would crowd.
void spread(LaidTube& tube, double share) {
  const std::size_t last = tube.line.size() - 1;
  std::vector<Vec3> push(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const Vec3 along =
        normalized_or(tube.drawn[std::min(i + 1, last)] - tube.drawn[i > 0 ? i - 1 : 0], {});
    const Vec3 by = tube.line[i] - tube.drawn[i];
    push[i] = (by - along * dot(by, along)) * (1 - share * tube.hold[i]);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const std::vector<Vec3> before = push;
    for (std::size_t i = 0; i <= last; ++i) {
      const Vec3& one = before[i > 0 ? i - 1 : 0];
      const Vec3& other = before[std::min(i + 1, last)];
      push[i] += ((one + other) * 0.5 - before[i]) * (share * kSpreading);
    }
  }
  for (std::size_t i = 0; i <= last; ++i) tube.line[i] = tube.drawn[i] + push[i];
}

/// All tubes, and what stands in their way.
class Tubes {
 public:
  Tubes(std::vector<LaidTube>& tubes, const WristSurfaces& surfaces)
      : tubes_(tubes), surfaces_(surfaces), walls_(tubes.size()) {}

  void look() {
    parallel_for(tubes_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) walls_[i] = walls_of(tubes_[i], surfaces_);
    });
    neighbours_ = neighbours_among(tubes_);
  }

  void spread_pushes(double share) {
    for (LaidTube& tube : tubes_) spread(tube, share);
  }

  /// What is last has its way: no tube in bone, rather one in another.
  void give_way() {
    for (const Neighbours& n : neighbours_) part(n, false);
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      for (const auto* walls : {&walls_[i].skin, &walls_[i].hard}) {
        for (const WallBefore& w : *walls) {
          const double missing = missing_mm(tubes_[i], w);
          if (missing > 0) move(tubes_[i], w.place, w.outwards * missing);
        }
      }
    }
  }

  /// Of the room to walls and other tubes, by what was looked at last.
  [[nodiscard]] bool is_settled() const {
    for (std::size_t i = 0; i < tubes_.size(); ++i) {
      for (const WallBefore& w : walls_[i].hard) {
        if (missing_mm(tubes_[i], w) > kSettledMm) return false;
      }
    }
    return std::all_of(neighbours_.begin(), neighbours_.end(),
                       [](const Neighbours& n) { return part(n, true) <= kSettledMm; });
  }

 private:
  std::vector<LaidTube>& tubes_;
  const WristSurfaces& surfaces_;
  std::vector<Walls> walls_;
  std::vector<Neighbours> neighbours_;
};

}  // namespace

LaidTube through(const std::vector<Vec3>& given, double radius_mm) {
  LaidTube tube;
  std::vector<std::size_t> held;
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
    held.push_back(tube.drawn.size());
    for (int s = 0; s < steps; ++s) {
      tube.drawn.push_back(catmull_rom(point(i - 1), point(i), point(i + 1), point(i + 2),
                                       static_cast<double>(s) / steps));
    }
  }
  held.push_back(tube.drawn.size());
  tube.drawn.push_back(given.back());
  tube.hold.resize(tube.drawn.size());
  for (const std::size_t i : held) tube.hold[i] = kHold;
  tube.line = tube.drawn;
  return tube;
}

void settle(std::vector<LaidTube>& tubes, const WristSurfaces& surfaces, Settling how) {
  Tubes all(tubes, surfaces);
  all.look();
  if (all.is_settled()) return;
  const int last = how == Settling::Roughly ? kLastRoughPasses : kLastPasses;
  const double least_share = how == Settling::Roughly ? kLeastRoughShare : 0;
  for (int pass = 0; pass < kSpreadingPasses + last; ++pass) {
    if (pass > 0 && pass % kLookEvery == 0) all.look();
    const double share = 1 - static_cast<double>(pass) / kSpreadingPasses;
    if (share > 0) all.spread_pushes(std::max(share, least_share));
    all.give_way();
  }
}

}  // namespace carpus::cases::detail
