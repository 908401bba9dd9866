// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/sectioning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "anatomy/carpal_kinematics.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "soft_tissue/detail/turned_wrist.hpp"

namespace carpus::soft_tissue {
namespace {

using detail::Bodies;
using detail::ForceLine;
using detail::HandLoad;
using detail::TurnedWrist;

/// Surfaces are sampled more densely than for a pull: they slide far [E]. As stiff in all.
constexpr detail::ContactOptions kContacts{.least_mm = 0.6,
                                           .stiffness_n_per_mm = 40.0 * 260 / 600,
                                           .samples = 600,
                                           .near_mm = 3.5};
/// The press comes from so far proximal that it hardly turns [mm; E].
constexpr double kPressFromMm = 200;
/// What may be left over for a rest to be one: a thousandth of the full load's forces.
constexpr double kSettledN = 1;
constexpr double kSettledNmm = 10;
/// A hand that is turned farther has come off [deg].
constexpr double kComeOffDeg = 150;
/// From where a rest is looked for: bones that are slack may lie in more than one [flexion, deg;
/// E].
constexpr std::array<double, 3> kStartsDeg{0, 30, -30};
/// Between positions at which the hand is held [deg].
constexpr double kLedByDeg = 5;

class Bench {
 public:
  Bench(const cases::CaseData& data, const SoftTissue& tissue, const SectioningTable& table)
      : data_(data), tissue_(tissue), table_(table) {
    const Mat3 patient_from_wrist = data.wrist_from_patient.rotation.transposed();
    side_ = data.side == Side::Left ? 1 : -1;  // frame Wrist of a right wrist is mirrored by y
    flexion_axis_ = patient_from_wrist * Vec3{0, 1, 0};
    deviation_axis_ = patient_from_wrist * Vec3{0, 0, side_};
    press_ = press();
    lay_capsule();
  }

  /// How much longer than in the scan each of the table's lines gets before it pulls [mm].
  std::vector<double> capsule_slack() const {
    std::vector<double> slack;
    for (const CapsuleStrand& s : capsule_) {
      slack.push_back(s.force.rest_mm - detail::length_as_scanned(s.force));
    }
    return slack;
  }

  SectionedWrist section(const BenchCut& cut) const {
    TurnedWrist wrist = wrist_without(cut);
    SectionedWrist result;
    result.cut = cut.id;
    const std::vector<Start> starts = starts_of(wrist);
    for (const BenchDirection& d : table_.directions) {
      result.curves.push_back(curve(wrist, starts, d));
    }
    for (const BenchPosition& p : table_.positions) {
      result.held.push_back({p.id, held(wrist, starts, p)});
    }
    return result;
  }

 private:
  struct Start {
    BenchPosition position;
    Bodies bodies;
  };
  struct Found {
    RestingWrist wrist;
    double energy = 0;
  };
  struct CapsuleStrand {
    const CapsuleLine* line = nullptr;
    ForceLine force;
    bool is_laid = false;  ///< its length is known

    bool is_cut_by(const BenchCut& cut) const {
      return !line->goes_with.empty() &&
             std::any_of(cut.without.begin(), cut.without.end(),
                         [&](const std::string& id) { return line->goes_with.starts_with(id); });
    }
  };

  const cases::Bone& bone(BoneId id) const {
    for (const cases::Bone& b : data_.bones) {
      if (b.bone == id) return b;
    }
    throw InvalidInput("sectioning: the case has no " + std::string(name_of(id)));
  }

  bool is_of(std::uint8_t label, BoneId id) const {  // whole, or one of its pieces
    return std::any_of(data_.bones.begin(), data_.bones.end(),
                       [&](const cases::Bone& b) { return b.label == label && b.bone == id; });
  }

  Vec3 place_of(const CapsuleLine::End& end) const {
    Vec3 sum;
    double count = 0;
    for (const Ligament& l : tissue_.ligaments) {
      if (l.id != end.ligament) continue;
      for (const Strand& s : l.strands) {
        for (const Anchor& a : s.anchors) {
          if (!is_of(a.label, end.bone)) continue;
          sum += s.course[a.point];
          ++count;
        }
      }
    }
    if (!(count > 0)) {
      throw InvalidInput("sectioning: ligament " + end.ligament + " is not held by the " +
                         std::string(name_of(end.bone)) + " in this case");
    }
    return sum / count;
  }

  CapsuleStrand strand_of(const CapsuleLine& line) const {
    const Vec3 from = place_of(line.ends[0]);
    const Vec3 to = place_of(line.ends[1]);
    const ForceLine force{
        ForceLine::kNoLigament,
        {{detail::body_of(line.ends[0].bone), from}, {detail::body_of(line.ends[1].bone), to}},
        distance(from, to) + line.slack_mm.value_or(0) * tissue_.size,
        line.stiffness_n_per_mm};
    return {&line, force, line.slack_mm.has_value()};
  }

  /// Lines without slack get the greatest length that they reach while the whole wrist is turned
  /// without them.
  void lay_capsule() {
    for (const CapsuleLine& line : table_.capsule) capsule_.push_back(strand_of(line));
    if (std::all_of(capsule_.begin(), capsule_.end(), [](const auto& s) { return s.is_laid; })) {
      return;
    }
    TurnedWrist wrist = wrist_without({});
    const std::vector<Start> starts = starts_of(wrist);
    const double share = table_.capsule_length_at_nm / table_.moment_nm;
    const auto steps = std::max<std::size_t>(
        1, static_cast<std::size_t>(share * static_cast<double>(table_.steps) + 0.5));
    std::vector<std::vector<double>> longest(table_.directions.size());
    parallel_for(longest.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        TurnedWrist turned = wrist;
        longest[i].resize(capsule_.size());
        follow(turned, starts, table_.directions[i], steps, [&](const RestingWrist& rest) {
          if (!rest.is_settled) return;
          for (std::size_t l = 0; l < capsule_.size(); ++l) {
            longest[i][l] =
                std::max(longest[i][l], detail::length_now(capsule_[l].force, turned.bodies()));
          }
        });
      }
    });
    for (std::size_t l = 0; l < capsule_.size(); ++l) {
      if (capsule_[l].is_laid) continue;
      capsule_[l].is_laid = true;
      for (const std::vector<double>& lengths : longest) {
        capsule_[l].force.rest_mm = std::max(capsule_[l].force.rest_mm, lengths[l]);
      }
    }
  }

  /// At the place about which the hand turns, so that it does not turn it.
  detail::Press press() const {
    const MeshIn<frame::Patient> scanned(bone(BoneId::Capitate).surface);
    const auto patient_from_wrist = data_.wrist_from_patient.inverse();
    const Vec3 centre = anatomy::CarpalKinematics::published()
                            .landmarks_of(data_.wrist_from_patient * scanned, data_.side)
                            .centre;
    return {table_.press_n, (patient_from_wrist * Point<frame::Wrist>{centre}).v,
            (patient_from_wrist * Point<frame::Wrist>{centre + Vec3{kPressFromMm, 0, 0}}).v};
  }

  TurnedWrist wrist_without(const BenchCut& cut) const {
    const std::vector<std::string_view> without(cut.without.begin(), cut.without.end());
    detail::LineOptions options;
    options.without = without;
    options.is_held_on_its_way = true;
    std::vector<ForceLine> lines = detail::make_force_lines(data_, tissue_, options);
    for (const CapsuleStrand& s : capsule_) {
      if (s.is_laid && !s.is_cut_by(cut)) lines.push_back(s.force);
    }
    return {data_, std::move(lines), kContacts, press_, table_.holding_n_per_mm};
  }

  BodyTurn turn_of(const detail::PlacedBody& body) const {
    const Vec3 v = data_.wrist_from_patient.rotation * detail::rotation_vector(body.rotation);
    return {degrees_from_radians(side_ * v.x), degrees_from_radians(v.y),
            degrees_from_radians(side_ * v.z)};
  }

  double gap(const Bodies& bodies) const {
    double sum = 0;
    double count = 0;
    const detail::PlacedBody& scaphoid = bodies[detail::kScaphoid];
    const detail::PlacedBody& lunate = bodies[detail::kLunate];
    for (const Ligament& l : tissue_.ligaments) {
      if (!l.id.starts_with("SL_")) continue;
      for (const Strand& s : l.strands) {
        Vec3 a = s.course[s.anchors.front().point];
        Vec3 b = s.course[s.anchors.back().point];
        if (detail::body_of_label(data_, s.anchors.front().label) != detail::kScaphoid) {
          std::swap(a, b);
        }
        const Vec3 way = normalized_or(a - b, {});
        sum += dot(scaphoid.at(a) - lunate.at(b), lunate.rotation * way) - distance(a, b);
        ++count;
      }
    }
    return count > 0 ? sum / count : 0;
  }

  Found rest(TurnedWrist& wrist, const HandLoad& load) const {
    const detail::LeftOver left = wrist.rest_under(load);
    const Bodies& bodies = wrist.bodies();
    RestingWrist r;
    r.moment_nm = load.moment_nmm / 1000;
    r.hand = turn_of(bodies[detail::kHand]);
    r.scaphoid = turn_of(bodies[detail::kScaphoid]);
    r.lunate = turn_of(bodies[detail::kLunate]);
    r.triquetrum = turn_of(bodies[detail::kTriquetrum]);
    r.gap_mm = gap(bodies);
    r.left_n = left.force_n;
    r.left_nmm = left.moment_nmm;
    const Vec3 hand{r.hand.twist_deg, r.hand.flexion_deg, r.hand.radial_deviation_deg};
    r.is_settled =
        left.force_n < kSettledN && left.moment_nmm < kSettledNmm && length(hand) < kComeOffDeg;
    return {r, left.energy};
  }

  /// Leads the hand, held, from one position to another.
  Found lead(TurnedWrist& wrist, const BenchPosition& from, const BenchPosition& to) const {
    const double flexion = to.flexion_deg - from.flexion_deg;
    const double deviation = to.radial_deviation_deg - from.radial_deviation_deg;
    const double way = std::sqrt(flexion * flexion + deviation * deviation);
    const int steps = 1 + static_cast<int>(way / kLedByDeg);
    Found last;
    for (int i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      HandLoad load;
      load.guides = {
          {flexion_axis_, radians_from_degrees(from.flexion_deg + share * flexion)},
          {deviation_axis_, radians_from_degrees(from.radial_deviation_deg + share * deviation)}};
      last = rest(wrist, load);
    }
    return last;
  }

  std::vector<Start> starts_of(TurnedWrist& wrist) const {
    const Bodies scanned = wrist.bodies();
    std::vector<Start> starts;
    for (const double flexion : kStartsDeg) {
      const BenchPosition position{"", flexion, 0};
      wrist.lay(scanned);
      static_cast<void>(lead(wrist, {}, position));
      starts.push_back({position, wrist.bodies()});
    }
    return starts;
  }

  /// Turns the wrist by the first `steps` steps of the moment, and hands over each rest as the
  /// wrist lies in it.
  template <typename Take>
  void follow(TurnedWrist& wrist,
              const std::vector<Start>& starts,
              const BenchDirection& d,
              std::size_t steps,
              const Take& take) const {
    HandLoad load;
    load.axis = flexion_axis_ * d.flexes + deviation_axis_ * d.deviates_radially;
    const auto all_steps = static_cast<double>(table_.steps);
    // The first step is the lowest rest that is found from any start; the others follow it.
    load.moment_nmm = 1000 * table_.moment_nm / all_steps;
    Found lowest;
    Bodies first;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      wrist.lay(starts[i].bodies);
      const Found found = rest(wrist, load);
      if (i > 0 && !is_lower(found, lowest)) continue;
      lowest = found;
      first = wrist.bodies();
    }
    wrist.lay(first);
    take(lowest.wrist);
    for (std::size_t i = 2; i <= steps; ++i) {
      load.moment_nmm = 1000 * table_.moment_nm * static_cast<double>(i) / all_steps;
      take(rest(wrist, load).wrist);
    }
  }

  MomentCurve curve(TurnedWrist& wrist,
                    const std::vector<Start>& starts,
                    const BenchDirection& d) const {
    MomentCurve result;
    result.direction = d.id;
    follow(wrist, starts, d, table_.steps,
           [&](const RestingWrist& rest) { result.steps.push_back(rest); });
    const RestingWrist& last = result.steps.back();
    const RestingWrist& before = result.steps[table_.steps - 1 - table_.steps / 4];
    result.range_deg = last.hand.along(d);
    const double further = result.range_deg - before.hand.along(d);
    if (further > 0) result.stiffness_nm_per_deg = (last.moment_nm - before.moment_nm) / further;
    return result;
  }

  RestingWrist held(TurnedWrist& wrist,
                    const std::vector<Start>& starts,
                    const BenchPosition& p) const {
    Found lowest;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      wrist.lay(starts[i].bodies);
      const Found found = lead(wrist, starts[i].position, p);
      if (i == 0 || is_lower(found, lowest)) lowest = found;
    }
    return lowest.wrist;
  }

  static bool is_lower(const Found& a, const Found& b) {
    if (a.wrist.is_settled != b.wrist.is_settled) return a.wrist.is_settled;
    return a.energy < b.energy;
  }

  const cases::CaseData& data_;
  const SoftTissue& tissue_;
  const SectioningTable& table_;
  double side_ = 1;
  Vec3 flexion_axis_;
  Vec3 deviation_axis_;
  std::vector<CapsuleStrand> capsule_;
  detail::Press press_;
};

void count(const RestingWrist& wrist, SectioningResult& result) {
  ++result.rests;
  if (!wrist.is_settled) {
    ++result.unsettled;
    return;
  }
  result.worst_left_n = std::max(result.worst_left_n, wrist.left_n);
  result.worst_left_nmm = std::max(result.worst_left_nmm, wrist.left_nmm);
}

}  // namespace

SectioningResult section(const cases::CaseData& data,
                         const SoftTissue& tissue,
                         const SectioningTable& table) {
  for (const cases::Bone& b : data.bones) {
    if (b.bone <= BoneId::Hamate && b.distance_field.geometry().voxel_count() == 0) {
      throw InvalidInput("sectioning: the case has no distance field of the " +
                         std::string(name_of(b.bone, b.part)));
    }
  }
  const Bench bench(data, tissue, table);
  SectioningResult result;
  result.capsule_slack_mm = bench.capsule_slack();
  result.wrists.resize(table.cuts.size());
  parallel_for(table.cuts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) result.wrists[i] = bench.section(table.cuts[i]);
  });
  for (const SectionedWrist& wrist : result.wrists) {
    for (const MomentCurve& curve : wrist.curves) {
      for (const RestingWrist& step : curve.steps) count(step, result);
    }
    for (const HeldWrist& held : wrist.held) count(held.wrist, result);
  }
  return result;
}

}  // namespace carpus::soft_tissue
