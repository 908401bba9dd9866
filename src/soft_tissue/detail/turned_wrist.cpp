// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "soft_tissue/detail/turned_wrist.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carpus::soft_tissue::detail {
namespace {

/// Contacts are looked for again when a body's surface has gone so far [mm]: less than half of what
/// is left between `near_mm` and where surfaces push.
constexpr double kContactsLastMm = 1.1;
/// Of a field between voxels against the true distance, twice [mm].
constexpr double kFieldErrorMm = 0.7;
/// Of a jig that holds the hand [E]: a wrist's moments turn it by less than a tenth of a degree.
constexpr double kGuideNmmPerRad = 1e6;

/// How the rotation vector's component along `axis` grows with a small further turn, per radian.
Vec3 growth_along(const Vec3& axis, const Vec3& vector) {
  const double angle = length(vector);
  // 1/a^2 - (1 + cos a) / (2 a sin a), by its series where a is small.
  const double c =
      angle < 1e-3 ? 1.0 / 12
                   : 1 / (angle * angle) - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  const Vec3 once = cross(vector, axis);
  return axis + 0.5 * once + c * cross(vector, once);
}

}  // namespace

Vec3 rotation_vector(const Mat3& m) noexcept {
  const Vec3 twice_sine{m.rows[2].y - m.rows[1].z, m.rows[0].z - m.rows[2].x,
                        m.rows[1].x - m.rows[0].y};
  const double sine = 0.5 * length(twice_sine);
  const double cosine = 0.5 * (m.rows[0].x + m.rows[1].y + m.rows[2].z - 1);
  const double angle = std::atan2(sine, cosine);
  return sine > 1e-9 ? twice_sine * (0.5 * angle / sine) : 0.5 * twice_sine;
}

TurnedWrist::TurnedWrist(const cases::CaseData& data,
                         std::vector<ForceLine> lines,
                         const ContactOptions& contacts,
                         const Press& press,
                         double holding_n_per_mm)
    : data_(data),
      lines_(std::move(lines)),
      contact_options_(contacts),
      press_(press),
      holding_n_per_mm_(holding_n_per_mm),
      bodies_(bodies_as_scanned(data)) {
  for (const cases::Bone& bone : data.bones) {
    if (bone.bone > BoneId::Hamate) continue;
    const std::size_t body = body_of(bone.bone);
    for (const Vec3& v : bone.surface.vertices) {
      reach_mm_[body] = std::max(reach_mm_[body], distance(v, bodies_[body].middle));
    }
  }
  find_contacts(bodies_);
}

void TurnedWrist::lay(const Bodies& bodies) {
  bodies_ = bodies;
  find_contacts(bodies_);
}

LeftOver TurnedWrist::rest_under(const HandLoad& hand) {
  return search_rest(
      bodies_, {}, [&](const Bodies& bodies) { return load_at(bodies, hand); },
      [&](const Bodies& bodies, Stiffness& stiffness) { stiffness_at(bodies, hand, stiffness); });
}

void TurnedWrist::find_contacts(const Bodies& bodies) {
  contacts_ = make_contacts(data_, bodies, contact_options_);
  std::stable_sort(contacts_.begin(), contacts_.end(),
                   [](const Contact& a, const Contact& b) { return a.room_mm < b.room_mm; });
  contacts_found_at_ = bodies;
}

double TurnedWrist::gone_mm(const Bodies& bodies) const noexcept {
  double most = 0;
  for (std::size_t b = 1; b < kBodies; ++b) {
    const PlacedBody& now = bodies[b];
    const PlacedBody& then = contacts_found_at_[b];
    double squares = 0;  // of what the rotations differ by; a chord's length is its root / sqrt 2
    for (std::size_t r = 0; r < 3; ++r) {
      squares += squared_length(now.rotation.rows[r] - then.rotation.rows[r]);
    }
    most =
        std::max(most, distance(now.shift, then.shift) + reach_mm_[b] * std::sqrt(0.5 * squares));
  }
  return most;
}

std::span<const Contact> TurnedWrist::contacts_within(double gone) const noexcept {
  const auto end = std::partition_point(contacts_.begin(), contacts_.end(), [&](const Contact& c) {
    return c.room_mm < 2 * gone + kFieldErrorMm;
  });
  return {contacts_.begin(), end};
}

Load TurnedWrist::load_at(const Bodies& bodies, const HandLoad& hand) {
  double gone = gone_mm(bodies);
  if (gone > kContactsLastMm) {
    find_contacts(bodies);
    gone = 0;
  }
  Load load;
  const Vec3 vector = rotation_vector(bodies[kHand].rotation);
  load.energy -= hand.moment_nmm * dot(hand.axis, vector);
  load.moment[kHand] += hand.moment_nmm * growth_along(hand.axis, vector);
  for (const HandLoad::Guide& guide : hand.guides) {
    const double off = dot(guide.axis, vector) - guide.angle_rad;
    load.energy += 0.5 * kGuideNmmPerRad * off * off;
    load.moment[kHand] -= kGuideNmmPerRad * off * growth_along(guide.axis, vector);
  }
  const Vec3 from = bodies[kHand].at(press_.on_hand);
  load.energy += press_.newtons * distance(from, press_.on_forearm);
  load.push(bodies, kHand, from, normalized_or(press_.on_forearm - from, {}) * press_.newtons);
  for (std::size_t b = 1; b < kBodies; ++b) {
    load.energy += 0.5 * holding_n_per_mm_ * squared_length(bodies[b].shift);
    load.force[b] -= bodies[b].shift * holding_n_per_mm_;
  }
  pull_lines(lines_, bodies, load);
  push_contacts(contacts_within(gone), bodies, load);
  return load;
}

void TurnedWrist::stiffness_at(const Bodies& bodies,
                               const HandLoad& hand,
                               Stiffness& stiffness) const {
  const auto arm = [&](std::size_t body, const Vec3& at) {
    return at - bodies[body].middle - bodies[body].shift;
  };
  // A pull between two places: its direction turns as they go aside.
  const auto add_pull = [&](std::size_t a, const Vec3& from, std::size_t b, const Vec3& to,
                            double newtons) {
    const double far = distance(from, to);
    if (!(far > 1e-6)) return;
    const Vec3 way = (to - from) / far;
    const Vec3 aside = any_perpendicular(way);
    for (const Vec3& v : {aside, cross(way, aside)}) {
      Unknowns change{};
      add_change(change, b, arm(b, to), v, 1);
      add_change(change, a, arm(a, from), v, -1);
      stiffness.add_spring(change, newtons / far);
    }
    stiffness.add_turning(a, arm(a, from), way * newtons);
    stiffness.add_turning(b, arm(b, to), way * -newtons);
  };
  const Vec3 vector = rotation_vector(bodies[kHand].rotation);
  for (const HandLoad::Guide& guide : hand.guides) {
    const Vec3 growth = growth_along(guide.axis, vector);
    Unknowns change{};
    for (std::size_t i = 0; i < 3; ++i) change[6 * (kHand - 1) + 3 + i] = growth[i];
    stiffness.add_spring(change, kGuideNmmPerRad);
  }
  for (std::size_t b = 1; b < kBodies; ++b) stiffness.add_shift(b, holding_n_per_mm_);
  add_pull(kHand, bodies[kHand].at(press_.on_hand), kForearm, press_.on_forearm, press_.newtons);
  for (const ForceLine& line : lines_) {
    const double stretch = length_now(line, bodies) - line.rest_mm;
    if (stretch <= 0) continue;
    Unknowns change{};
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const auto& [a, p] = line.points[i - 1];
      const auto& [b, q] = line.points[i];
      const Vec3 from = bodies[a].at(p);
      const Vec3 to = bodies[b].at(q);
      const Vec3 way = normalized_or(to - from, {});
      add_change(change, b, arm(b, to), way, 1);
      add_change(change, a, arm(a, from), way, -1);
      add_pull(a, from, b, to, line.stiffness_n_per_mm * stretch);
    }
    stiffness.add_spring(change, line.stiffness_n_per_mm);
  }
  for (const Contact& c : contacts_within(gone_mm(bodies))) {
    const Pressing pressing = pressing_of(c, bodies);
    if (!(pressing.depth_mm > 0)) continue;
    Unknowns change{};
    add_change(change, c.body, arm(c.body, pressing.at), pressing.out, 1);
    add_change(change, c.other_body, arm(c.other_body, pressing.at), pressing.out, -1);
    stiffness.add_spring(change, c.stiffness_n_per_mm);
  }
}

}  // namespace carpus::soft_tissue::detail
