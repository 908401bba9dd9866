// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Places come from the tour's points on the joints' walls; what is moved off them is brought back
// onto the wall by the wall's distance.
#include "arthroscopy/make_lesions.hpp"

#include <algorithm>
#include <string>

#include "arthroscopy/band_table.hpp"
#include "arthroscopy/bone_interval.hpp"
#include "core/rng.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::Lesion;
using cases::LesionLook;

constexpr std::uint64_t kGradesStream = 0x9A7;  // apart from the operator's errors of the same seed
constexpr std::uint64_t kPlacesStream = 0x51D;
constexpr double kAsideMm = 1.5;  // so far from the tour's point a patch's middle may lie [E]
constexpr int kStepsAside = 4;
constexpr int kStepsAcross = 16;  // from one joint's place of a ligament to the other's
// Parts of the disc, from its middle, for the generic wrist's size [E].
constexpr double kRadialOfMiddleMm = 2.0;
constexpr double kToRimMm = 4.2;

class LesionMaker {
 public:
  LesionMaker(const cases::CaseData& data,
              const cases::ArthroscopicMap& map,
              const PathologyTable& table,
              const cases::Grades& grades,
              std::uint64_t seed)
      : data_(data), map_(map), table_(table), rng_(seed ^ kPlacesStream) {
    made_.grades = grades;
    made_.full_traction_n = table.full_traction_n;
    made_.shifts.assign(data.bones.size(), {});
    const auto to_patient = data.wrist_from_patient.inverse();
    volar_ = (to_patient * Direction<frame::Wrist>{{0, 0, 1}}).v;
    radial_ =
        (to_patient * Direction<frame::Wrist>{{0, data.side == Side::Left ? -1.0 : 1.0, 0}}).v;
  }

  cases::JointLesions make() {
    settle();
    for (std::size_t f = 0; f < table_.findings.size(); ++f) {
      // The same draws for every grade: one finding's place does not hang on another's grade.
      const Vec3 aside = Vec3{rng_.uniform(-1, 1), rng_.uniform(-1, 1), rng_.uniform(-1, 1)};
      const double choice = rng_.uniform();
      std::uint8_t& grade = made_.grades[f];
      const Scale& scale = table_.scale_of(f);
      if (grade == 0 || grade >= scale.grades.size()) {
        grade = 0;
        continue;
      }
      const std::size_t before = made_.lesions.size();
      add(f, grade, scale.grades[grade], aside, choice);
      if (made_.lesions.size() == before) grade = 0;  // the case has no such place
    }
    return std::move(made_);
  }

  /// A grade that goes with another finding's brings that along, and is told where both are there.
  void settle() {
    for (std::size_t f = 0; f < table_.findings.size(); ++f) {
      const std::vector<Grade>& grades = table_.scale_of(f).grades;
      std::uint8_t& grade = made_.grades[f];
      if (grade >= grades.size()) continue;
      if (const auto& with = grades[grade].with; with && can_show(with->finding)) {
        made_.grades[with->finding] = std::max(made_.grades[with->finding], with->grade);
      } else if (with) {
        for (std::uint8_t g = 0; g < grades.size(); ++g) {
          if (grades[g].id == grades[grade].more_than) grade = g;
        }
      }
      for (std::size_t g = 0; g < grades.size(); ++g) {
        const auto& with = grades[g].with;
        if (grades[g].more_than != grades[grade].id || !with) continue;
        if (can_show(with->finding) && made_.grades[with->finding] >= with->grade) {
          grade = static_cast<std::uint8_t>(g);
          break;
        }
      }
    }
  }

 private:
  [[nodiscard]] const cases::TourPoint* point(const std::string& id) const {
    for (const cases::TourPoint& each : map_.points) {
      if (each.id == id) return &each;
    }
    return nullptr;
  }

  /// Of a ligament: whether the case has both of its places.
  [[nodiscard]] bool can_show(std::size_t finding) const {
    const auto& line = table_.findings[finding].line;
    return !line ||
           (point(line->in_radiocarpal) != nullptr && point(line->in_midcarpal) != nullptr);
  }

  void add(std::size_t finding,
           std::uint8_t grade,
           const Grade& how,
           const Vec3& aside,
           double choice) {
    const Finding& what = table_.findings[finding];
    Lesion lesion;
    lesion.finding = static_cast<std::uint8_t>(finding);
    lesion.grade = grade;
    lesion.look = *how.shows;
    lesion.radius_mm = how.radius_mm;
    lesion.passes_mm = how.passes_mm;
    if (what.line) return add_line(*what.line, how, lesion);
    if (!what.at.empty()) {
      if (const auto* at = point(what.at)) {
        lay(lesion, *at, moved(*at, aside * kAsideMm), {}, 0);
      }
      return;
    }
    if (!what.among.empty()) return add_loose(what, lesion, choice);
    add_disc_tear(table_.scale_of(finding).grades[grade].id, how, lesion);
    if (how.beside) add_beside(*how.beside, lesion);
  }

  /// Along the wall, step by step: the joint is narrow, and the other side may be nearer to a place
  /// straight beside it.
  [[nodiscard]] Vec3 moved(const cases::TourPoint& place, const Vec3& aside) const {
    Vec3 at = place.at;
    for (int i = 0; i < kStepsAside; ++i) {
      const Vec3 out = outwards(place.joint, at);
      at = on_wall(place.joint, at + (aside - out * dot(aside, out)) / kStepsAside);
    }
    return at;
  }

  void add_beside(const PatchBeside& patch, Lesion lesion) {
    const cases::TourPoint* near = point(patch.near);
    if (near == nullptr) return;
    cases::TourPoint place = *near;
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      if (name_of(data_.bones[b].bone) == patch.on) place.body = static_cast<std::uint8_t>(b);
    }
    lesion.look = patch.shows;
    lesion.radius_mm = patch.radius_mm;
    lesion.passes_mm = 0;
    lay(lesion, place, place.at + radial_ * patch.radially_mm, {}, 0);
  }

  /// Both joints show a ligament's line; from distal only what has a step, as a line that gapes.
  void add_line(const TornLine& line, const Grade& how, Lesion lesion) {
    const cases::TourPoint* proximal = point(line.in_radiocarpal);
    const cases::TourPoint* distal = point(line.in_midcarpal);
    if (proximal == nullptr || distal == nullptr) return;
    part(line, across(line, proximal->at, distal->at), how);
    lay(lesion, *proximal, proximal->at, volar_, how.length_mm);
    if (!(how.distal_radius_mm > 0)) return;
    lesion.look = LesionLook::Tear;
    lesion.radius_mm = how.distal_radius_mm;
    lay(lesion, *distal, distal->at, volar_, how.length_mm);
  }

  /// Across the interval, towards the bone that tears loose: of its face in the mean, from place to
  /// place. Where the bones are not so near each other, from middle to middle across the pull.
  [[nodiscard]] Vec3 across(const TornLine& line, const Vec3& from, const Vec3& to) const {
    const std::string& other = line.away_from.front();
    Vec3 way = middle_of({line.moves}) - middle_of({other});
    way = normalized_or(way - map_.distal * dot(way, map_.distal), radial_);
    const Grid<float>* moves = field_of(line.moves);
    const Grid<float>* stays = field_of(other);
    if (moves == nullptr || stays == nullptr) return way;
    const double cartilage_mm = BandTable::generic().cartilage_mm;
    Vec3 sum;
    for (int i = 0; i <= kStepsAcross; ++i) {
      const Vec3 at = from + (to - from) * (static_cast<double>(i) / kStepsAcross);
      const BesideBone place = beside_bone(*stays, *moves, cartilage_mm, {}, at);
      if (place.is_near) sum += place.across;
    }
    return normalized_or(sum, way);
  }

  [[nodiscard]] const Grid<float>* field_of(const std::string& bone) const {
    for (const cases::Bone& each : data_.bones) {
      if (name_of(each.bone) == bone && !each.distance_field.values().empty()) {
        return &each.distance_field;
      }
    }
    return nullptr;
  }

  /// Across the interval by the gap, and the bone that tears loose distally along the other's face
  /// by the step. Both sides move by half of it across the pull, so that the line between them
  /// stays; along the pull that bone alone, which follows it: the others would go into the radius.
  void part(const TornLine& line, const Vec3& way, const Grade& how) {
    const Vec3 along = normalized_or(map_.distal - way * dot(way, map_.distal), map_.distal);
    const Vec3 others = (way - map_.distal * dot(way, map_.distal)) * (-how.gap_mm / 2);
    shift({line.moves}, others + way * how.gap_mm + along * how.step_mm);
    shift(line.away_from, others);
  }

  [[nodiscard]] Vec3 middle_of(const std::vector<std::string>& bones) const {
    Vec3 sum;
    double count = 0;
    for (const cases::Bone& bone : data_.bones) {
      for (const std::string& name : bones) {
        if (name_of(bone.bone) != name) continue;
        for (const Vec3& v : bone.surface.vertices) sum += v;
        count += static_cast<double>(bone.surface.vertices.size());
      }
    }
    return count > 0 ? sum / count : sum;
  }

  void shift(const std::vector<std::string>& bones, const Vec3& by) {
    for (std::size_t b = 0; b < data_.bones.size(); ++b) {
      for (const std::string& name : bones) {
        if (name_of(data_.bones[b].bone) == name) made_.shifts[b] += by;
      }
    }
  }

  void add_disc_tear(const std::string& kind, const Grade& how, Lesion lesion) {
    const cases::TourPoint* middle = point("disc");
    const cases::TourPoint* edge = point("foveal_insertion");
    const cases::TourPoint* ligaments = point("ulnolunate");
    if (kind == "1A" && middle != nullptr) {
      lay(lesion, *middle, middle->at + radial_ * kRadialOfMiddleMm, volar_, how.length_mm);
    } else if (kind == "1D" && middle != nullptr) {
      lay(lesion, *middle, middle->at + radial_ * kToRimMm, volar_, how.length_mm);
    } else if (kind.starts_with('2') && middle != nullptr) {
      lay(lesion, *middle, middle->at, radial_, how.length_mm);
    } else if (kind == "1B" && edge != nullptr) {
      lay(lesion, *edge, edge->at, volar_, how.length_mm);
    } else if (kind == "1C" && ligaments != nullptr) {
      lay(lesion, *ligaments, ligaments->at, map_.distal, how.length_mm);
    }
  }

  /// It lies on the wall by one of the places.
  void add_loose(const Finding& what, Lesion lesion, double choice) {
    const auto count = static_cast<double>(what.among.size());
    const auto at = static_cast<std::size_t>(choice * count);
    for (std::size_t i = 0; i < what.among.size(); ++i) {
      const auto* place = point(what.among[(at + i) % what.among.size()]);
      if (place == nullptr) continue;
      const Vec3 out = outwards(place->joint, place->at);
      lesion.joint = place->joint;
      lesion.body = place->body;
      lesion.outwards = out;
      lesion.from = lesion.to = place->at - out * (lesion.radius_mm * 0.8);
      made_.lesions.push_back(lesion);
      return;
    }
  }

  void lay(Lesion lesion,
           const cases::TourPoint& place,
           const Vec3& middle,
           const Vec3& along,
           double length_mm) {
    lesion.joint = place.joint;
    lesion.body = place.body;
    const Vec3 at = on_wall(lesion.joint, middle);
    lesion.outwards = outwards(lesion.joint, at);
    const Vec3 way = normalized_or(along - lesion.outwards * dot(along, lesion.outwards), {});
    lesion.from = on_wall(lesion.joint, at - way * (length_mm / 2));
    lesion.to = on_wall(lesion.joint, at + way * (length_mm / 2));
    if (made_.lesions.size() < cases::kMaxLesions) made_.lesions.push_back(lesion);
  }

  [[nodiscard]] Vec3 outwards(std::uint8_t joint, const Vec3& at) const {
    return normalized_or(fields::sample_distance(map_.joints[joint].wall, at).gradient,
                         -map_.distal);
  }

  [[nodiscard]] Vec3 on_wall(std::uint8_t joint, Vec3 at) const {
    for (int i = 0; i < 4; ++i) {
      const fields::DistanceSample s = fields::sample_distance(map_.joints[joint].wall, at);
      if (!s.is_inside_grid) break;
      at -= normalized_or(s.gradient, {}) * s.distance_mm;
    }
    return at;
  }

  const cases::CaseData& data_;
  const cases::ArthroscopicMap& map_;
  const PathologyTable& table_;
  Rng rng_;
  Vec3 volar_;
  Vec3 radial_;
  cases::JointLesions made_;
};

}  // namespace

cases::Grades grades_by(std::uint64_t seed, const PathologyTable& table, Drawn among) {
  Rng rng(seed ^ kGradesStream);
  const auto wrong_ones = [&](std::size_t finding) {
    const Scale& scale = table.scale_of(finding);
    return among == Drawn::All ? scale.grades.size() - 1 : scale.drawn();
  };
  cases::Grades grades{};
  const bool is_healthy = rng.uniform() < table.healthy_share;
  bool has_any = false;
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    const bool is_there = rng.uniform() < table.findings[f].chance;
    const auto grade = static_cast<std::uint8_t>(1 + rng.below(wrong_ones(f)));
    if (is_healthy || !is_there) continue;
    grades[f] = grade;
    has_any = true;
  }
  // Not healthy by another name.
  if (!is_healthy && !has_any && !table.findings.empty()) {
    grades[0] = static_cast<std::uint8_t>(1 + rng.below(wrong_ones(0)));
  }
  return grades;
}

cases::JointLesions make_lesions(const cases::CaseData& data,
                                 const cases::ArthroscopicMap& map,
                                 const PathologyTable& table,
                                 const cases::Grades& grades,
                                 std::uint64_t seed) {
  return LesionMaker(data, map, table, grades, seed).make();
}

}  // namespace carpus::arthroscopy
