// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/sectioning_check.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/error.hpp"

namespace carpus::soft_tissue {
namespace {

using Kind = PublishedStatement::Kind;

const BodyTurn& turn_of(const RestingWrist& wrist, BoneId bone) {
  return bone == BoneId::Lunate ? wrist.lunate : wrist.scaphoid;
}

double apart_deg(const BodyTurn& a, const BodyTurn& b) {
  const double x = a.twist_deg - b.twist_deg;
  const double y = a.flexion_deg - b.flexion_deg;
  const double z = a.radial_deviation_deg - b.radial_deviation_deg;
  return std::sqrt(x * x + y * y + z * z);
}

class Comparison {
 public:
  Comparison(const SectioningResult& result, const SectioningTable& table)
      : result_(result), table_(table) {}

  /// Nothing where a rest was not found.
  std::optional<double> ours(const PublishedStatement& s) const {
    const std::string& intact = table_.cuts.front().id;
    switch (s.kind) {
      case Kind::BoneChange:
      case Kind::SlAngleChange: {
        const RestingWrist& before = held(intact, s.place);
        const RestingWrist& after = held(s.cut, s.place);
        if (!before.is_settled || !after.is_settled) return std::nullopt;
        if (s.kind == Kind::SlAngleChange) return after.sl_angle_deg() - before.sl_angle_deg();
        return apart_deg(turn_of(after, s.bone), turn_of(before, s.bone));
      }
      case Kind::BoneFlexion: {
        const RestingWrist& here = held(s.cut, s.place);
        const RestingWrist& there = held(s.cut, s.other_place);
        if (!here.is_settled || !there.is_settled) return std::nullopt;
        return turn_of(here, s.bone).flexion_deg - turn_of(there, s.bone).flexion_deg;
      }
      case Kind::RangeChange:
        return difference(s.cut, s.place, intact, s.place);
      case Kind::RangeOver:
        return difference(s.cut, s.place, s.cut, s.other_place);
      case Kind::Range:
      case Kind::Stiffness:
      case Kind::Share:
        break;
    }
    const MomentCurve& curve = curve_of(s.cut, s.place);
    const RestingWrist& last = curve.steps.back();
    if (!last.is_settled) return std::nullopt;
    if (s.kind == Kind::Range) return curve.range_deg;
    if (s.kind == Kind::Stiffness) return curve.stiffness_nm_per_deg;
    const BenchDirection& d = direction(s.place);
    return 100 * turn_of(last, s.bone).along(d) / last.hand.along(d);
  }

 private:
  const SectionedWrist& wrist(const std::string& cut) const {
    for (const SectionedWrist& w : result_.wrists) {
      if (w.cut == cut) return w;
    }
    throw InvalidInput("sectioning: nothing was cut as '" + cut + "'");
  }

  const MomentCurve& curve_of(const std::string& cut, const std::string& direction) const {
    for (const MomentCurve& c : wrist(cut).curves) {
      if (c.direction == direction) return c;
    }
    throw InvalidInput("sectioning: no moment was put on as '" + direction + "'");
  }

  const RestingWrist& held(const std::string& cut, const std::string& position) const {
    for (const HeldWrist& h : wrist(cut).held) {
      if (h.position == position) return h.wrist;
    }
    throw InvalidInput("sectioning: no hand was held as '" + position + "'");
  }

  const BenchDirection& direction(const std::string& id) const {
    for (const BenchDirection& d : table_.directions) {
      if (d.id == id) return d;
    }
    throw InvalidInput("sectioning: there is no direction '" + id + "'");
  }

  std::optional<double> difference(const std::string& cut,
                                   const std::string& place,
                                   const std::string& other_cut,
                                   const std::string& other_place) const {
    const MomentCurve& a = curve_of(cut, place);
    const MomentCurve& b = curve_of(other_cut, other_place);
    if (!a.steps.back().is_settled || !b.steps.back().is_settled) return std::nullopt;
    return a.range_deg - b.range_deg;
  }

  const SectioningResult& result_;
  const SectioningTable& table_;
};

}  // namespace

std::vector<StatementCheck> compare_with_published(const SectioningResult& result,
                                                   const SectioningTable& table) {
  const Comparison comparison(result, table);
  std::vector<StatementCheck> checks;
  for (const PublishedStatement& s : table.published) {
    StatementCheck check;
    check.statement = &s;
    if (const auto ours = comparison.ours(s)) {
      check.ours = *ours;
      check.is_measured = true;
      check.is_reached = *ours >= s.limits.low && *ours <= s.limits.high;
    }
    checks.push_back(check);
  }
  return checks;
}

}  // namespace carpus::soft_tissue
