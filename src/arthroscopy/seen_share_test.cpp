// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/seen_share.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Vec3 kUp{0, 1, 0};

/// A hilly floor, and a ball over it that hides some of it; both as bones whose facets all count.
struct Scene {
  cases::CaseData data;
  cases::ArthroscopicMap map;
};

TriangleMesh floor_of(int cells) {
  TriangleMesh mesh;
  const auto at = [cells](int i) { return 24.0 * i / cells - 12; };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      mesh.vertices.push_back({at(i), at(j), 1.2 * std::sin(0.6 * at(i)) * std::cos(0.5 * at(j))});
    }
  }
  const auto v = [cells](int i, int j) { return static_cast<std::uint32_t>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      mesh.facets.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
      mesh.facets.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
    }
  }
  return mesh;
}

TriangleMesh ball_of(const Vec3& middle, double radius, int rings) {
  TriangleMesh mesh;
  const int around = 2 * rings;
  for (int r = 0; r <= rings; ++r) {
    for (int a = 0; a < around; ++a) {
      const double t = kPi * r / rings;
      const double p = 2 * kPi * a / around;
      mesh.vertices.push_back(
          middle +
          Vec3{std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)} * radius);
    }
  }
  const auto v = [around](int r, int a) {
    return static_cast<std::uint32_t>(r * around + a % around);
  };
  for (int r = 0; r < rings; ++r) {
    for (int a = 0; a < around; ++a) {
      mesh.facets.push_back({v(r, a), v(r + 1, a), v(r + 1, a + 1)});
      mesh.facets.push_back({v(r, a), v(r + 1, a + 1), v(r, a + 1)});
    }
  }
  return mesh;
}

Scene scene_of(int cells) {
  Scene scene;
  for (const BoneId bone : {BoneId::Radius, BoneId::Lunate}) {
    cases::Bone b;
    b.bone = bone;
    b.surface = MeshIn<frame::Bone>(bone == BoneId::Radius ? floor_of(cells)
                                                           : ball_of({2, 1, 4}, 1.8, cells / 2));
    scene.data.bones.push_back(std::move(b));
  }
  for (std::uint8_t body = 0; body < 2; ++body) {
    const TriangleMesh& mesh = scene.data.bones[body].surface;
    for (const Triangle& f : mesh.facets) {
      const Vec3& a = mesh.vertices[f[0]];
      const Vec3 n = cross(mesh.vertices[f[1]] - a, mesh.vertices[f[2]] - a);
      if (!(length(n) > 1e-12)) continue;  // at a ball's pole
      scene.map.cartilage.push_back({(a + mesh.vertices[f[1]] + mesh.vertices[f[2]]) / 3.0,
                                     n / length(n), length(n) / 2, body});
    }
  }
  return scene;
}

Sight sight_at(const Vec3& eye, double turn_deg) {
  return sight_of({30, 80}, {eye, {0, 0, 1}, turn_deg, 0}, kUp);
}

/// What a scope sees by rays cast at many points of every facet against every triangle, slowly.
double share_by_rays(const Scene& scene, const std::vector<Sight>& sights, Rng& rng) {
  double seen = 0;
  double all = 0;
  for (const cases::Bone& bone : scene.data.bones) {
    for (const Triangle& f : bone.surface.facets) {
      const Vec3& a = bone.surface.vertices[f[0]];
      const Vec3 ab = bone.surface.vertices[f[1]] - a;
      const Vec3 ac = bone.surface.vertices[f[2]] - a;
      const Vec3 n = cross(ab, ac);
      const double twice = length(n);
      if (!(twice > 1e-12)) continue;
      constexpr int kRays = 3;
      for (int k = 0; k < kRays; ++k) {
        double u = rng.uniform(0, 1);
        double v = rng.uniform(0, 1);
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const Vec3 at = a + ab * u + ac * v + n * (1e-4 / twice);
        bool is_seen = false;
        for (const Sight& s : sights) {
          const Vec3 to = at - s.eye;
          const double far = length(to);
          if (far > kUsefulMm || !is_in_field(s, at) || -dot(to, n) < kUsefulCosine * far * twice) {
            continue;
          }
          bool is_hidden = false;
          for (const cases::Bone& other : scene.data.bones) {
            for (const Triangle& g : other.surface.facets) {
              is_hidden =
                  is_hidden || meets(s.eye, at, other.surface.vertices[g[0]],
                                     other.surface.vertices[g[1]], other.surface.vertices[g[2]]);
              if (is_hidden) break;
            }
          }
          is_seen = is_seen || !is_hidden;
        }
        all += twice / kRays;
        if (is_seen) seen += twice / kRays;
      }
    }
  }
  return seen / all;
}

TEST(SeenShare, IsThatOfRaysCastAtTheTrueSurfaceToOnePercent) {
  const Scene scene = scene_of(56);
  const std::vector<Sight> sights{sight_at({-4, 0, 6}, 0), sight_at({5, 3, 7}, 140),
                                  sight_at({0, -6, 5}, -90)};
  SeenCartilage seen(scene.data, scene.map);
  for (const Sight& s : sights) seen.look(s, {});
  Rng rng(5);
  const double by_rays = share_by_rays(scene, sights, rng);
  EXPECT_GT(by_rays, 0.1);
  EXPECT_LT(by_rays, 0.9);
  EXPECT_NEAR(seen.share(), by_rays, 0.01);
}

TEST(SeenShare, NothingBehindTheBallOrTooFarOrTurnedAwayIsSeen) {
  const Scene scene = scene_of(24);
  SeenCartilage seen(scene.data, scene.map);
  seen.look(sight_of({0, 80}, {{2, 1, 9}, {0, 0, 1}, 0, 0}, kUp), {});
  for (std::size_t i = 0; i < seen.seen().size(); ++i) {
    const cases::CartilageFacet& f = scene.map.cartilage[i];
    if (f.body == 1) {
      EXPECT_FALSE(seen.seen()[i] && f.normal.z < 0) << "the ball's far side";
    } else if (std::hypot(f.at.x - 2, f.at.y - 1) < 1.8) {
      EXPECT_FALSE(seen.seen()[i]) << "under the ball";
    }
  }
  SeenCartilage from_far(scene.data, scene.map);
  from_far.look(sight_of({0, 80}, {{2, 1, 25}, {0, 0, 1}, 0, 0}, kUp), {});
  EXPECT_EQ(from_far.share(), 0.0);
}

TEST(SeenShare, ASecondLookOnlyAdds) {
  const Scene scene = scene_of(24);
  SeenCartilage seen(scene.data, scene.map);
  double before = 0;
  for (double turn = 0; turn < 360; turn += 60) {
    seen.look(sight_at({0, 0, 6}, turn), {});
    EXPECT_GE(seen.share(), before);
    before = seen.share();
  }
  EXPECT_GT(seen.share_of(0), 0.1);
  EXPECT_EQ(seen.share_of(9), 0.0);
}

/// What hides a bone hides it wherever traction has taken it.
TEST(SeenShare, TheDiscStandsBeforeWhatLiesBehindIt) {
  Scene scene = scene_of(24);
  const Sight sight = sight_of({0, 80}, {{-6, -6, 6}, {0, 0, 1}, 0, 0}, kUp);
  SeenCartilage open(scene.data, scene.map);
  open.look(sight, {});
  scene.map.disc.vertices = {{-30, -30, 4}, {30, -30, 4}, {0, 40, 4}};
  scene.map.disc.facets = {{0, 1, 2}};
  SeenCartilage covered(scene.data, scene.map);
  covered.look(sight, {});
  EXPECT_GT(open.share(), 0.05);
  EXPECT_LT(covered.share_of(0), 1e-9);
}

TEST(SeenCartilage, ALookIntoOneJointShowsNothingOfAnother) {
  Scene scene = scene_of(6);
  scene.map.cartilage.front().joint = 1;
  const double other = scene.map.cartilage.front().area_mm2;
  double all = 0;
  for (const cases::CartilageFacet& f : scene.map.cartilage) all += f.area_mm2;
  SeenCartilage seen(scene.data, scene.map);
  for (double turn = 0; turn < 360; turn += 30) {
    for (const double x : {-4.0, 0.0, 4.0}) seen.look(sight_at({x, -2, 8}, turn), {}, 1);
  }
  EXPECT_LE(seen.share(), other / all);
}

}  // namespace
}  // namespace carpus::arthroscopy
