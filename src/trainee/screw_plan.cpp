// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a scripted arthroscopist controls a screw: the trailing end from the radiocarpal joint, the
// other places from the midcarpal one, each looked at and felt; then what was found, and from that
// and the operation's report what is to be done.
#include "arthroscopy/screw_table.hpp"
#include "trainee/arthroscopist.hpp"

namespace carpus::trainee {
namespace {

constexpr std::uint8_t kScope = 0;  // hands
constexpr std::uint8_t kProbe = 1;
constexpr std::uint8_t kRadiocarpal = 0;
constexpr double kInsideMm = 2.0;
constexpr double kFeltMm = 3.5;   // of a place, where it is felt
constexpr double kAboveMm = 0.2;  // a place, the probe's tip on its way

}  // namespace

void ScriptedArthroscopist::plan_screw_control() {
  if (lesions_ == nullptr || !lesions_->screw) return;
  control_in(kRadiocarpal);
  for (std::uint8_t joint = 1; joint < map_.joints.size(); ++joint) control_in(joint);
}

/// Of a place and what lies about it on the wall the nearest that a probe comes to.
std::optional<Vec3> ScriptedArthroscopist::felt_by(std::uint8_t work, const Vec3& at) const {
  const std::uint8_t joint = map_.portals[work].joint;
  const double radius = instruments::catalogue()[procedure_.tray.back()].shape.greatest_radius_mm();
  const Vec3 in = -space_at(joint, at).outwards;
  const Vec3 a = any_perpendicular(in);
  const Vec3 b = cross(in, a);
  for (const double aside : {0.0, 0.8, 1.6, 2.4, 3.2}) {
    for (double turn = 0; turn < (aside > 0 ? 360 : 1); turn += 45) {
      const auto way = arthroscopy::cos_sin_deg(turn);
      Vec3 place = at + (a * way[0] + b * way[1]) * aside;
      const arthroscopy::OpenedSpace wall = space_at(joint, place);
      if (!wall.is_near) continue;
      place -= wall.outwards * wall.distance_mm;
      const Vec3 above = place - wall.outwards * (radius + kAboveMm);
      if (distance(place, at) > kFeltMm || !goes_in(above, work, radius)) continue;
      if (is_free(joint, in_portal(work, kInsideMm), above)) return place;
    }
  }
  return std::nullopt;
}

/// The pair of portals by which a place is seen, and felt where that can be.
ScriptedArthroscopist::Stop ScriptedArthroscopist::stop_for(std::uint8_t joint,
                                                            const Vec3& at) const {
  Stop stop;
  stop.look = stop.work = procedure::kNoBody;
  for (std::uint8_t look = 0; look < map_.portals.size(); ++look) {
    if (map_.portals[look].joint != joint || !map_.portals[look].is_usual) continue;
    if (!view_of(look, at, in_portal(look, kInsideMm)).is_found) continue;
    if (stop.look == procedure::kNoBody) stop.look = look;
    for (std::uint8_t work = 0; work < map_.portals.size(); ++work) {
      const cases::Portal& portal = map_.portals[work];
      if (work == look || portal.joint != joint || !portal.is_usual) continue;
      if (!felt_by(work, at)) continue;
      stop.look = look;
      stop.work = work;
      return stop;
    }
  }
  return stop;
}

/// How high metal stands is seen from aside; what hides a place from one portal does not from
/// another.
void ScriptedArthroscopist::look_from_elsewhere(const Stop& stop, const Vec3& at) {
  for (std::uint8_t other = 0; other < map_.portals.size(); ++other) {
    const cases::Portal& portal = map_.portals[other];
    const bool is_other =
        other != stop.look && portal.is_usual && portal.joint == map_.portals[stop.look].joint;
    if (!is_other || !view_of(other, at, in_portal(other, kInsideMm)).is_found) continue;
    if (in_[kProbe] == other) draw_out(kProbe);
    enter(kScope, other);
    Stop aside = stop;
    aside.look = other;
    return look_at(aside, at);
  }
}

void ScriptedArthroscopist::control_in(std::uint8_t joint) {
  for (const cases::Lesion& site : lesions_->lesions) {
    if (site.joint != joint) continue;
    const Vec3 at = (poses_[site.body] * Point<frame::Bone>{site.from}).v;
    const bool looks = rng_.uniform(0.0, 1.0) < skill_.searches;
    const bool feels = rng_.uniform(0.0, 1.0) < skill_.recognises;
    const Stop stop = stop_for(joint, at);
    if (!looks || stop.look == procedure::kNoBody) continue;
    // The probe leaves a portal that the scope needs.
    if (in_[kProbe] != procedure::kNoBody && in_[kProbe] != stop.work) draw_out(kProbe);
    enter(kScope, stop.look);
    look_at(stop, at);
    if (skill_.looks_again > rng_.uniform(0.0, 1.0)) look_from_elsewhere(stop, at);
    if (!feels || stop.work == procedure::kNoBody) continue;
    enter(kScope, stop.look);
    if (!has_probe_) take_probe(stop.work);
    has_probe_ = true;
    enter(kProbe, stop.work);
    const Vec3 felt = *felt_by(stop.work, at);
    const View view = view_of(stop.look, felt, planned_[kScope]);
    if (view.is_found) look(stop.look, view);
    probe(stop, felt);
  }
}

/// A site that was not in view is taken for well.
std::uint8_t ScriptedArthroscopist::judged_of_screw(std::size_t asked, std::uint32_t lesions_seen) {
  const double chance = rng_.uniform(0.0, 1.0);
  const double exact = rng_.uniform(0.0, 1.0);
  if (rng_.uniform(0.0, 1.0) < skill_.says_nothing) return simulation::kNoGrade;
  if (lesions_ == nullptr) return 0;
  const auto grades = asked_->scale_of(asked).grades.size();
  const auto other = static_cast<std::uint8_t>(rng_.below(grades));
  if (asked == arthroscopy::kScrewDecision) return exact < skill_.grades_right ? decided() : other;
  if ((lesions_seen >> asked & 1U) == 0) return 0;
  const std::uint8_t truth = lesions_->grades[asked];
  if (truth != 0 && chance >= skill_.recognises) return 0;
  if (truth == 0 && chance < skill_.invents) return other;
  // Buried and flush are told apart less surely than what stands out.
  const bool is_plain =
      asked != 0 || truth == static_cast<std::uint8_t>(arthroscopy::EndGrade::Proud);
  return is_plain || exact < skill_.grades_right ? truth : static_cast<std::uint8_t>(1 - truth);
}

/// From what was said of the sites and how long screw and way are.
std::uint8_t ScriptedArthroscopist::decided() const {
  using arthroscopy::DecisionGrade;
  const cases::ControlledScrew& screw = *lesions_->screw;
  DecisionGrade decision = DecisionGrade::Leave;
  for (std::size_t site = 0; site < cases::kScrewSites; ++site) {
    if (!arthroscopy::says_proud(site, said_[site])) continue;
    const double spare_mm = screw.line_mm - screw.length_mm;
    const bool has_room = site == 0 && decision != DecisionGrade::Exchange &&
                          spare_mm >= arthroscopy::ScrewTable::generic().cover_mm;
    decision = has_room ? DecisionGrade::Deeper : DecisionGrade::Exchange;
  }
  return static_cast<std::uint8_t>(decision);
}

}  // namespace carpus::trainee
