// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/scope_message.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "arthroscopy/disc_net.hpp"
#include "arthroscopy/fluid_table.hpp"
#include "arthroscopy/opened_space.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "session/body_names.hpp"
#include "session/descriptions.hpp"
#include "simulation/asked_portals.hpp"
#include "simulation/lesions_of.hpp"
#include "simulation/questions.hpp"

namespace carpus::session {
namespace {

constexpr int kNumbers = 32;
constexpr double kLineStepMm = 1.0;
constexpr double kMostOfLine = 60;  // points

std::vector<std::int64_t> numbers_in(std::uint32_t bits) {
  std::vector<std::int64_t> numbers;
  for (int i = 0; i < kNumbers; ++i) {
    if ((bits >> i & 1U) != 0) numbers.push_back(i);
  }
  return numbers;
}

void add_lesions(protocol::Arthroscopy& message,
                 const cases::JointLesions& wrong,
                 const cases::ArthroscopicMap& map,
                 const BodyNames& names) {
  for (const cases::Lesion& lesion : wrong.lesions) {
    if (lesion.look == cases::LesionLook::ScrewSite) continue;
    message.lesions.push_back({static_cast<protocol::LesionLook>(lesion.look),
                               map.joints[lesion.joint].id, names.name(lesion.body), lesion.from,
                               lesion.to, lesion.radius_mm});
  }
}

/// As they were scanned, whatever is wrong with them.
void add_sheets(protocol::Arthroscopy& message,
                const cases::ArthroscopicMap& map,
                const BodyNames& names) {
  const yielding::Net disc = arthroscopy::disc_net(map, nullptr);
  message.sheets.push_back({"disc", map.joints.front().id, names.name(map.forearm),
                            protocol::SheetKind::Disc, disc.scanned()});
  for (const cases::LigamentBand& band : map.bands) {
    message.sheets.push_back({band.id, map.joints[band.joint].id, names.name(band.first),
                              protocol::SheetKind::Ligament, band.at});
  }
}

/// What is loose of the disc is to be seen, what of it is rim is not.
void add_pieces(protocol::Arthroscopy& message,
                const cases::JointLesions& wrong,
                const cases::ArthroscopicMap& map,
                const BodyNames& names) {
  for (const cases::TissuePiece& piece : wrong.pieces) {
    const bool is_loose = piece.kind == cases::TissueKind::Disc && piece.is_ill;
    message.pieces.push_back({static_cast<protocol::TissueKind>(piece.kind),
                              map.joints[piece.joint].id, names.name(piece.body), piece.at,
                              piece.inwards, piece.height_mm, piece.radius_mm, is_loose});
  }
}

/// Its thread and bore are those of the catalogue's screw of that length.
protocol::ControlledScrew screw_message(const cases::ControlledScrew& screw,
                                        const BodyNames& names) {
  protocol::ControlledScrew message;
  message.body = names.name(screw.body);
  message.tail_mm = screw.tail;
  message.tip_mm = screw.tip;
  message.tail_radius_mm = screw.tail_radius_mm;
  message.tip_radius_mm = screw.tip_radius_mm;
  message.length_mm = screw.length_mm;
  message.line_mm = screw.line_mm;
  for (const instruments::Instrument& each : instruments::catalogue()) {
    const bool is_it = !each.family.empty() && each.length_mm == screw.length_mm &&
                       each.tail_diameter_mm == 2 * screw.tail_radius_mm;
    if (!is_it || each.rods.empty()) continue;
    message.bore_radius_mm = each.rods.front().bore_radius_mm;
    message.thread_depth_mm = each.rods.front().thread_depth_mm;
    message.thread_pitch_mm = each.rods.front().thread_pitch_mm;
  }
  return message;
}

/// To hundredths of a millimetre: what lies still is told once.
Vec3 rounded(const Vec3& at) {
  constexpr double kSteps = 100.0;
  return {std::round(at.x * kSteps) / kSteps, std::round(at.y * kSteps) / kSteps,
          std::round(at.z * kSteps) / kSteps};
}

/// Points of the line, on the joint's wall as scanned.
std::vector<Vec3> line_on_surface(const cases::ArthroscopicMap& map,
                                  const std::vector<const cases::TourPoint*>& places) {
  std::vector<Vec3> line;
  double whole = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    whole += distance(places[i - 1]->at, places[i]->at);
  }
  const double step = std::max(kLineStepMm, whole / kMostOfLine);
  const Grid<float>& wall = map.joints[places.front()->joint].wall;
  const Pose<frame::Bone, frame::Patient> scanned;
  double left = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const Vec3 from = places[i - 1]->at;
    const double far = distance(from, places[i]->at);
    double s = left;
    for (; s <= far; s += step) {
      const Vec3 at = from + (places[i]->at - from) * (s / far);
      const auto space = arthroscopy::opened_space_at(wall, scanned, scanned, at);
      line.push_back(space.is_near ? at - space.outwards * space.distance_mm : at);
    }
    left = s - far;
  }
  return line;
}

protocol::ScopeDrill drill_of(const cases::ArthroscopicMap& map,
                              const procedure::ScopeDrill& drill,
                              const BodyNames& names) {
  protocol::ScopeDrill message;
  message.hold.assign(drill.hold.begin(), drill.hold.end());
  message.hold_s = drill.hold_s;
  message.middle_deg = drill.middle_deg;
  message.round_places = static_cast<std::int64_t>(drill.round_places);
  message.touch.assign(drill.touch.begin(), drill.touch.end());
  std::vector<const cases::TourPoint*> places;
  for (const std::uint8_t number : drill.line) {
    for (const cases::TourPoint& point : map.points) {
      if (point.number == number) places.push_back(&point);
    }
  }
  if (places.empty()) return message;
  message.line_mm = line_on_surface(map, places);
  message.line_body = names.name(places.front()->body);
  return message;
}

void add_shaving(protocol::Scope& message, const simulation::ScopeView& scope) {
  if (scope.piece_count == 0) return;
  message.pieces_left.assign(scope.pieces_left.begin(),
                             scope.pieces_left.begin() + scope.piece_count);
  for (const double deg : scope.mouth_deg) message.mouth_deg.push_back(std::llround(deg));
  for (const bool runs : scope.are_running) message.running.push_back(runs ? 1 : 0);
}

/// What is wrong with the picture an assessed hand is to see by itself.
protocol::DrillState drill_state_of(const simulation::Snapshot& now,
                                    const procedure::ScopeDrill& drill) {
  const simulation::ScopeView& scope = now.scope;
  const bool helps = now.mode == procedure::Mode::Practice;
  const procedure::DrillFacts& done = scope.facts.drill;
  protocol::DrillState message;
  message.held = done.held;
  message.hold_share = std::min(1.0, scope.hold_ticks * kTickSeconds / drill.hold_s);
  message.level = !helps || scope.is_level;
  message.round_most = done.round_most;
  message.round_done = done.is_round_done;
  message.touched = done.touched;
  message.line_share = scope.line_share;
  message.line_done = done.is_line_done;
  message.probe_seen = !helps || scope.is_probe_seen;
  return message;
}

/// As finely as it can be told apart: what stands still is told once.
protocol::JointFluid fluid_of(const simulation::FluidView& fluid) {
  const auto to = [](double value, double steps) { return std::round(value * steps) / steps; };
  constexpr double kPressure = 1;
  constexpr double kHaze = 1000;
  constexpr double kShare = 50;
  const arthroscopy::FluidSource& source = arthroscopy::FluidTable::generic().source;
  return {fluid.inflow_steps * source.step_mmhg,
          source.step_mmhg,
          source.most_inflow_mmhg,
          fluid.is_outflow_open,
          fluid.is_dry,
          fluid.is_flushing,
          to(fluid.pressure_mmhg, kPressure),
          to(fluid.haze_per_mm, kHaze),
          to(fluid.bubbles, kShare),
          to(fluid.fog_depth, kShare),
          to(fluid.smear_depth, kShare)};
}

/// By the procedure's portals, bit by bit: of those that are to be made where they should lead.
std::uint32_t joints_led_to(const cases::CaseData& data,
                            const procedure::Procedure& procedure,
                            std::uint64_t seed) {
  constexpr std::uint32_t kAll = ~0U;
  if (!procedure.making) return kAll;
  const auto asked = simulation::asked_portals(data, *procedure.making, seed);
  std::uint32_t joints = 0;
  if (!asked) return kAll;
  for (const std::uint8_t portal : *asked) {
    joints |= 1U << data.arthroscopy->portals[portal].joint;
  }
  return joints;
}

}  // namespace

std::optional<protocol::Arthroscopy> arthroscopy_of(
    const cases::CaseData& data,
    const procedure::Procedure& procedure,
    std::uint64_t seed,
    const std::optional<cases::PreparedPathology>& prepared) {
  if (data.arthroscopy == nullptr) return std::nullopt;
  const auto all = instruments::catalogue();
  protocol::Arthroscopy message;
  for (const instruments::InstrumentIndex index : procedure.tray) {
    if (!all[index].optic) continue;
    message.scope = all[index].id;
    message.view_angle_deg = all[index].optic->view_angle_deg;
    message.field_deg = all[index].optic->field_deg;
    break;
  }
  if (message.scope.empty()) return std::nullopt;
  message.distal = data.arthroscopy->distal;
  const BodyNames names(data);
  for (const cases::Portal& portal : data.arthroscopy->portals) {
    if (procedure.making) break;  // where those lie that are to be made is nothing to be told
    message.portals.push_back({portal.id, portal.name, data.arthroscopy->joints[portal.joint].id,
                               portal.landmarks, portal.skin, portal.inwards, portal.capsule_mm,
                               names.name(portal.body)});
  }
  const std::uint32_t joints = joints_led_to(data, procedure, seed);
  for (const cases::TourPoint& point : data.arthroscopy->points) {
    if ((joints >> point.joint & 1U) == 0) continue;
    message.points.push_back({point.number, point.name, point.found_by,
                              data.arthroscopy->joints[point.joint].id, point.is_probed, point.at,
                              names.name(point.body)});
  }
  const std::optional<cases::JointLesions> wrong =
      simulation::lesions_of(data, procedure, seed, prepared);
  if (wrong) {
    add_lesions(message, *wrong, *data.arthroscopy, names);
    add_pieces(message, *wrong, *data.arthroscopy, names);
  }
  if (const auto* asked = simulation::questions_of(procedure)) {
    message.findings = findings_of(*asked);
  }
  if (wrong && wrong->screw) message.screw = screw_message(*wrong->screw, names);
  if (procedure.drill) message.drill = drill_of(*data.arthroscopy, *procedure.drill, names);
  add_sheets(message, *data.arthroscopy, names);
  return message;
}

std::optional<protocol::Scope> scope_message(const cases::CaseData& data,
                                             const procedure::Procedure& procedure,
                                             const simulation::Snapshot& now) {
  const simulation::ScopeView& scope = now.scope;
  if (data.arthroscopy == nullptr || scope.hand >= simulation::kHands) return std::nullopt;
  protocol::Scope message;
  message.hand = scope.hand;
  message.shaft_deg = scope.shaft_turn_deg;
  message.camera_deg = scope.camera_turn_deg;
  message.axis = scope.axis_in_patient;
  message.up = scope.up_in_patient;
  const std::vector<cases::Portal>& portals = data.arthroscopy->portals;
  for (std::size_t h = 0; h < simulation::kHands; ++h) {
    const std::size_t portal = scope.facts.portal[h];
    message.portals.push_back(portal < portals.size() ? portals[portal].id : std::string());
    message.in_joint.push_back(scope.facts.is_in_joint[h] ? 1 : 0);
  }
  message.points_seen = numbers_in(scope.facts.points_seen);
  message.points_probed = numbers_in(scope.facts.points_probed);
  if (now.mode == procedure::Mode::Practice) {
    message.points_in_view = numbers_in(scope.points_in_view);
  }
  message.pull_outs = scope.pull_outs;
  if (procedure.drill) message.drill = drill_state_of(now, *procedure.drill);
  for (const bool is_closed : scope.are_closed) message.jaws_closed.push_back(is_closed ? 1 : 0);
  for (std::size_t i = 0; i < scope.loose_count; ++i) {
    const simulation::LooseView& body = scope.loose[i];
    message.loose.push_back({body.lesion, body.hand < simulation::kHands ? body.hand : -1,
                             rounded(body.at_in_patient)});
  }
  message.loose_out = scope.facts.loose.out;
  for (std::size_t i = 0; i < scope.scuff_count; ++i) {
    const simulation::ScuffView& scuff = scope.scuffs[i];
    message.scuffs.push_back(
        {data.arthroscopy->joints[scuff.joint].id, rounded(scuff.at_as_scanned)});
  }
  add_shaving(message, scope);
  if (scope.fluid.is_there) message.fluid = fluid_of(scope.fluid);
  for (const std::uint8_t grade : scope.answers) {
    message.answers.push_back(grade == cases::kNotJudged ? -1 : grade);
  }
  return message;
}

protocol::Sheet sheet_message(const simulation::Snapshot& now, std::size_t sheet) {
  const simulation::SheetView& view = now.sheets[sheet];
  protocol::Sheet message;
  message.sheet = static_cast<std::int64_t>(sheet);
  constexpr double kUmPerMm = 1000.0;
  bool is_off = false;
  for (std::size_t i = 0; i < view.count; ++i) {
    for (const float off : view.off[i]) {
      message.off_um.push_back(std::llround(static_cast<double>(off) * kUmPerMm));
      is_off = is_off || message.off_um.back() != 0;
    }
  }
  if (!is_off) message.off_um.clear();
  return message;
}

}  // namespace carpus::session
