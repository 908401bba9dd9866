// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "contact/instrument_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/check.hpp"
#include "core/error.hpp"

namespace carpus::contact {
namespace {

/// The change along any direction of a field that changes by 1 along each axis.
constexpr double kSqrt3 = 1.7320508075688773;

/// Taken from every slack for the rounding of ends and bounds [mm]; coordinates are below 1e4 mm.
constexpr double kSlackRoundingMm = 1e-6;

template <typename In, typename Of>
bool is_finite_pose(const Pose<In, Of>& pose) noexcept {
  return is_finite(pose.translation) && is_finite(pose.rotation.rows[0]) &&
         is_finite(pose.rotation.rows[1]) && is_finite(pose.rotation.rows[2]);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) noexcept {
  const Vec3 ab = b - a;
  const double squared = squared_length(ab);
  const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
  return distance(p, a + ab * t);
}

}  // namespace

InstrumentScene::InstrumentScene(std::span<const fields::ContactField> bones,
                                 std::vector<InstrumentShape> instruments,
                                 const InstrumentSceneOptions& options)
    : bones_(bones), instruments_(std::move(instruments)), options_(options) {
  if (bones_.empty() || instruments_.empty()) {
    throw InvalidInput("instrument scene: it needs at least one bone and one instrument");
  }
  const bool is_sound = options.within_mm >= 0 && std::isfinite(options.within_mm) &&
                        options.look_ahead_mm >= 0 && std::isfinite(options.look_ahead_mm);
  if (!is_sound) {
    throw InvalidInput("instrument scene: within_mm and look_ahead_mm must be 0 or more");
  }
  for (const InstrumentShape& shape : instruments_) {
    for (const fields::ContactField& field : bones_) {
      const double greatest = greatest_gap_mm(field, shape);
      if (greatest > 0 && greatest >= options.within_mm) continue;
      throw InvalidInput("instrument scene: a shape of radius " +
                         std::to_string(shape.greatest_radius_mm()) +
                         " mm and gaps up to within_mm need a field with a wider band than " +
                         std::to_string(field.band_mm()) + " mm");
    }
  }
  const std::size_t pairs = bones_.size() * instruments_.size();
  memory_.resize(pairs);
  contacts_.resize(pairs);
  alerts_.resize(pairs);
  bone_from_patient_.resize(bones_.size());
  own_alert_count_.resize(instruments_.size());
  is_empty_.resize(instruments_.size());
}

InstrumentScene::InstrumentScene(std::span<const fields::ContactField> bones,
                                 std::size_t places,
                                 const InstrumentSceneOptions& options)
    : InstrumentScene(bones,
                      std::vector<InstrumentShape>(places, InstrumentShape(SphereShape{0.1})),
                      options) {
  for (std::size_t i = 0; i < places; ++i) is_empty_[i] = true;
}

void InstrumentScene::set_instrument(std::size_t instrument,
                                     const InstrumentShape& shape) noexcept {
  instruments_[instrument] = shape;
  is_empty_[instrument] = false;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    memory_[instrument * bones_.size() + b].slack_mm = -1;
  }
}

void InstrumentScene::clear_instrument(std::size_t instrument) noexcept {
  is_empty_[instrument] = true;
  own_alert_count_[instrument] = 0;
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    contacts_[instrument * bones_.size() + b] = {};
  }
}

void InstrumentScene::update_instrument(
    std::size_t instrument,
    const Pose<frame::Patient, frame::Tool>& patient_from_tool,
    std::span<const Pose<frame::Bone, frame::Patient>> bone_from_patient) noexcept {
  own_alert_count_[instrument] = 0;
  if (is_empty_[instrument]) return;
  counts_.pairs += bones_.size();
  update_pairs(instrument, patient_from_tool, bone_from_patient,
               alerts_.data() + instrument * bones_.size(), own_alert_count_[instrument]);
}

void InstrumentScene::forget() noexcept {
  for (Memory& memory : memory_) memory.slack_mm = -1;
}

void InstrumentScene::set_cuts(std::span<const fields::CutField> cuts) noexcept {
  CARPUS_CHECK(cuts.empty() || cuts.size() == bones_.size());
  cuts_ = cuts;
  forget();
}

void InstrumentScene::update(
    std::span<const Pose<frame::Patient, frame::Bone>> patient_from_bone,
    std::span<const Pose<frame::Patient, frame::Tool>> patient_from_tool) noexcept {
  CARPUS_CHECK(patient_from_bone.size() == bones_.size());
  CARPUS_CHECK(patient_from_tool.size() == instruments_.size());
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    bone_from_patient_[b] = patient_from_bone[b].inverse();
  }
  alert_count_ = 0;
  counts_.pairs += contacts_.size();
  for (std::size_t i = 0; i < instruments_.size(); ++i) {
    if (is_empty_[i]) continue;
    update_pairs(i, patient_from_tool[i], bone_from_patient_, alerts_.data(), alert_count_);
  }
}

void InstrumentScene::update_pairs(
    std::size_t instrument,
    const Pose<frame::Patient, frame::Tool>& tool,
    std::span<const Pose<frame::Bone, frame::Patient>> bone_from_patient,
    InstrumentBonePair* alerts,
    std::size_t& count) noexcept {
  const InstrumentShape& shape = instruments_[instrument];
  const Point<frame::Patient> front = tool * Point<frame::Tool>{{0, 0, shape.front_z_mm()}};
  const Point<frame::Patient> back = tool * Point<frame::Tool>{{0, 0, shape.back_z_mm()}};
  for (std::size_t b = 0; b < bones_.size(); ++b) {
    const std::size_t pair = instrument * bones_.size() + b;
    Memory& memory = memory_[pair];
    const Vec3 front_in_bone = (bone_from_patient[b] * front).v;
    const Vec3 back_in_bone = (bone_from_patient[b] * back).v;
    const double moved = std::max(squared_length(front_in_bone - memory.front),
                                  squared_length(back_in_bone - memory.back));
    // False for NaN.
    if (memory.slack_mm > 0 && moved < memory.slack_mm * memory.slack_mm) {
      ++counts_.left_alone;
      continue;
    }
    memory = {front_in_bone, back_in_bone, -1};
    if (is_finite_pose(tool) && is_finite_pose(bone_from_patient[b])) {
      look_at(pair, b, shape, bone_from_patient[b] * tool);
    } else {
      contacts_[pair] = {};
      ++counts_.not_known;
    }
    const SurfaceContact& contact = contacts_[pair];
    if (contact.has_contact() || contact.outcome == ContactOutcome::NotKnown) {
      alerts[count++] = {static_cast<std::uint32_t>(instrument), static_cast<std::uint32_t>(b)};
    }
  }
}

double InstrumentScene::bound_by_box_and_ball(const fields::ContactField& field,
                                              const Memory& axis) const noexcept {
  const double by_ball =
      distance_to_segment(field.ball_centre(), axis.front, axis.back) - field.ball_radius_mm();
  Aabb shaft;
  shaft.include(axis.front);
  shaft.include(axis.back);
  const Aabb& box = field.surface_box();
  Vec3 apart;
  for (std::size_t a = 0; a < 3; ++a) {
    apart[a] = std::max({box.low[a] - shaft.high[a], shaft.low[a] - box.high[a], 0.0});
  }
  return std::max(by_ball, length(apart));
}

void InstrumentScene::set_far(std::size_t pair,
                              const fields::ContactField& field,
                              const InstrumentShape& shape,
                              double slack_mm) noexcept {
  // The same whether the pair was walked, bounded or left alone.
  SurfaceContact& contact = contacts_[pair];
  contact = {};
  contact.outcome = ContactOutcome::Far;
  contact.gap_mm = lowest_gap_mm(field, shape, options_.within_mm);
  contact.lowest_gap_mm = contact.gap_mm;
  contact.highest_gap_mm = std::numeric_limits<double>::infinity();
  memory_[pair].slack_mm = slack_mm - kSlackRoundingMm;
}

void InstrumentScene::look_at(std::size_t pair,
                              std::size_t bone,
                              const InstrumentShape& shape,
                              const Pose<frame::Bone, frame::Tool>& bone_from_tool) noexcept {
  const fields::ContactField& field = bones_[bone];
  // A true gap that exceeds within_mm by the field's error is Far by the field as well.
  const double bound = bound_by_box_and_ball(field, memory_[pair]) - shape.greatest_radius_mm() -
                       field.error_mm() - options_.within_mm;
  if (bound > options_.look_ahead_mm) {
    ++counts_.by_bounds;
    set_far(pair, field, shape, bound);
    return;
  }
  ++counts_.by_field;
  const bool is_cut = !cuts_.empty() && cuts_[bone].is_cut();
  const double look = options_.within_mm + options_.look_ahead_mm;
  SurfaceContact contact =
      is_cut ? find_contact(fields::CutBone{field, cuts_[bone]}, shape, bone_from_tool, look)
             : find_contact(field, shape, bone_from_tool, look);
  if (contact.outcome == ContactOutcome::Far || contact.gap_mm > options_.within_mm) {
    // By the field's own steepness, or by the true distance, which changes no faster than the way.
    const double gap =
        contact.outcome == ContactOutcome::Far
            ? std::min(options_.within_mm + options_.look_ahead_mm, greatest_gap_mm(field, shape))
            : contact.gap_mm;
    const double steepest =
        is_cut ? std::max(field.steepest(), cuts_[bone].steepest()) : field.steepest();
    const double by_field = (gap - options_.within_mm) / (kSqrt3 * steepest);
    // With cuts the field is bound from below by max(d, -t), not by the true distance.
    const double lowest = is_cut ? gap - field.error_mm() : contact.lowest_gap_mm;
    const double by_distance = lowest - field.error_mm() - options_.within_mm;
    set_far(pair, field, shape, std::max(by_field, by_distance));
    return;
  }
  contacts_[pair] = contact;
}

}  // namespace carpus::contact
