// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The unknowns are small motions: of each body a shift and a rotation vector about its middle. Each
// round linearises nothing but the rotations: forces and moments are the energy's exact gradient at
// the bodies' true poses; a step is that gradient against a block-diagonal stiffness, shortened
// until the energy falls.
#include "soft_tissue/traction.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "fields/distance_field.hpp"

namespace carpus::soft_tissue {
namespace {

constexpr std::size_t kBodies = 5;  ///< forearm, scaphoid, lunate, triquetrum, hand
constexpr std::size_t kHand = 4;
/// Joint surfaces push where they come nearer than in the scan, or than this [mm].
constexpr double kContactMm = 0.6;
/// Of one sample of a surface [N/mm; E]; a joint has tens.
constexpr double kContactStiffness = 40;
constexpr std::size_t kContactSamples = 260;  ///< a bone
/// Tissue that holds a little in every way, so that nothing floats [N/mm; E].
constexpr double kCapsuleStiffness = 0.5;
constexpr int kRounds = 1500;
constexpr double kBalancedN = 0.05;
constexpr std::size_t kMostForces = 8;

std::size_t body_of(BoneId bone) {
  switch (bone) {
    case BoneId::Radius:
    case BoneId::Ulna:
      return 0;
    case BoneId::Scaphoid:
      return 1;
    case BoneId::Lunate:
      return 2;
    case BoneId::Triquetrum:
    case BoneId::Pisiform:
      return 3;
    default:
      return kHand;
  }
}

struct Placed {
  Mat3 rotation;
  Vec3 middle;  ///< as scanned
  Vec3 shift;
  [[nodiscard]] Vec3 at(const Vec3& p) const { return rotation * (p - middle) + middle + shift; }
  [[nodiscard]] Vec3 back(const Vec3& p) const {
    return rotation.transposed() * (p - middle - shift) + middle;
  }
};

struct Line {
  std::size_t ligament = 0;
  std::vector<std::pair<std::size_t, Vec3>> points;  ///< body and place as scanned
  double rest_mm = 0;
  double stiffness = 0;
};

/// A sample of one bone's surface against another bone.
struct Touch {
  std::size_t body = 0;
  Vec3 point;
  std::size_t other_body = 0;
  const Grid<float>* other = nullptr;
  double least_mm = 0;
};

struct Load {
  double energy = 0;
  std::array<Vec3, kBodies> force;
  std::array<Vec3, kBodies> moment;
};

class Bench {
 public:
  Bench(const cases::CaseData& data, const SoftTissue& tissue, const TractionOptions& options)
      : data_(data), tissue_(tissue), options_(options) {
    // As in a traction tower: along the forearm.
    way_ = data.wrist_from_patient.rotation.transposed() * Vec3{-1, 0, 0};
    find_middles();
    for (std::size_t l = 0; l < tissue.ligaments.size(); ++l) add_lines(l);
    add_touches();
    find_stiffness();
  }

  TractionResult pull() {
    Load load = load_at(bodies_);
    double step = 1;
    for (int round = 0; round < kRounds && unbalanced(load) > kBalancedN; ++round) {
      std::array<Placed, kBodies> next = bodies_;
      for (std::size_t b = 1; b < kBodies; ++b) {
        next[b].shift += load.force[b] * (step / shift_stiffness_[b]);
        if (b == kHand) continue;  // the hand is held against turning
        const Vec3 turn = load.moment[b] * (step / turn_stiffness_[b]);
        next[b].rotation =
            rotation_about(normalized_or(turn, {1, 0, 0}), length(turn)) * next[b].rotation;
      }
      const Load tried = load_at(next);
      if (tried.energy < load.energy) {
        bodies_ = next;
        load = tried;
        step *= 1.3;
      } else {
        step *= 0.4;
        if (step < 1e-9) break;
      }
    }
    return result(load);
  }

 private:
  void find_middles() {
    std::array<double, kBodies> count{};
    for (const cases::Bone& bone : data_.bones) {
      Placed& body = bodies_[body_of(bone.bone)];
      if (bone.bone > BoneId::Hamate) continue;
      for (const Vec3& v : bone.surface.vertices) body.middle += v;
      count[body_of(bone.bone)] += static_cast<double>(bone.surface.vertices.size());
    }
    for (std::size_t b = 0; b < kBodies; ++b) {
      if (count[b] > 0) bodies_[b].middle = bodies_[b].middle / count[b];
    }
  }

  std::size_t body_of_label(std::uint8_t label) const {
    for (const cases::Bone& bone : data_.bones) {
      if (bone.label == label) return body_of(bone.bone);
    }
    return 0;  // on the disc's ligaments, which stay with the forearm
  }

  double slack_of(const Ligament& l) const {
    if (l.group == "radiocarpal" || l.group == "ulnocarpal") return options_.radiocarpal_slack_mm;
    return l.group == "midcarpal" ? options_.midcarpal_slack_mm : 0;
  }

  void add_lines(std::size_t index) {
    const Ligament& l = tissue_.ligaments[index];
    for (const std::string_view cut : options_.without) {
      if (l.id.starts_with(cut)) return;
    }
    for (const Strand& s : l.strands) {
      Line line;
      line.ligament = index;
      line.stiffness = s.stiffness_n_per_mm * options_.stiffness_factor;
      for (std::size_t a = 0; a < s.anchors.size(); ++a) {
        line.points.emplace_back(body_of_label(s.anchors[a].label), s.course[s.anchors[a].point]);
      }
      line.rest_mm = slack_of(l);
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        line.rest_mm += distance(line.points[i - 1].second, line.points[i].second);
      }
      lines_.push_back(std::move(line));
    }
  }

  void add_touches() {
    for (const cases::Bone& a : data_.bones) {
      if (a.bone > BoneId::Hamate) continue;
      const std::size_t every =
          std::max<std::size_t>(1, a.surface.vertices.size() / kContactSamples);
      for (const cases::Bone& b : data_.bones) {
        if (b.bone > BoneId::Hamate || body_of(a.bone) == body_of(b.bone)) continue;
        for (std::size_t v = 0; v < a.surface.vertices.size(); v += every) {
          const Vec3& p = a.surface.vertices[v];
          const fields::DistanceSample near = fields::sample_distance(b.distance_field, p);
          if (!near.is_inside_grid || near.distance_mm > 3) continue;
          touches_.push_back({body_of(a.bone), p, body_of(b.bone), &b.distance_field,
                              std::min(kContactMm, near.distance_mm)});
        }
      }
    }
  }

  void find_stiffness() {
    shift_stiffness_.fill(kCapsuleStiffness);
    turn_stiffness_.fill(kCapsuleStiffness * 50);
    const auto add = [&](std::size_t body, const Vec3& p, double stiffness) {
      shift_stiffness_[body] += stiffness;
      turn_stiffness_[body] += stiffness * squared_length(p - bodies_[body].middle);
    };
    for (const Line& line : lines_) {
      for (const auto& [body, p] : line.points) add(body, p, line.stiffness);
    }
    for (const Touch& t : touches_) {
      add(t.body, t.point, 0.2 * kContactStiffness);
      add(t.other_body, t.point, 0.2 * kContactStiffness);
    }
  }

  static void push(Load& load,
                   const std::array<Placed, kBodies>& bodies,
                   std::size_t body,
                   const Vec3& at,
                   const Vec3& force) {
    load.force[body] += force;
    load.moment[body] += cross(at - bodies[body].middle - bodies[body].shift, force);
  }

  /// Length of a line now, and the pull of a unit tension on its points, into `load`.
  static double length_now(const Line& line, const std::array<Placed, kBodies>& bodies) {
    double length = 0;
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const auto& [a, p] = line.points[i - 1];
      const auto& [b, q] = line.points[i];
      length += distance(bodies[a].at(p), bodies[b].at(q));
    }
    return length;
  }

  Load load_at(const std::array<Placed, kBodies>& bodies) const {
    Load load;
    load.force[kHand] = way_ * options_.force_n;
    load.energy = -options_.force_n * dot(way_, bodies[kHand].shift);
    for (std::size_t b = 1; b < kBodies; ++b) {
      load.energy += 0.5 * kCapsuleStiffness * squared_length(bodies[b].shift);
      load.force[b] -= bodies[b].shift * kCapsuleStiffness;
    }
    for (const Line& line : lines_) {
      const double stretch = length_now(line, bodies) - line.rest_mm;
      if (stretch <= 0) continue;
      load.energy += 0.5 * line.stiffness * stretch * stretch;
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        const auto& [a, p] = line.points[i - 1];
        const auto& [b, q] = line.points[i];
        const Vec3 from = bodies[a].at(p);
        const Vec3 to = bodies[b].at(q);
        const Vec3 tension = normalized_or(to - from, {}) * (line.stiffness * stretch);
        push(load, bodies, a, from, tension);
        push(load, bodies, b, to, -tension);
      }
    }
    for (const Touch& t : touches_) {
      const Vec3 at = bodies[t.body].at(t.point);
      const fields::DistanceSample near =
          fields::sample_distance(*t.other, bodies[t.other_body].back(at));
      const double depth = t.least_mm - near.distance_mm;
      if (!near.is_inside_grid || depth <= 0) continue;
      load.energy += 0.5 * kContactStiffness * depth * depth;
      const Vec3 force =
          bodies[t.other_body].rotation * near.gradient * (kContactStiffness * depth);
      push(load, bodies, t.body, at, force);
      push(load, bodies, t.other_body, at, -force);
    }
    return load;
  }

  static double unbalanced(const Load& load) {
    double worst = 0;
    for (std::size_t b = 1; b < kBodies; ++b) worst = std::max(worst, length(load.force[b]));
    return worst;
  }

  TractionResult result(const Load& load) const {
    TractionResult r;
    r.unbalanced_n = unbalanced(load);
    double row = 0;
    for (std::size_t b = 1; b < kHand; ++b) row += dot(way_, bodies_[b].shift) / (kHand - 1);
    r.radiocarpal_mm = row;
    r.midcarpal_mm = dot(way_, bodies_[kHand].shift) - row;
    std::map<std::string, double> forces;
    for (const Line& line : lines_) {
      forces[tissue_.ligaments[line.ligament].id] +=
          line.stiffness * std::max(0.0, length_now(line, bodies_) - line.rest_mm);
    }
    for (const auto& [id, newtons] : forces) r.forces.push_back({id, newtons});
    std::stable_sort(
        r.forces.begin(), r.forces.end(),
        [](const StrandForce& a, const StrandForce& b) { return a.newtons > b.newtons; });
    if (r.forces.size() > kMostForces) r.forces.resize(kMostForces);
    return r;
  }

  const cases::CaseData& data_;
  const SoftTissue& tissue_;
  const TractionOptions& options_;
  Vec3 way_;
  std::array<Placed, kBodies> bodies_;
  std::vector<Line> lines_;
  std::vector<Touch> touches_;
  std::array<double, kBodies> shift_stiffness_{};
  std::array<double, kBodies> turn_stiffness_{};
};

}  // namespace

TractionResult pull(const cases::CaseData& data,
                    const SoftTissue& tissue,
                    const TractionOptions& options) {
  return Bench(data, tissue, options).pull();
}

TractionOptions fit_slack(const cases::CaseData& data,
                          const SoftTissue& tissue,
                          TractionOptions options,
                          double radiocarpal_mm,
                          double midcarpal_mm) {
  constexpr int kTries = 8;
  constexpr double kCloseMm = 0.02;
  // More slack opens a joint by nearly as much: a few corrections do.
  for (int i = 0; i < kTries; ++i) {
    const TractionResult now = pull(data, tissue, options);
    const double radiocarpal = radiocarpal_mm - now.radiocarpal_mm;
    const double midcarpal = midcarpal_mm - now.midcarpal_mm;
    if (std::max(std::abs(radiocarpal), std::abs(midcarpal)) < kCloseMm) break;
    options.radiocarpal_slack_mm += radiocarpal;
    options.midcarpal_slack_mm += midcarpal;
  }
  return options;
}

}  // namespace carpus::soft_tissue
