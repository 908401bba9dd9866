// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/yielding_figures.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "arthroscopy/band_net.hpp"
#include "arthroscopy/band_table.hpp"
#include "arthroscopy/bone_interval.hpp"
#include "arthroscopy/disc_net.hpp"
#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/named_grades.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "fields/distance_field.hpp"
#include "yielding/net_of_band.hpp"
#include "yielding/net_state.hpp"

namespace carpus::arthroscopy {
namespace {

constexpr double kProbeMm = 0.5;  // radius of the hook probe [K, B9]
constexpr int kTicks = 2000;      // until it rests
constexpr double kMmPerN = 0.01;  // a tick: as a hand sinks in
constexpr double kNewtons = 1.0;

constexpr double kThickScopeMm = 1.35;  // radius [K, B9]
constexpr double kStepMm = 0.1;
constexpr double kBeforeMm = 3.0;  // so far before its place the mouth is looked for
constexpr double kAsideMm = 2.0;   // of the straight line from mouth to ligament

/// An interval with its bones where a grade has them, and the line that leads through it.
class PartedInterval {
 public:
  PartedInterval(const BoneInterval& interval,
                 const Vec3& first_shift,
                 const Vec3& second_shift,
                 const Vec3& distal,
                 const Vec3& proximal)
      : interval_(interval), from_(distal + (first_shift + second_shift) / 2) {
    first_.translation = -first_shift;
    second_.translation = -second_shift;
    way_ = normalized_or(proximal - distal, {});
    long_mm_ = distance(distal, proximal);
    // As scanned both are near each other from its mouth on.
    while (mouth_mm_ < long_mm_ && !near(distal + way_ * mouth_mm_, {}).is_near) {
      mouth_mm_ += kStepMm;
    }
    for (double s = mouth_mm_; s < long_mm_; s += kStepMm) {
      const BesideBone side = near(distal + way_ * s, {});
      if (!side.is_near) continue;
      across_ += side.across;
    }
    across_ = normalized_or(across_, {});
    gap_mm_ = dot(second_shift - first_shift, across_);
  }
  [[nodiscard]] double gap_mm() const { return gap_mm_; }
  [[nodiscard]] double deep_mm() const { return long_mm_ - mouth_mm_; }
  /// How far in a ball goes, aside where it has to.
  [[nodiscard]] double goes_in_mm(double radius_mm) const {
    double s = mouth_mm_;
    while (s < long_mm_ && has_room(from_ + way_ * s, radius_mm)) s += kStepMm;
    return std::min(s, long_mm_) - mouth_mm_;
  }

 private:
  [[nodiscard]] BesideBone near(const Vec3& at,
                                const Pose<frame::Bone, frame::Patient>& bone) const {
    return beside_bone(*interval_.first, *interval_.second, interval_.cartilage_mm, bone, at);
  }
  [[nodiscard]] bool has_room(const Vec3& middle, double radius_mm) const {
    for (double aside = -kAsideMm; aside <= kAsideMm; aside += kStepMm / 2) {
      const Vec3 at = middle + across_ * aside;
      const auto off = [&](const Grid<float>& bone, const Pose<frame::Bone, frame::Patient>& pose) {
        return fields::sample_distance(bone, (pose * Point<frame::Patient>{at}).v).distance_mm;
      };
      if (in_interval(interval_, first_, second_, at, radius_mm).depth_mm <= 0 &&
          off(*interval_.first, first_) >= radius_mm &&
          off(*interval_.second, second_) >= radius_mm) {
        return true;
      }
    }
    return false;
  }

  const BoneInterval& interval_;
  Pose<frame::Bone, frame::Patient> first_;
  Pose<frame::Bone, frame::Patient> second_;
  Vec3 from_;
  Vec3 way_;
  Vec3 across_;
  double mouth_mm_ = -kBeforeMm;
  double long_mm_ = 0;
  double gap_mm_ = 0;
};

const cases::TourPoint* point_of(const cases::ArthroscopicMap& map, const std::string& id) {
  for (const cases::TourPoint& point : map.points) {
    if (point.id == id) return &point;
  }
  return nullptr;
}

DiscFigures figures_of(const yielding::Net& net, const Vec3& middle, const Vec3& edge) {
  DiscFigures made;
  made.press_mm = pressed_in_mm(net, middle, kHalfDiscMm, kNewtons);
  made.lifted_mm = lifted_mm(net, edge, kNewtons);
  made.particles = net.size();
  return made;
}

}  // namespace

double pressed_in_mm(const yielding::Net& net,
                     const Vec3& at,
                     double half_thick_mm,
                     double newtons,
                     bool is_behind) {
  const auto state = std::make_unique<yielding::NetState>();
  state->reset(net);
  const std::size_t near = state->nearest(net, at);
  if (near >= net.size()) return 0;
  const Vec3 normal = net.normals()[near] * (is_behind ? -1.0 : 1.0);
  yielding::Tip tip;
  tip.is_there = true;
  tip.is_behind = is_behind;
  tip.radius_mm = kProbeMm + half_thick_mm;
  double deep = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    tip.at = net.rest()[near] + normal * (tip.radius_mm - deep);
    state->step(net, std::span<const yielding::Tip>(&tip, 1));
    deep += kMmPerN * (newtons - dot(state->force_on(0), normal));
  }
  return deep;
}

double lifted_mm(const yielding::Net& net, const Vec3& at, double newtons) {
  const auto state = std::make_unique<yielding::NetState>();
  state->reset(net);
  yielding::Tip tip;
  tip.is_there = true;
  tip.hooked = state->nearest(net, at);
  if (tip.hooked >= net.size()) return 0;
  const Vec3 normal = net.normals()[tip.hooked];
  double lift = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    tip.at = net.rest()[tip.hooked] + normal * lift;
    state->step(net, std::span<const yielding::Tip>(&tip, 1));
    lift += kMmPerN * (newtons + dot(state->force_on(0), normal));
  }
  return dot(state->off(tip.hooked), normal);
}

std::vector<DiscFigures> disc_figures(const cases::CaseData& data,
                                      const cases::ArthroscopicMap& map) {
  const yielding::Net whole = disc_net(map, nullptr);
  if (whole.size() == 0) return {};
  Vec3 middle;
  for (const Vec3& at : whole.rest()) middle += at / static_cast<double>(whole.size());
  Vec3 edge = middle;
  for (const cases::TourPoint& point : map.points) {
    if (point.number == kHookTestPoint) edge = point.at;
  }
  std::vector<DiscFigures> all{figures_of(whole, middle, edge)};
  const PathologyTable& table = PathologyTable::generic();
  cases::Grades torn{};
  if (!set_grade(torn, table, "disc", kOffTheFovea)) return all;
  const cases::JointLesions lesions = make_lesions(data, map, table, torn, 1);
  if (lesions.grades != torn) return all;
  const yielding::Net off = disc_net(map, &lesions);
  DiscFigures made = figures_of(off, middle, edge);
  made.has_come_off = true;
  for (std::size_t i = 0; i < std::min(whole.size(), off.size()); ++i) {
    made.rests_off_mm = std::max(made.rests_off_mm, distance(whole.rest()[i], off.rest()[i]));
  }
  all.push_back(made);
  return all;
}

std::vector<BandFigures> band_figures(const cases::ArthroscopicMap& map) {
  const BandTable& table = BandTable::generic();
  std::vector<BandFigures> all;
  for (const cases::LigamentBand& band : map.bands) {
    for (const BandGrade& grade : table.grades) {
      if (!grade.press_mm) continue;
      const yielding::Net net = band_net(band, grade, nullptr);
      const std::size_t middle = (band.rows / 2) * band.columns + band.columns / 2;
      BandFigures made;
      made.band = band.id;
      made.grade = grade.id;
      made.press_mm = pressed_in_mm(net, net.rest()[middle], band.thickness_mm / 2, 1.0);
      made.press_behind_mm =
          pressed_in_mm(net, net.rest()[middle], band.thickness_mm / 2, kNewtons, true);
      made.wanted_mm = grade.press_mm;
      made.bulge_mm = grade.bulge_mm;
      made.fibres_n_per_mm = band.along_n_per_mm * grade.along_share;
      made.along_n_per_mm =
          yielding::along_n_per_mm(net, {band.rows, band.columns, band.at, band.inwards});
      if (const TabledBand* each = table.band(band.id)) made.whole_n_per_mm = each->whole_n_per_mm;
      made.particles = net.size();
      made.springs = net.springs().size();
      all.push_back(std::move(made));
    }
  }
  return all;
}

std::vector<IntervalFigures> interval_figures(const cases::CaseData& data,
                                              const cases::ArthroscopicMap& map) {
  const PathologyTable& table = PathologyTable::generic();
  std::vector<IntervalFigures> all;
  for (const cases::LigamentBand& band : map.bands) {
    const auto interval = interval_of(data, map, band);
    if (!interval) continue;
    for (std::size_t f = 0; f < table.findings.size(); ++f) {
      const auto& line = table.findings[f].line;
      if (table.findings[f].id != band.id || !line) continue;
      const cases::TourPoint* distal = point_of(map, line->in_midcarpal);
      const cases::TourPoint* proximal = point_of(map, line->in_radiocarpal);
      if (distal == nullptr || proximal == nullptr) continue;
      const std::vector<Grade>& grades = table.scale_of(f).grades;
      for (std::size_t g = 0; g < grades.size(); ++g) {
        cases::Grades wrong{};
        wrong[f] = static_cast<std::uint8_t>(g);
        const cases::JointLesions made = make_lesions(data, map, table, wrong, 1);
        if (made.grades[f] != g) continue;
        const PartedInterval parted(*interval, made.shifts[band.first], made.shifts[band.second],
                                    distal->at, proximal->at);
        all.push_back({band.id, grades[g].id, parted.gap_mm(), parted.deep_mm(),
                       parted.goes_in_mm(kProbeMm), parted.goes_in_mm(kThickScopeMm)});
      }
    }
  }
  return all;
}

}  // namespace carpus::arthroscopy
