// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/snapshot_message.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/hexadecimal.hpp"
#include "instruments/instrument.hpp"
#include "procedure/shots.hpp"
#include "session/descriptions.hpp"
#include "simulation/c_arm_angles.hpp"

namespace carpus::session {

namespace {

/// -1 for the number that stands for none.
std::int64_t number_of(std::uint8_t value, std::uint8_t none) noexcept {
  return value == none ? -1 : static_cast<std::int64_t>(value);
}

protocol::HandState message_of(const simulation::HandView& hand, const BodyNames& bodies) {
  protocol::HandState message;
  message.item = number_of(hand.item, simulation::kNoItem);
  message.touching = hand.touching;
  message.touched_body = bodies.name(hand.touched_body);
  message.contact_depth_mm = std::max(0.0, hand.contact_depth_mm);
  message.contact_normal = hand.contact_normal_in_patient;
  message.force_n = hand.force_in_patient;
  message.resistance_n = std::max(0.0, hand.resistance_n);
  message.thrust_n = std::max(0.0, hand.thrust_n);
  message.torque_n_mm = std::clamp(hand.torque_n_mm, 0.0, 10000.0);
  return message;
}

protocol::Item message_of(const simulation::ItemView& item,
                          std::size_t index,
                          const BodyNames& bodies) {
  protocol::Item message;
  message.item = static_cast<std::int64_t>(index);
  message.instrument = instruments::catalogue()[item.instrument].id;
  message.hand = number_of(item.hand, simulation::kNoHand);
  message.body = bodies.name(item.body);
  message.wire = number_of(item.wire, simulation::kNoItem);
  message.tip_mm = item.tip_in_patient;
  message.shaft = item.shaft_in_patient;
  message.in_target = item.in_target;
  message.tip_body = bodies.name(item.tip_body);
  message.tip_hu = item.tip_hu;
  if (item.body != simulation::kNoBody) message.entry_mm = item.entry_in_patient;
  message.depth_mm = item.depth_mm;
  message.buried_mm = item.buried_mm;
  message.by_far_end = item.by_far_end;
  message.length_mm = item.length_mm;
  message.bent_at_mm = std::clamp(item.bent_at_mm, 0.0, item.length_mm);
  message.outer_shaft = item.outer_shaft_in_patient;
  return message;
}

/// A hand feels bone, not which.
constexpr const char* kSomeBone = "bone";

/// Takes out what only the simulation knows: in which bone a tip is, how deep a tail lies, what is
/// done rightly. What a hand feels stays, and how far an instrument went in: it can be seen on it.
void blind(protocol::Snapshot& message) {
  message.step = 0;
  message.completed_steps.clear();
  message.holding_share = 1.0;
  for (protocol::HandState& hand : message.hands) {
    if (!hand.touched_body.empty()) hand.touched_body = kSomeBone;
  }
  for (protocol::Item& item : message.items) {
    if (!item.body.empty()) item.body = kSomeBone;
    item.in_target = false;
    item.tip_body.clear();
    item.tip_hu = 0.0;
    item.buried_mm = 0.0;
  }
}

}  // namespace

std::array<double, 4> quaternion_of(const Mat3& rotation) noexcept {
  const auto& m = rotation.rows;
  const double trace = m[0].x + m[1].y + m[2].z;
  std::array<double, 4> q{};
  if (trace >= m[0].x && trace >= m[1].y && trace >= m[2].z) {
    q = {1 + trace, m[2].y - m[1].z, m[0].z - m[2].x, m[1].x - m[0].y};
  } else if (m[0].x >= m[1].y && m[0].x >= m[2].z) {
    q = {m[2].y - m[1].z, 1 + 2 * m[0].x - trace, m[1].x + m[0].y, m[0].z + m[2].x};
  } else if (m[1].y >= m[2].z) {
    q = {m[0].z - m[2].x, m[1].x + m[0].y, 1 + 2 * m[1].y - trace, m[2].y + m[1].z};
  } else {
    q = {m[1].x - m[0].y, m[0].z + m[2].x, m[2].y + m[1].z, 1 + 2 * m[2].z - trace};
  }
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  const double scale = (q[0] < 0 ? -1.0 : 1.0) / size;
  for (double& value : q) value *= scale;
  return q;
}

protocol::Snapshot snapshot_message(const simulation::Snapshot& now,
                                    const HostState& host,
                                    const BodyNames& bodies) {
  protocol::Snapshot message;
  message.tick = static_cast<std::int64_t>(now.tick);
  message.state_hash = hexadecimal(now.state_hash);
  message.paused = host.paused;
  message.finished = now.finished;
  message.step = now.step;
  for (std::int64_t i = 0; i < 32; ++i) {
    if ((now.completed_steps >> i & 1U) != 0) message.completed_steps.push_back(i);
  }
  for (const simulation::HandView& hand : now.hands) {
    message.hands.push_back(message_of(hand, bodies));
  }
  for (std::size_t i = 0; i < now.items.size(); ++i) {
    if (now.items[i].instrument >= instruments::catalogue().size()) continue;
    message.items.push_back(message_of(now.items[i], i, bodies));
  }
  message.wrist = session::message_of(now.wrist);
  message.tissue_revision = now.tissue_revision;
  if (now.gauge_reading_mm >= 0) message.gauge_reading_mm = now.gauge_reading_mm;
  message.holding_share = std::clamp(now.holding_share, 0.0, 1.0);
  message.passes = now.passes;
  if (now.judgement != procedure::Judgement::None) {
    message.judged_displaced = now.judgement == procedure::Judgement::Displaced;
  }
  message.c_arm = {simulation::held_rotation_deg(now.c_arm.rotation_deg, now.wrist.pronation_rad),
                   now.c_arm.tilt_deg, now.c_arm.pedal_is_down && !host.paused && !now.finished,
                   static_cast<double>(procedure::kTubeKv[procedure::voltage_of(now.tube)]),
                   static_cast<protocol::DoseLevel>(procedure::dose_level_of(now.tube))};
  message.shots = now.looks;
  message.dose_cgy_cm2 = procedure::dose_cgy_cm2(now.dose_units);
  message.undos = now.undos;
  message.tick_rate_hz = host.tick_rate_hz;
  message.tick_p99_us = host.tick_p99_us;
  message.late_ticks = static_cast<std::int64_t>(host.late_ticks);
  if (now.mode == procedure::Mode::Assessed && !now.finished) blind(message);
  // A paused simulation asks for no force: whatever draws on it stands still with time.
  if (host.paused) {
    for (protocol::HandState& hand : message.hands) hand.force_n = {};
  }
  return message;
}

std::vector<protocol::BodyPose> body_poses(const simulation::Snapshot& now) {
  std::vector<protocol::BodyPose> poses;
  for (std::size_t body = 0; body < now.body_count; ++body) {
    const auto& pose = now.patient_from_bone[body];
    poses.push_back({quaternion_of(pose.rotation), pose.translation});
  }
  return poses;
}

protocol::Tissue tissue_message(const simulation::Snapshot& now, const BodyNames& bodies) {
  protocol::Tissue message;
  message.revision = now.tissue_revision;
  for (std::size_t i = 0; i < now.track_count; ++i) {
    const simulation::TrackView& track = now.tracks[i];
    message.tracks.push_back({bodies.name(track.body), track.from_in_bone, track.to_in_bone,
                              track.from_radius_mm, track.to_radius_mm});
  }
  return message;
}

}  // namespace carpus::session
