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

#include "soft_tissue/detail/force_lines.hpp"
#include "soft_tissue/detail/joint_contacts.hpp"
#include "soft_tissue/detail/wrist_bodies.hpp"

namespace carpus::soft_tissue {
namespace {

using detail::Bodies;
using detail::Contact;
using detail::ForceLine;
using detail::kBodies;
using detail::kHand;
using detail::Load;

/// Tissue that holds a little in every way, so that nothing floats [N/mm; E].
constexpr double kCapsuleStiffness = 0.5;
constexpr int kRounds = 1500;
constexpr double kBalancedN = 0.05;
constexpr std::size_t kMostForces = 8;

class Bench {
 public:
  Bench(const cases::CaseData& data, const SoftTissue& tissue, const TractionOptions& options)
      : tissue_(tissue),
        options_(options),
        // As in a traction tower: along the forearm.
        way_(data.wrist_from_patient.rotation.transposed() * Vec3{-1, 0, 0}),
        bodies_(detail::bodies_as_scanned(data)),
        lines_(detail::make_force_lines(data,
                                        tissue,
                                        {options.stiffness_factor, options.radiocarpal_slack_mm,
                                         options.midcarpal_slack_mm, options.without})),
        contacts_(detail::make_contacts(data, bodies_, {})) {
    find_stiffness();
  }

  TractionResult pull() {
    Load load = load_at(bodies_);
    double step = 1;
    for (int round = 0; round < kRounds && unbalanced(load) > kBalancedN; ++round) {
      Bodies next = bodies_;
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
  void find_stiffness() {
    shift_stiffness_.fill(kCapsuleStiffness);
    turn_stiffness_.fill(kCapsuleStiffness * 50);
    const auto add = [&](std::size_t body, const Vec3& p, double stiffness) {
      shift_stiffness_[body] += stiffness;
      turn_stiffness_[body] += stiffness * squared_length(p - bodies_[body].middle);
    };
    for (const ForceLine& line : lines_) {
      for (const auto& [body, p] : line.points) add(body, p, line.stiffness_n_per_mm);
    }
    for (const Contact& c : contacts_) {
      add(c.body, c.point, 0.2 * c.stiffness_n_per_mm);
      add(c.other_body, c.point, 0.2 * c.stiffness_n_per_mm);
    }
  }

  Load load_at(const Bodies& bodies) const {
    Load load;
    load.force[kHand] = way_ * options_.force_n;
    load.energy = -options_.force_n * dot(way_, bodies[kHand].shift);
    for (std::size_t b = 1; b < kBodies; ++b) {
      load.energy += 0.5 * kCapsuleStiffness * squared_length(bodies[b].shift);
      load.force[b] -= bodies[b].shift * kCapsuleStiffness;
    }
    detail::pull_lines(lines_, bodies, load);
    detail::push_contacts(contacts_, bodies, load);
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
    for (const ForceLine& line : lines_) {
      forces[tissue_.ligaments[line.ligament].id] +=
          line.stiffness_n_per_mm * std::max(0.0, detail::length_now(line, bodies_) - line.rest_mm);
    }
    for (const auto& [id, newtons] : forces) r.forces.push_back({id, newtons});
    std::stable_sort(
        r.forces.begin(), r.forces.end(),
        [](const StrandForce& a, const StrandForce& b) { return a.newtons > b.newtons; });
    if (r.forces.size() > kMostForces) r.forces.resize(kMostForces);
    return r;
  }

  const SoftTissue& tissue_;
  const TractionOptions& options_;
  Vec3 way_;
  Bodies bodies_;
  std::vector<ForceLine> lines_;
  std::vector<Contact> contacts_;
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
