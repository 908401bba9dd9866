// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/collide_report.hpp"
#include "survey/methods.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <initializer_list>
#include <string_view>

#include "core/error.hpp"

namespace carpus::cli {
namespace {

using convex::PairPose;
using convex::Verdict;
using survey::Method;

constexpr std::size_t kTimedQueries = 21;

/// The first of `preferred` that is registered and suits, else any that suits, else null.
template <typename Suits>
const Method* choose(std::initializer_list<std::string_view> preferred, Suits suits) {
  for (const std::string_view name : preferred) {
    const Method* method = survey::find_method(name);
    if (method != nullptr && suits(*method)) return method;
  }
  const auto methods = survey::all_methods();
  const auto found = std::find_if(methods.begin(), methods.end(), suits);
  return found == methods.end() ? nullptr : &*found;
}

double median_query_us(convex::PairQuery& query, const PairPose& pose) {
  std::array<double, kTimedQueries> times{};
  for (double& time : times) {
    query.forget();
    const auto start = std::chrono::steady_clock::now();
    (void)query.meets(pose);
    time =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }
  std::nth_element(times.begin(), times.begin() + kTimedQueries / 2, times.end());
  return times[kTimedQueries / 2];
}

void place(convex::Closest& closest, const Placement& where) {
  closest.on_first = where(closest.on_first);
  closest.on_second = where(closest.on_second);
  closest.normal = where.rotation * closest.normal;
}

void place(convex::Penetration& penetration, const Placement& where) {
  penetration.on_first = where(penetration.on_first);
  penetration.on_second = where(penetration.on_second);
  penetration.direction = where.rotation * penetration.direction;
}

void place(survey::MotionContact& contact, const Placement& where) {
  contact = {where(contact.point), where.rotation * contact.normal};
}

}  // namespace

CollideReport collide(const CollideBody& first,
                      const CollideBody& second,
                      const Method* method,
                      const std::optional<Vec3>& velocity_mm_per_s) {
  CollideReport report;
  const Mat3 back = first.placement.rotation.transposed();
  const PairPose pose{back * second.placement.rotation,
                      back * (second.placement.translation - first.placement.translation)};
  report.method =
      method != nullptr ? method : choose({"lp_growth", "gjk"}, [](const Method&) { return true; });
  if (report.method == nullptr) throw InvalidInput("collide: no method is built in");
  const auto query = report.method->make(first.hull, second.hull);
  report.verdict = query->meets(pose);
  report.query_us = median_query_us(*query, pose);

  if (report.verdict == Verdict::Apart) {
    const auto suits = [](const Method& m) { return m.gives_distance; };
    const Method* by = method != nullptr ? method : choose({"closest_active_set", "gjk"}, suits);
    if (by != nullptr && suits(*by)) {
      report.distance_method = by;
      report.closest = by->make(first.hull, second.hull)->closest(pose);
    }
  }
  if (report.verdict == Verdict::Meet) {
    const auto suits = [](const Method& m) { return m.gives_depth; };
    const Method* by = method != nullptr ? method : choose({"depth_exact", "epa"}, suits);
    if (by != nullptr && suits(*by)) {
      report.depth_method = by;
      report.penetration = by->make(first.hull, second.hull)->penetration(pose);
    }
  }
  if (report.closest) place(*report.closest, first.placement);
  if (report.penetration) place(*report.penetration, first.placement);

  report.velocity_mm_per_s = velocity_mm_per_s;
  if (velocity_mm_per_s) {
    survey::ContactIntervalQuery sweep(first.hull, second.hull);
    report.sweep = sweep.query(pose, back * *velocity_mm_per_s);
    place(report.sweep.first, first.placement);
    place(report.sweep.last, first.placement);
  }
  return report;
}

}  // namespace carpus::cli
