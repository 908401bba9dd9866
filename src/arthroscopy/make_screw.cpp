// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How it goes: the line that leaves most bone about a screw is found by tilting the central axis
// about its entry. A screw well laid, one not turned in and one too long lie on that line; off the
// axis, it is tilted towards the capitate until the thread stands out by what was drawn; for a tip
// that stands out a line is looked for that ends where the midcarpal joint shows the
// scaphotrapeziotrapezoid one. What stands out is measured against the walls of the joints' spaces:
// they are what a scope sees. An end counts by the part of its rim that comes out first.
#include "arthroscopy/make_screw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "arthroscopy/optics.hpp"
#include "arthroscopy/shown_by_portals.hpp"
#include "core/rng.hpp"
#include "fields/distance_field.hpp"
#include "instruments/instrument.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::ControlledScrew;
using cases::ScrewFault;
using cases::ScrewSite;

constexpr std::uint64_t kStream = 0x5C3E;  // apart from other draws of the same seed
constexpr double kStepMm = 0.1;
constexpr double kAlongMm = 0.5;
constexpr int kRims = 12;
constexpr double kFarMm = 4.0;         // what a joint's space says of what is far from it
constexpr double kLongestMm = 40.0;    // of a line
constexpr double kAboutEndMm = 4.0;    // of an end, where it is judged as an end
constexpr double kSpareMm = 0.2;       // under a surface through which nothing is to come out
constexpr double kBesideMm = 2.0;      // of the pole's middle, towards the lunate [E]
constexpr double kTiltMm = 4.0;        // of the axis' far end
constexpr double kOffAxisMm = 14.0;    // likewise, off it
constexpr double kOnWallMm = 0.4;      // a bone's surface is a joint's wall there
constexpr double kAboutPlaceMm = 5.0;  // of the tour, a site lies
constexpr double kAboutSttMm = 7.0;    // of its place
constexpr double kSteepCosine = 0.5;   // at least, of a tip that goes out
constexpr double kPerCosineMm = 6.0;   // what a steeper one is worth
constexpr std::array<double, 2> kAtCortexMm{0.2, 1.0};  // a tip of a screw that is too long
constexpr double kGaugeStepMm = 0.5;
constexpr double kNotProudMm = 0.2;  // stands out by less: flush

struct Line {
  Vec3 entry;
  Vec3 way;               ///< unit, into the bone
  double surface_mm = 0;  ///< where a screw's trailing rim begins to stand out
  double chord_mm = 0;    ///< of the far cortex
};

struct Standing {
  double out_mm = -kFarMm;
  double along_mm = 0;
};

struct Laid {
  ScrewKind kind;
  Line line;
  double tail_mm = 0;  ///< along the line
};

class ScrewMaker {
 public:
  ScrewMaker(const cases::CaseData& data,
             const cases::ArthroscopicMap& map,
             const ScrewTable& table,
             std::span<const ScrewKind> kinds,
             std::uint64_t seed)
      : data_(data),
        map_(map),
        table_(table),
        kinds_(kinds),
        rng_(seed ^ kStream),
        shown_(data, map) {
    made_.shifts.assign(data.bones.size(), {});
    for (std::size_t b = 0; b < data.bones.size(); ++b) {
      if (data.bones[b].bone != BoneId::Scaphoid) continue;
      if (data.bones[b].part != BonePart::Distal) body_ = b;
    }
  }

  cases::JointLesions make() {
    const auto* pole = point(kPoleOfScaphoid);
    const auto* capitate = point(kScaphocapitate);
    const auto* stt = point(kStt);
    if (!body_ || kinds_.empty() || pole == nullptr || capitate == nullptr || stt == nullptr) {
      return std::move(made_);
    }
    proximal_ = pole->joint;
    distal_ = capitate->joint;
    places_[1] = on_bone(capitate->at);
    places_[2] = on_bone(stt->at);
    widest_ = *std::max_element(kinds_.begin(), kinds_.end(), [](const auto& a, const auto& b) {
      return a.tail_radius_mm < b.tail_radius_mm;
    });
    // The same draws whatever becomes of them.
    const double which = rng_.uniform();
    proud_mm_ = drawn(table_.proud_mm);
    thread_proud_mm_ = drawn(table_.thread_proud_mm);
    buried_mm_ = drawn(table_.buried_mm);
    if (rng_.uniform() < table_.flush_share) buried_mm_ = 0;
    const Vec3 at_pole = (data_.scaphoid.central_axis.proximal + pole->at) * 0.5;
    // Beside the lunate, where the longest line goes in and a probe by 4-5 comes to it.
    const Vec3 to_lunate = data_.scaphoid.longest_line.proximal - at_pole;
    entry_ = on_wall(proximal_, at_pole + normalized_or(to_lunate, {}) * kBesideMm);
    const std::optional<Line> best = best_line();
    if (!best) return std::move(made_);
    std::size_t first = 0;
    double sum = table_.chances[0];
    while (first + 1 < cases::kScrewFaults && which >= sum) sum += table_.chances[++first];
    for (std::size_t i = 0; i < cases::kScrewFaults; ++i) {
      const auto fault = static_cast<ScrewFault>((first + i) % cases::kScrewFaults);
      if (const auto laid = lay(fault, *best)) {
        finish(fault, *laid);
        break;
      }
    }
    return std::move(made_);
  }

 private:
  [[nodiscard]] double drawn(const std::array<double, 2>& range) {
    return rng_.uniform(range[0], range[1]);
  }

  [[nodiscard]] const cases::TourPoint* point(int number) const {
    for (const cases::TourPoint& each : map_.points) {
      if (each.number == number) return &each;
    }
    return nullptr;
  }

  /// Into the joint's space positive, out of it negative.
  [[nodiscard]] double in_space(std::uint8_t joint, const Vec3& at) const {
    const auto s = fields::sample_distance(map_.joints[joint].wall, at);
    return s.is_inside_grid ? -s.distance_mm : -kFarMm;
  }

  /// Of the nearest piece of the scaphoid.
  [[nodiscard]] fields::DistanceSample bone_at(const Vec3& at) const {
    fields::DistanceSample nearest;
    nearest.distance_mm = kFarMm;
    for (const cases::Bone& bone : data_.bones) {
      if (bone.bone != BoneId::Scaphoid || bone.distance_field.values().empty()) continue;
      const auto s = fields::sample_distance(bone.distance_field, at);
      if (s.is_inside_grid && s.distance_mm < nearest.distance_mm) nearest = s;
    }
    return nearest;
  }

  [[nodiscard]] Vec3 outwards(std::uint8_t joint, const Vec3& at) const {
    return normalized_or(fields::sample_distance(map_.joints[joint].wall, at).gradient,
                         -map_.distal);
  }

  [[nodiscard]] Vec3 on_wall(std::uint8_t joint, Vec3 at) const {
    for (int i = 0; i < 4; ++i) at += outwards(joint, at) * in_space(joint, at);
    return at;
  }

  /// Of the scaphoid's surface what lines the midcarpal joint nearest to a place and can be looked
  /// at there.
  [[nodiscard]] Vec3 on_bone(const Vec3& near) const {
    std::vector<std::pair<double, Vec3>> all;
    for (const cases::Bone& bone : data_.bones) {
      if (bone.bone != BoneId::Scaphoid) continue;
      for (const Vec3& v : bone.surface.vertices) {
        if (std::abs(in_space(distal_, v)) <= kOnWallMm) all.emplace_back(distance(v, near), v);
      }
    }
    std::sort(all.begin(), all.end(),
              [](const auto& one, const auto& two) { return one.first < two.first; });
    for (const auto& [far, v] : all) {
      if (far > kAboutPlaceMm) break;
      if (is_shown(v)) return v;
    }
    return all.empty() ? near : all.front().second;
  }

  [[nodiscard]] bool is_shown(const Vec3& at) const {
    return shown_.shows(distal_, static_cast<std::uint8_t>(*body_), at);
  }

  /// Lines along the edge of what is round about a line.
  template <typename March>
  void each_rim(const Line& line, double radius_mm, March march) const {
    const Vec3 a = any_perpendicular(line.way);
    const Vec3 b = cross(line.way, a);
    for (int i = 0; i < kRims; ++i) {
      const auto turn = cos_sin_deg(360.0 / kRims * i);
      march(line.entry + a * (radius_mm * turn[0]) + b * (radius_mm * turn[1]));
    }
  }

  /// Measures a line from its entry; none where it is no way through the bone.
  [[nodiscard]] std::optional<Line> measured(const Vec3& entry, const Vec3& to) const {
    Line line{entry, normalized_or(to - entry, {0, 0, 1})};
    bool comes_out = false;
    bool is_shallow = false;
    line.surface_mm = -kLongestMm;
    each_rim(line, widest_.tail_radius_mm, [&](const Vec3& rim) {
      if (in_space(proximal_, rim + line.way * kAboutEndMm) > 0) is_shallow = true;
      for (double s = kAboutEndMm; s > -kAboutEndMm; s -= kStepMm) {
        if (in_space(proximal_, rim + line.way * s) <= 0) continue;
        line.surface_mm = std::max(line.surface_mm, s);
        comes_out = true;
        return;
      }
    });
    if (!comes_out || is_shallow) return std::nullopt;
    for (double s = kAboutEndMm; s < kLongestMm; s += kStepMm) {
      if (bone_at(entry + line.way * s).distance_mm < 0) line.chord_mm = s;
    }
    return line;
  }

  /// How far the widest screw's thread stands out into a joint between two places along the line.
  [[nodiscard]] Standing thread_out(std::uint8_t joint,
                                    const Line& line,
                                    double from,
                                    double to) const {
    Standing worst;
    for (double s = from; s <= to; s += kAlongMm) {
      const double out = widest_.tail_radius_mm + in_space(joint, line.entry + line.way * s);
      if (out > worst.out_mm) worst = {out, s};
    }
    return worst;
  }

  [[nodiscard]] double worst_of(const Line& line, double to) const {
    const double from = line.surface_mm + kAboutEndMm;
    return std::max(thread_out(proximal_, line, from, to).out_mm,
                    thread_out(distal_, line, from, to).out_mm);
  }

  [[nodiscard]] std::optional<Line> best_line() const {
    const Vec3 axis = normalized_or(data_.scaphoid.central_axis.distal - entry_, {0, 0, 1});
    const Vec3 a = any_perpendicular(axis);
    const Vec3 b = cross(axis, a);
    std::optional<Line> best;
    double least = 1e18;
    for (double u = -kTiltMm; u <= kTiltMm; u += 1.0) {
      for (double v = -kTiltMm; v <= kTiltMm; v += 1.0) {
        const auto line = measured(entry_, data_.scaphoid.central_axis.distal + a * u + b * v);
        if (!line) continue;
        const double worst = worst_of(*line, line->chord_mm - table_.cover_mm);
        if (!(worst < least) || !longest_within(*line)) continue;
        least = worst;
        best = line;
      }
    }
    return least < -kSpareMm ? best : std::nullopt;
  }

  /// The longest with the bone at either end that is meant.
  [[nodiscard]] std::optional<ScrewKind> longest_within(const Line& line) const {
    return longest(line.chord_mm - line.surface_mm - 2 * table_.cover_mm);
  }

  [[nodiscard]] std::optional<ScrewKind> longest(double most_mm) const {
    std::optional<ScrewKind> best;
    for (const ScrewKind& kind : kinds_) {
      if (kind.length_mm <= most_mm && (!best || kind.length_mm > best->length_mm)) best = kind;
    }
    return best;
  }

  [[nodiscard]] std::optional<Laid> lay(ScrewFault fault, const Line& best) {
    switch (fault) {
      case ScrewFault::Harmless:
        return Laid{*longest_within(best), best, best.surface_mm + buried_mm_};
      case ScrewFault::NotTurnedIn:
        return Laid{*longest_within(best), best, best.surface_mm - proud_mm_};
      case ScrewFault::TooLong:
        return too_long(best);
      case ScrewFault::OffAxis:
        return off_axis(best);
      case ScrewFault::Through:
        return through();
    }
    return std::nullopt;
  }

  /// Of the screws whose tip comes to the far cortex the one that stands out by about what was
  /// drawn.
  [[nodiscard]] std::optional<Laid> too_long(const Line& line) const {
    std::optional<Laid> best;
    double least = 1e18;
    for (const ScrewKind& kind : kinds_) {
      for (const double left :
           {kAtCortexMm[0], 0.5 * (kAtCortexMm[0] + kAtCortexMm[1]), kAtCortexMm[1]}) {
        const double proud = kind.length_mm - (line.chord_mm - left - line.surface_mm);
        const bool is_meant = proud >= table_.proud_mm[0] && proud <= table_.proud_mm[1];
        if (!is_meant || std::abs(proud - proud_mm_) >= least) continue;
        least = std::abs(proud - proud_mm_);
        best = Laid{kind, line, line.surface_mm - proud};
      }
    }
    return best;
  }

  /// Towards the capitate; where the thread could not be seen there, to either side of that.
  [[nodiscard]] std::optional<Laid> off_axis(const Line& best) const {
    const Vec3 to_side = places_[1] - best.entry;
    const Vec3 aside = normalized_or(to_side - best.way * dot(to_side, best.way), {});
    const Vec3 across = cross(best.way, aside);
    for (const double turn : {0.0, 20.0, -20.0, 40.0, -40.0, 60.0, -60.0, 80.0, -80.0}) {
      const auto way = cos_sin_deg(turn);
      const auto laid = off_axis(best, aside * way[0] + across * way[1]);
      if (laid) return laid;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Laid> off_axis(const Line& best, const Vec3& aside) const {
    const Vec3 far = best.entry + best.way * best.chord_mm;
    for (double off = 0; off <= kOffAxisMm; off += kStepMm) {
      const auto line = measured(best.entry, far + aside * off);
      if (!line) return std::nullopt;
      const double buried = std::max(buried_mm_, table_.buried_mm[0]);
      const auto kind = longest(line->chord_mm - line->surface_mm - buried - 1.0);
      if (!kind) return std::nullopt;
      const Laid laid{*kind, *line, line->surface_mm + buried};
      const double from = line->surface_mm + kAboutEndMm;
      const double end = laid.tail_mm + kind->length_mm;
      const Standing out = thread_out(distal_, *line, from, end);
      if (out.out_mm < thread_proud_mm_) continue;
      const bool is_thread = out.along_mm < end - kAboutEndMm;
      const bool is_there_alone = thread_out(proximal_, *line, from, end).out_mm < -kSpareMm;
      const bool is_meant = out.out_mm <= table_.thread_proud_mm[1] + kSpareMm;
      if (!is_thread || !is_there_alone || !is_meant) return std::nullopt;
      const Vec3 at = on_wall(distal_, line->entry + line->way * out.along_mm);
      return is_shown(at) ? std::optional(laid) : std::nullopt;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Laid> through() {
    std::optional<Laid> best;
    double least = 1e18;
    for (const cases::Bone& bone : data_.bones) {
      if (bone.bone != BoneId::Scaphoid) continue;
      for (const Vec3& v : bone.surface.vertices) {
        const double off = distance(v, places_[2]);
        if (off > kAboutSttMm || off - kPerCosineMm >= least ||
            std::abs(in_space(distal_, v)) > kOnWallMm) {
          continue;
        }
        const Vec3 way = normalized_or(v - entry_, {0, 0, 1});
        const double cosine = dot(way, normalized_or(bone_at(v).gradient, way));
        const double cost = off - kPerCosineMm * cosine;
        if (cosine < kSteepCosine || cost >= least) continue;
        const auto laid = through(v);
        if (!laid || !is_shown(v)) continue;
        least = cost;
        best = laid;
        through_at_ = v;
      }
    }
    return best;
  }

  [[nodiscard]] std::optional<Laid> through(const Vec3& to) const {
    const auto line = measured(entry_, to);
    if (!line) return std::nullopt;
    const double far = distance(entry_, to);
    const auto surface = tip_surface(*line, far);
    if (!surface || worst_of(*line, *surface - kAboutEndMm) > -kSpareMm) return std::nullopt;
    for (const ScrewKind& kind : kinds_) {
      const double buried = *surface + proud_mm_ - kind.length_mm - line->surface_mm;
      if (buried < table_.buried_mm[0] || buried > table_.buried_mm[1]) continue;
      return Laid{kind, *line, line->surface_mm + buried};
    }
    return std::nullopt;
  }

  /// Where the first of a tip's rim comes into the midcarpal joint.
  [[nodiscard]] std::optional<double> tip_surface(const Line& line, double far) const {
    std::optional<double> first;
    each_rim(line, widest_.tip_radius_mm, [&](const Vec3& rim) {
      for (double s = far - kAboutEndMm; s < far + kAboutEndMm; s += kStepMm) {
        if (in_space(distal_, rim + line.way * s) <= 0) continue;
        first = std::min(first.value_or(s), s);
        return;
      }
    });
    return first;
  }

  void finish(ScrewFault fault, const Laid& laid) {
    const Line& line = laid.line;
    ControlledScrew screw;
    screw.tail = line.entry + line.way * laid.tail_mm;
    screw.tip = screw.tail + line.way * laid.kind.length_mm;
    screw.tail_radius_mm = laid.kind.tail_radius_mm;
    screw.tip_radius_mm = laid.kind.tip_radius_mm;
    screw.length_mm = laid.kind.length_mm;
    const double steps = (line.chord_mm - line.surface_mm) / kGaugeStepMm;
    screw.line_mm = kGaugeStepMm * static_cast<double>(static_cast<int>(steps + 0.5));
    screw.fault = fault;
    screw.body = static_cast<std::uint8_t>(*body_);
    const double end = laid.tail_mm + laid.kind.length_mm;
    screw.out_mm[0] = line.surface_mm - laid.tail_mm;
    const Standing thread =
        thread_out(distal_, line, line.surface_mm + kAboutEndMm, end - kAboutEndMm);
    screw.out_mm[1] = thread.out_mm;
    places_[0] = on_wall(proximal_, line.entry);
    if (fault == ScrewFault::OffAxis) {
      places_[1] = on_wall(distal_, line.entry + line.way * thread.along_mm);
    }
    screw.out_mm[2] = end - line.chord_mm;
    if (fault == ScrewFault::Through) {
      screw.out_mm[2] = proud_mm_;
      places_[2] = through_at_;
    }
    made_.screw = screw;
    for (std::size_t site = 0; site < cases::kScrewSites; ++site) add_site(site);
    grade(screw);
  }

  void add_site(std::size_t site) {
    cases::Lesion lesion;
    lesion.look = cases::LesionLook::ScrewSite;
    lesion.finding = static_cast<std::uint8_t>(site);
    lesion.joint = site == 0 ? proximal_ : distal_;
    lesion.body = static_cast<std::uint8_t>(*body_);
    lesion.from = lesion.to = places_[site];
    lesion.outwards = outwards(lesion.joint, places_[site]);
    lesion.radius_mm = widest_.tail_radius_mm;
    made_.lesions.push_back(lesion);
  }

  void grade(const ControlledScrew& screw) {
    const double end = screw.out_mm[0];
    made_.grades[0] = static_cast<std::uint8_t>(end > kNotProudMm    ? EndGrade::Proud
                                                : end > -kNotProudMm ? EndGrade::Flush
                                                                     : EndGrade::Buried);
    const auto surface = [](bool is_out) {
      return static_cast<std::uint8_t>(is_out ? SurfaceGrade::Proud : SurfaceGrade::Covered);
    };
    made_.grades[1] = surface(screw.fault == ScrewFault::OffAxis);
    made_.grades[2] = surface(screw.fault == ScrewFault::Through);
    DecisionGrade decision = DecisionGrade::Exchange;
    if (screw.fault == ScrewFault::Harmless) decision = DecisionGrade::Leave;
    if (screw.fault == ScrewFault::NotTurnedIn) decision = DecisionGrade::Deeper;
    made_.grades[kScrewDecision] = static_cast<std::uint8_t>(decision);
    for (cases::Lesion& lesion : made_.lesions) lesion.grade = made_.grades[lesion.finding];
  }

  const cases::CaseData& data_;
  const cases::ArthroscopicMap& map_;
  const ScrewTable& table_;
  std::span<const ScrewKind> kinds_;
  Rng rng_;
  ShownByPortals shown_;
  cases::JointLesions made_;
  std::optional<std::size_t> body_;
  std::uint8_t proximal_ = 0;
  std::uint8_t distal_ = 0;
  std::array<Vec3, cases::kScrewSites> places_;
  ScrewKind widest_;
  Vec3 entry_;
  Vec3 through_at_;
  double proud_mm_ = 0;
  double thread_proud_mm_ = 0;
  double buried_mm_ = 0;
};

}  // namespace

cases::JointLesions make_screw(const cases::CaseData& data,
                               const cases::ArthroscopicMap& map,
                               const ScrewTable& table,
                               std::span<const ScrewKind> kinds,
                               std::uint64_t seed) {
  return ScrewMaker(data, map, table, kinds, seed).make();
}

cases::JointLesions make_screw(const cases::CaseData& data,
                               const cases::ArthroscopicMap& map,
                               std::uint64_t seed) {
  std::vector<ScrewKind> kinds;
  for (const instruments::Instrument& each : instruments::catalogue()) {
    if (each.family.empty()) continue;
    kinds.push_back({each.length_mm, each.tail_diameter_mm / 2, each.tip_diameter_mm / 2});
  }
  return make_screw(data, map, ScrewTable::generic(), kinds, seed);
}

}  // namespace carpus::arthroscopy
