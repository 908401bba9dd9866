// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Bytes to two bodies and a course of poses, warm from pose to pose. Methods that name no limits
// must give the exact verdict, all others must not be wrong where the bodies do not all but touch;
// distances and depths must fit the verdicts, and scenes their pairs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "collision_course.hpp"
#include "convex/exact_meeting.hpp"
#include "convex/growth/test_oracle.hpp"
#include "convex/pair_query.hpp"
#include "geometry/exact_number.hpp"
#include "geometry/tolerance.hpp"
#include "survey/lp/growth_scene.hpp"
#include "survey/methods.hpp"
#include "survey/scene.hpp"

namespace {

using carpus::ExactVec3;
using carpus::kContactToleranceMm;
using carpus::kRoundoff;
using carpus::Mat3;
using carpus::Vec3;
using carpus::convex::Closest;
using carpus::convex::ConvexBody;
using carpus::convex::exactly_meet;
using carpus::convex::PairPose;
using carpus::convex::PairQuery;
using carpus::convex::Penetration;
using carpus::convex::Verdict;
using carpus::fuzz::Bytes;
using carpus::survey::BodyPose;
using carpus::survey::BroadPhase;
using carpus::survey::GrowthScene;
using carpus::survey::Method;
using carpus::survey::relative_pose;
using carpus::survey::Scene;

constexpr std::size_t kMostPoses = 12;
/// All axes are tried for bodies with at most this many pairs of edges.
constexpr std::size_t kMostEdgePairs = 150;

std::string name_of(Verdict v) {
  return v == Verdict::Meet ? "meet" : (v == Verdict::Apart ? "apart" : "unknown");
}

std::string text_of(const Vec3& v) {
  std::array<char, 100> text{};
  std::snprintf(text.data(), text.size(), "{%.17g, %.17g, %.17g}", v.x, v.y, v.z);
  return text.data();
}

template <typename AnyPose>
std::string text_of_pose(const AnyPose& pose) {
  std::string text = "pose {{{";
  for (const Vec3& row : pose.rotation.rows) text += text_of(row) + ", ";
  return text + "}}, " + text_of(pose.translation) + "}\n";
}

std::string text_of_body(const ConvexBody& body) {
  std::string text = "body {";
  for (const Vec3& v : body.vertices()) text += text_of(v) + ", ";
  return text + "}\n";
}

[[noreturn]] void report(const std::string& wrong) {
  std::fprintf(stderr, "collision_fuzz: %s\n", wrong.c_str());
  std::abort();
}

template <typename AnyPose>
bool is_finite(const AnyPose& pose) {
  return carpus::is_finite(pose.translation) &&
         std::all_of(pose.rotation.rows.begin(), pose.rotation.rows.end(), carpus::is_finite);
}

/// A rotation or reflection to about 1e-6.
bool is_rigid(const Mat3& m) {
  constexpr double kTolerance = 1e-6;
  const Mat3 square = m * m.transposed();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (!(std::abs(square.rows[i][j] - (i == j ? 1 : 0)) < kTolerance)) return false;
    }
  }
  return true;
}

bool is_singular(const Mat3& m) {
  return dot(ExactVec3(m.rows[0]), cross(ExactVec3(m.rows[1]), ExactVec3(m.rows[2]))).sign() == 0;
}

std::size_t edge_count(const ConvexBody& body) {
  return body.vertices().size() + body.faces().size() - 2;
}

/// Lowest and highest height along n of a body.
struct Extent {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  Extent(const ConvexBody& body, const Vec3& n, const PairPose& pose) {
    for (const Vec3& v : body.vertices()) {
      const double height = dot(n, pose.rotation * v + pose.translation);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
};

/// Thinner somewhere, or with a shorter edge, than the last digits of its size: then rounding hides
/// which corner is the farthest, and only verdicts are promised.
bool is_sliver(const ConvexBody& body) {
  const double least = 1e-6 * body.radius_mm();
  for (std::uint32_t f = 0; f < body.faces().size(); ++f) {
    const Extent extent(body, body.face_plane(f).normal, {});
    if (!(extent.high - extent.low > least)) return true;
  }
  const std::span<const Vec3> vertices = body.vertices();
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    for (const std::uint32_t w : body.vertex_neighbours(v)) {
      if (!(distance(vertices[v], vertices[w]) > least)) return true;
    }
  }
  return false;
}

/// Two bodies, every method warm between them, and one pose after the other.
class Course {
 public:
  Course(const ConvexBody& first, const ConvexBody& second) : first_(first), second_(second) {
    for (const Method& method : methods_) queries_.push_back(method.make(first, second));
    is_sliver_ = is_sliver(first) || is_sliver(second);
  }

  void visit(const PairPose& pose) {
    pose_ = pose;
    expected_ = exactly_meet({&first_, Mat3::identity(), {}},
                             {&second_, pose.rotation, pose.translation}, {})
                    .verdict;
    check_judge();
    measure();
    for (std::size_t i = 0; i < queries_.size(); ++i) check(methods_[i], *queries_[i]);
  }
  void forget() {
    for (const auto& query : queries_) query->forget();
  }

 private:
  [[noreturn]] void fail(const std::string& wrong) const {
    report(wrong + "; exactly they " + name_of(expected_) + "\nfirst " + text_of_body(first_) +
           "second " + text_of_body(second_) + text_of_pose(pose_));
  }

  void check_judge() const {
    if (expected_ == Verdict::Unknown) return;
    if (edge_count(first_) * edge_count(second_) > kMostEdgePairs || is_singular(pose_.rotation)) {
      return;
    }
    const Verdict by_axes = carpus::test::verdict_by_all_axes(first_, second_, pose_);
    if (by_axes != expected_) fail("all axes: " + name_of(by_axes));
  }

  /// Sizes, and how far from touching the bodies are, by the methods that name no limits.
  void measure() {
    const double sizes = first_.radius_mm() + second_.radius_mm();
    const double least = std::min(first_.radius_mm(), second_.radius_mm());
    const double reach = length(first_.interior_point()) + length(second_.interior_point()) +
                         sizes + length(pose_.translation);
    is_ordinary_ =
        !is_sliver_ && least > 1e-2 && sizes < 1e4 && reach < 1e8 && is_rigid(pose_.rotation);
    tolerance_mm_ = 2 * kContactToleranceMm + 1e-9 * sizes + 128 * kRoundoff * reach;
    is_clear_ = false;
    if (!is_ordinary_) return;
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      if (!methods_[i].limits.empty()) continue;
      if (expected_ == Verdict::Apart) {
        const auto closest = queries_[i]->closest(pose_);
        is_clear_ = is_clear_ || (closest && closest->distance_mm > tolerance_mm_);
      } else {
        const auto depth = queries_[i]->penetration(pose_);
        is_clear_ = is_clear_ || (depth && depth->depth_mm > tolerance_mm_);
      }
    }
  }

  void check(const Method& method, PairQuery& query) const {
    const std::string name(method.name);
    const Verdict verdict = query.meets(pose_);
    if (!is_finite(pose_) && verdict != Verdict::Unknown) {
      fail(name + " says " + name_of(verdict) + " of a pose that is not finite");
    }
    const bool is_wrong = verdict != expected_ && expected_ != Verdict::Unknown;
    if (method.limits.empty()) {
      if (is_wrong && (verdict != Verdict::Unknown || is_in_scale_of(method))) {
        fail(name + " says " + name_of(verdict));
      }
    } else if (is_wrong && verdict != Verdict::Unknown && is_clear_) {
      fail(name + " says " + name_of(verdict) + ", not near to touching");
    }
    const auto closest = query.closest(pose_);
    if (closest) check(name, *closest);
    const auto depth = query.penetration(pose_);
    if (depth) check(name, *depth);
    if ((closest || depth) && !is_finite(pose_)) fail(name + " answers at no pose");
    if (!method.limits.empty() || !is_clear_) return;
    if (method.gives_distance && closest.has_value() != (expected_ == Verdict::Apart)) {
      fail(name + (closest ? " gives a distance" : " gives no distance"));
    }
    if (method.gives_depth && depth.has_value() != (expected_ == Verdict::Meet)) {
      fail(name + (depth ? " gives a depth" : " gives no depth"));
    }
  }

  /// Methods of closest/ know nothing beyond 1e-30 to 1e30 mm, the linear programs no limits.
  [[nodiscard]] bool is_in_scale_of(const Method& method) const {
    return is_ordinary_ || !(method.gives_distance || method.gives_depth);
  }

  void check(const std::string& name, const Closest& c) const {
    if (!is_finite(PairPose{Mat3{{c.on_first, c.on_second, c.normal}}, {c.distance_mm, 0, 0}})) {
      fail(name + " gives a distance that is not finite");
    }
    if (!(c.distance_mm >= 0)) fail(name + " gives a negative distance");
    if (!is_ordinary_) return;
    if (c.distance_mm > tolerance_mm_) {
      if (expected_ == Verdict::Meet) fail(name + " gives a distance");
      if (!(std::abs(length(c.normal) - 1) < 1e-9)) fail(name + " gives no unit normal");
      const double slab = Extent(second_, c.normal, pose_).low - Extent(first_, c.normal, {}).high;
      if (!(slab >= c.distance_mm - tolerance_mm_)) fail(name + " gives too large a distance");
    }
    if (!(std::abs(distance(c.on_first, c.on_second) - c.distance_mm) <= tolerance_mm_)) {
      fail(name + " gives points not at its distance");
    }
  }

  void check(const std::string& name, const Penetration& p) const {
    if (!is_finite(PairPose{Mat3{{p.on_first, p.on_second, p.direction}}, {p.depth_mm, 0, 0}})) {
      fail(name + " gives a depth that is not finite");
    }
    if (!(p.depth_mm >= 0)) fail(name + " gives a negative depth");
    if (!is_ordinary_) return;
    if (p.depth_mm > tolerance_mm_ && expected_ == Verdict::Apart) fail(name + " gives a depth");
    if (!(std::abs(length(p.direction) - 1) < 1e-9)) fail(name + " gives no unit direction");
    const double left =
        Extent(first_, p.direction, {}).high - Extent(second_, p.direction, pose_).low - p.depth_mm;
    constexpr double kEpaToleranceMm = 1e-6;
    if (!(left <= tolerance_mm_ + kEpaToleranceMm)) fail(name + " gives too small a depth");
  }

  std::span<const Method> methods_ = carpus::survey::all_methods();
  const ConvexBody& first_;
  const ConvexBody& second_;
  std::vector<std::unique_ptr<PairQuery>> queries_;
  PairPose pose_;
  Verdict expected_ = Verdict::Unknown;
  double tolerance_mm_ = 0;  ///< of methods that name limits
  bool is_sliver_ = false;
  bool is_ordinary_ = false;  ///< sizes of bones, moved rigidly
  bool is_clear_ = false;     ///< not near to touching
};

/// The two bodies and the first one again, moved in the world.
class Scenes {
 public:
  Scenes(const ConvexBody& first, const ConvexBody& second)
      : bodies_{first, second, first},
        growth_(std::array<const ConvexBody*, 3>{&bodies_[0], &bodies_[1], &bodies_[2]}) {
    constexpr std::array kPhases{BroadPhase::None, BroadPhase::AllBoxes, BroadPhase::SweepAndPrune};
    for (const BroadPhase phase : kPhases) {
      boxed_.emplace_back(bodies_, *carpus::survey::find_method("lp_growth"), phase);
    }
  }

  void visit(const std::array<BodyPose, 3>& poses) {
    (void)growth_.update(poses);
    for (std::size_t p = 0; p < growth_.pair_count(); ++p) {
      const auto [i, j] = growth_.pair(p);
      compare("growth scene", poses, p, growth_.verdicts()[p],
              exactly_meet({&bodies_[i], poses[i].rotation, poses[i].translation},
                           {&bodies_[j], poses[j].rotation, poses[j].translation}, {})
                  .verdict);
    }
    if (!std::all_of(poses.begin(), poses.end(),
                     [](const BodyPose& pose) { return is_rigid(pose.rotation); })) {
      return;
    }
    for (Scene& scene : boxed_) {
      (void)scene.update(poses);
      for (std::size_t p = 0; p < scene.pair_count(); ++p) {
        const auto [i, j] = scene.pair(p);
        const PairPose pose = relative_pose(poses[i], poses[j]);
        const Verdict expected = exactly_meet({&bodies_[i], Mat3::identity(), {}},
                                              {&bodies_[j], pose.rotation, pose.translation}, {})
                                     .verdict;
        if (expected == Verdict::Unknown && is_finite(poses[i]) && is_finite(poses[j])) {
          continue;  // boxes may know
        }
        compare("scene", poses, p, scene.verdicts()[p], expected);
      }
    }
  }
  void forget() {
    growth_.forget();
    for (Scene& scene : boxed_) scene.forget();
  }

 private:
  void compare(const std::string& who,
               const std::array<BodyPose, 3>& poses,
               std::size_t pair,
               Verdict verdict,
               Verdict expected) const {
    if (verdict == expected) return;
    std::string text = who + " says " + name_of(verdict) + " of pair " + std::to_string(pair) +
                       "; exactly they " + name_of(expected) + "\n";
    for (std::size_t i = 0; i < poses.size(); ++i) {
      text += text_of_body(bodies_[i]) + text_of_pose(poses[i]);
    }
    report(text);
  }

  std::vector<ConvexBody> bodies_;
  GrowthScene growth_;
  std::vector<Scene> boxed_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const auto first = carpus::fuzz::body_from(bytes);
  if (!first) return 0;
  const auto second = carpus::fuzz::body_from(bytes);
  if (!second) return 0;
  Course course(*first, *second);
  Scenes scenes(*first, *second);
  std::array<BodyPose, 3> in_world;
  PairPose pose;
  for (std::size_t i = 0; i < kMostPoses && bytes.left() > 0; ++i) {
    const std::uint8_t b = bytes.byte();
    if (b % 4 == 0) {
      course.forget();
      scenes.forget();
    }
    pose = carpus::fuzz::pose_from(bytes, *first, *second, pose);
    course.visit(pose);
    in_world[1U + b / 4U % 2U] = {pose.rotation, pose.translation};
    if (b >= 224) in_world[0] = {pose.rotation, pose.translation};
    scenes.visit(in_world);
    if (!is_finite(pose)) pose = {};
  }
  return 0;
}
