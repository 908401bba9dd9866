// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Every method between convex bodies against exact arithmetic, warm and cold, on seeded pairs of
// all kinds (pair_generator.hpp). A method that names no limits must never be wrong; one that
// names some may be where the bodies all but touch. CARPUS_LONG=1 runs 1 000 000 posed pairs,
// CARPUS_QUICK=1 some hundreds.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <vector>

#include "convex/pair_query.hpp"
#include "core/amount_test_support.hpp"
#include "oracles/exact_meet.hpp"
#include "oracles/pair_generator.hpp"
#include "oracles/separating_axes.hpp"
#include "survey/methods.hpp"

namespace carpus::oracles {
namespace {

using convex::Closest;
using convex::ConvexBody;
using convex::PairPose;
using convex::PairQuery;
using convex::Penetration;
using convex::Verdict;
using survey::Method;

constexpr std::uint64_t kPosesPerPair = 10;

std::uint64_t pair_count() { return test::amount<std::uint64_t>(30, 300, 100'000); }

struct Tally {
  std::uint64_t asked = 0;
  std::uint64_t wrong = 0;
  std::uint64_t wrong_near = 0;  ///< of those, where the bodies touch up to rounding
  std::uint64_t unknown = 0;
  std::uint64_t first_wrong_seed = 0;
  void add(Verdict verdict, bool meet, bool is_near, std::uint64_t seed) {
    ++asked;
    if (verdict == Verdict::Unknown) ++unknown;
    if (verdict == Verdict::Unknown || (verdict == Verdict::Meet) == meet) return;
    if (wrong == 0) first_wrong_seed = seed;
    ++wrong;
    wrong_near += is_near;
  }
};

TEST(MethodsOracle, NoVerdictDiffersFromExactArithmetic) {
  const auto methods = survey::all_methods();
  std::vector<Tally> tallies(methods.size());
  std::uint64_t meeting = 0;
  std::uint64_t by_integers = 0;
  for (std::uint64_t seed = 0; seed < pair_count(); ++seed) {
    PairGenerator pairs(seed);
    ExactMeet exact(pairs.first.vertices, pairs.second.vertices);
    const ConvexBody first(pairs.first);
    const ConvexBody second(pairs.second);
    std::vector<std::unique_ptr<PairQuery>> queries;
    for (const Method& m : methods) queries.push_back(m.make(first, second));
    for (std::uint64_t i = 0; i < kPosesPerPair; ++i) {
      const Placement p = pairs.next();
      const ExactMeet::Answer answer = exact.query(p.rotation, p.translation);
      meeting += answer.meet;
      by_integers += answer.needed_integers;
      for (std::size_t k = 0; k < queries.size(); ++k) {
        if (i % 4 == 0) queries[k]->forget();
        tallies[k].add(queries[k]->meets({p.rotation, p.translation}), answer.meet,
                       p.is_near || answer.needed_integers, seed);
      }
    }
  }
  const std::uint64_t asked = pair_count() * kPosesPerPair;
  EXPECT_GT(meeting, asked / 5);
  EXPECT_GT(asked - meeting, asked / 5);
  EXPECT_GT(by_integers, asked / 20);
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const Tally& t = tallies[k];
    std::cout << methods[k].name << ": " << t.asked << " asked, " << t.wrong << " wrong ("
              << t.wrong_near << " of them touching up to rounding), " << t.unknown << " unknown\n";
    const bool is_exact = methods[k].limits.empty();
    EXPECT_EQ(is_exact ? t.wrong + t.unknown : t.wrong - t.wrong_near, 0U)
        << methods[k].name << ", first at seed " << t.first_wrong_seed;
  }
}

/// Lowest and highest value along n of the vertices of a body, in long double.
struct Interval {
  long double low = 1e300L;
  long double high = -1e300L;
};
Interval extent_along(const Body<long double>& body, const Vec3& n) {
  Interval e;
  for (const auto& v : body.vertices) {
    const long double s = dot_of<long double>({n.x, n.y, n.z}, v);
    e.low = std::min(e.low, s);
    e.high = std::max(e.high, s);
  }
  return e;
}

/// How far a point is outside a body, by its facets.
long double outside(const Body<long double>& body, const Vec3& p, const ConvexPolytope& shape) {
  long double most = -1e300L;
  for (std::size_t f = 0; f < shape.facets.size(); ++f) {
    const auto& n = body.normals[f];
    const long double size = std::sqrt(dot_of(n, n));
    if (!(size > 0)) continue;
    const auto& a = body.vertices[shape.facets[f][0]];
    most = std::max(most, dot_of(n, minus<long double>({p.x, p.y, p.z}, a)) / size);
  }
  return most;
}

/// By how much the answer fails to prove itself: the points lie in the bodies (an upper bound) and
/// a slab parts them (a lower one).
long double error_of(const Closest& c,
                     const PairGenerator& pairs,
                     const Body<long double>& first,
                     const Body<long double>& second) {
  const long double slab = extent_along(second, c.normal).low - extent_along(first, c.normal).high;
  return std::max(
      {outside(first, c.on_first, pairs.first), outside(second, c.on_second, pairs.second),
       std::abs(static_cast<long double>(distance(c.on_first, c.on_second)) - c.distance_mm),
       c.distance_mm - slab});
}

/// Against the least overlap along any axis; moving the second by the answer must part the bodies.
long double error_of(const Penetration& p,
                     const Body<long double>& first,
                     const Body<long double>& second) {
  const long double along =
      extent_along(first, p.direction).high - extent_along(second, p.direction).low;
  return std::max(std::abs(along - p.depth_mm), std::abs(p.depth_mm + separation(first, second)));
}

struct Errors {
  std::uint64_t distances = 0;
  std::uint64_t depths = 0;
  std::uint64_t missing = 0;   ///< no answer where there is one
  std::uint64_t invented = 0;  ///< one where there is none
  long double largest = 0;     ///< of the coordinates' size
  std::uint64_t worst_seed = 0;
  void add(long double error, std::uint64_t seed) {
    if (error > largest) {
      largest = error;
      worst_seed = seed;
    }
  }
};

/// Gaps below this some methods take for contact, and say so (methods.cpp) [mm].
constexpr long double kMostContactGap = 2e-9L;

/// What a method's answers may be off by, of the coordinates' size. The expanding polytope's depth
/// is to 1e-6 mm only where its 128 corners suffice.
long double tolerance_of(const Method& method) { return method.name == "epa" ? 1e-3L : 1e-9L; }

TEST(MethodsOracle, DistancesAndDepthsProveThemselves) {
  const auto methods = survey::all_methods();
  std::vector<Errors> errors(methods.size());
  for (std::uint64_t seed = 0; seed < pair_count() / 10; ++seed) {
    PairGenerator pairs(seed);
    ExactMeet exact(pairs.first.vertices, pairs.second.vertices);
    const ConvexBody first(pairs.first);
    const ConvexBody second(pairs.second);
    const auto first_oracle = body_of<long double>(pairs.first, Mat3::identity(), {});
    std::vector<std::unique_ptr<PairQuery>> queries;
    for (const Method& m : methods) queries.push_back(m.make(first, second));
    for (std::uint64_t i = 0; i < kPosesPerPair; ++i) {
      const Placement p = pairs.next();
      const PairPose pose{p.rotation, p.translation};
      const ExactMeet::Answer answer = exact.query(p.rotation, p.translation);
      if (p.is_near || answer.needed_integers) continue;
      const auto second_oracle = body_of<long double>(pairs.second, p.rotation, p.translation);
      const auto gap = [&] { return std::abs(separation(first_oracle, second_oracle)); };
      double reach = pairs.size_mm + length(p.translation);
      for (const Vec3& v : pairs.first.vertices) reach = std::max(reach, length(v));
      for (std::size_t k = 0; k < methods.size(); ++k) {
        Errors& e = errors[k];
        if (methods[k].gives_distance) {
          const auto closest = queries[k]->closest(pose);
          ++e.distances;
          const bool is_wrong = closest.has_value() == answer.meet;
          const bool takes_gaps_for_contact =
              methods[k].limits.find("1e-9 mm") != std::string_view::npos;
          const bool counts = is_wrong && (!takes_gaps_for_contact || gap() > kMostContactGap);
          e.missing += counts && !answer.meet ? 1 : 0;
          e.invented += counts && answer.meet ? 1 : 0;
          if (closest && !answer.meet) {
            e.add(error_of(*closest, pairs, first_oracle, second_oracle) / reach, seed);
          }
        }
        if (methods[k].gives_depth) {
          const auto depth = queries[k]->penetration(pose);
          ++e.depths;
          e.missing += answer.meet && !depth ? 1 : 0;
          e.invented += depth && !answer.meet ? 1 : 0;
          if (depth && answer.meet)
            e.add(error_of(*depth, first_oracle, second_oracle) / reach, seed);
        }
      }
    }
  }
  for (std::size_t k = 0; k < methods.size(); ++k) {
    const Errors& e = errors[k];
    if (e.distances + e.depths == 0) continue;
    std::cout << methods[k].name << ": " << e.distances << " distances, " << e.depths
              << " depths, largest error " << static_cast<double>(e.largest)
              << " of the coordinates, " << e.missing << " missing\n";
    EXPECT_EQ(e.invented, 0U) << methods[k].name;
    const bool may_go_round = methods[k].limits.find("goes round") != std::string_view::npos;
    EXPECT_LE(e.missing, may_go_round ? e.distances / 10'000 : 0U) << methods[k].name;
    EXPECT_LT(e.largest, tolerance_of(methods[k])) << methods[k].name << ", seed " << e.worst_seed;
  }
}

}  // namespace
}  // namespace carpus::oracles
