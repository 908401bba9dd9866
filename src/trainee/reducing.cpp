// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "trainee/reducing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "fields/distance_field.hpp"

namespace carpus::trainee {
namespace {

using simulation::CommandKind;
using simulation::Driver;
using simulation::HandInput;
using simulation::Input;
using simulation::ItemView;
using simulation::Snapshot;

constexpr std::uint8_t kHand = 1;
constexpr double kFarMm = 60.0;        // outside the skin, whatever hand it is
constexpr double kInMm = 4.0;          // that deep a joystick holds a fragment
constexpr double kBesideAxisMm = 2.7;  // of it from the way of the screw and its wire
constexpr double kPastMiddleMm = 3.6;  // a wire that misses the middle misses the screw
constexpr double kBesideBonesMm = 3.0;
/// Of its axis from a tendon, artery or nerve: its own radius, and room to lead it.
constexpr double kBesideStructuresMm = 2.5;
constexpr double kOffFaceMm = 3.0;  // it goes in no nearer to the fracture
constexpr double kApartMm = 0.8;  // led off that far before it is led across: more than the relief
constexpr double kTogetherMm = 0.2;
constexpr double kSlackMm = 1.0;  // by which the wire lags behind the hand
constexpr double kSlackRad = 0.03;
constexpr Tick kComeTicks = 1500;
constexpr Tick kDriveTicks = 15000;
constexpr Tick kTakenTicks = 50;   // until a hand has what it reached for
constexpr Tick kLeadTicks = 4000;  // of each part of the way

ItemView item_of(const Snapshot& now) {
  const std::uint8_t item = now.hands[kHand].item;
  return item < simulation::kMaxItems ? now.items[item] : ItemView{};
}

Vec3 in_patient(const Snapshot& now, std::size_t body, const Vec3& p) {
  return (now.patient_from_bone[body] * Point<frame::Bone>{p}).v;
}

Vec3 turned(const Snapshot& now, std::size_t body, const Vec3& d) {
  return (now.patient_from_bone[body] * Direction<frame::Bone>{d}).v;
}

/// Turned as `from` is to become `to`, unit vectors that do not oppose each other (Rodrigues).
Vec3 turned_as(const Vec3& from, const Vec3& to, const Vec3& v) {
  const Vec3 axis = cross(from, to);
  const double cosine = dot(from, to);
  return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1.0 + cosine));
}

std::vector<Vec3> vertex_normals(const MeshIn<frame::Bone>& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const auto& facet : mesh.facets) {
    const Vec3& a = mesh.vertices[facet[0]];
    const Vec3 doubled = cross(mesh.vertices[facet[1]] - a, mesh.vertices[facet[2]] - a);
    for (const auto v : facet) normals[v] += doubled;
  }
  for (Vec3& n : normals) n = normalized_or(n, {0, 0, 1});
  return normals;
}

double distance_from_line(const Vec3& p, const Vec3& a, const Vec3& b) {
  return length(cross(p - a, normalized_or(b - a, {0, 0, 1})));
}

}  // namespace

Reducing::Reducing(const cases::CaseData& data, const procedure::Procedure& procedure)
    : case_(data) {
  for (const auto index : procedure.tray) {
    if (instruments::catalogue()[index].is_joystick) joystick_ = index;
  }
  const auto body_of = [&](BonePart part) -> std::optional<std::size_t> {
    for (std::size_t b = 0; b < data.bones.size(); ++b) {
      if (data.bones[b].bone == procedure.target && data.bones[b].part == part) return b;
    }
    return std::nullopt;
  };
  const auto proximal = body_of(BonePart::Proximal);
  const auto distal = body_of(BonePart::Distal);
  if (joystick_ == instruments::kNoInstrument || !proximal || !distal) return;
  first_ = *proximal;
  second_ = *distal;
  faces_ = anatomy::reduction_of(data.bones[first_].surface, data.bones[second_].surface);
  if (faces_) plan_axis();
}

/// Where the screw will run once the faces meet. The case knows it of a displaced bone; of one that
/// it calls aligned the axis is the scanned one.
void Reducing::plan_axis() {
  const auto& reduced = case_.reduced;
  first_from_second_ =
      reduced ? reduced->proximal_from_distal : faces_->first_from_second_reduced();
  const auto& axis = reduced ? reduced->marks.central_axis : case_.scaphoid.central_axis;
  first_axis_ = {axis.proximal, axis.distal};
  const auto back = first_from_second_.inverse();
  second_axis_ = {(back * Point<frame::Bone>{first_axis_.start}).v,
                  (back * Point<frame::Bone>{first_axis_.end}).v};
}

std::optional<anatomy::FractureOffset> Reducing::offset(const Snapshot& now) const {
  if (!faces_) return std::nullopt;
  return faces_->offset(now.patient_from_bone[first_].inverse() * now.patient_from_bone[second_]);
}

Reducing::Face Reducing::face_of(const Snapshot& now, bool of_first) const {
  const std::size_t body = of_first ? first_ : second_;
  return {in_patient(now, body, of_first ? faces_->first_middle : faces_->second_middle),
          turned(now, body, of_first ? faces_->first_normal : faces_->second_normal)};
}

void Reducing::begin(const Snapshot& now, const HandPose& hand, const Vec3& error) {
  hand_ = hand;
  error_ = error;
  lean_n_ = 0.0;
  depth_mm_ = 0.0;
  const auto way = faces_ ? find_way(now) : std::nullopt;
  if (way) way_ = *way;
  enter(way ? Stage::Take : Stage::Over);
}

void Reducing::begin_taking_out() { enter(Stage::PickUp); }

void Reducing::enter(Stage stage) {
  stage_ = stage;
  in_stage_ = 0;
}

/// Whether no tendon, artery or nerve lies about the wire's way in from outside.
bool Reducing::is_beside_structures(const std::vector<LyingPoint>& structures, const Way& way) {
  for (const LyingPoint& point : structures) {
    const Vec3 w = point.at - way.entry;
    const double out = std::clamp(-dot(w, way.inward), 0.0, kFarMm);
    if (length(w + way.inward * out) < point.radius_mm + kBesideStructuresMm) return false;
  }
  return true;
}

/// Where a fragment lies once it meets the other.
Pose<frame::Patient, frame::Bone> Reducing::led(const Snapshot& now, std::size_t body) const {
  return body == second_ ? now.patient_from_bone[first_] * first_from_second_
                         : now.patient_from_bone[second_] * first_from_second_.inverse();
}

/// Where the wire is once its fragment lies on the other.
Reducing::Way Reducing::led(const Snapshot& now, const Way& way) const {
  const auto there = led(now, way.body) * now.patient_from_bone[way.body].inverse();
  return {way.body, (there * Point<frame::Patient>{way.entry}).v,
          (there * Direction<frame::Patient>{way.inward}).v};
}

/// From a fragment, led to the other, to the nearest other bone [mm]; less than 0 where it would
/// lie in one.
double Reducing::room_of(const Snapshot& now, std::size_t body) const {
  constexpr std::size_t kTries = 400;
  const auto& vertices = case_.bones[body].surface.vertices;
  const std::size_t every = std::max<std::size_t>(1, vertices.size() / kTries);
  const auto there = led(now, body);
  double room = kFarMm;
  for (std::size_t b = 0; b < case_.bones.size(); ++b) {
    if (b == first_ || b == second_) continue;
    const auto bone_from_fragment = now.patient_from_bone[b].inverse() * there;
    for (std::size_t v = 0; v < vertices.size(); v += every) {
      const Vec3 p = (bone_from_fragment * Point<frame::Bone>{vertices[v]}).v;
      const auto seen = fields::sample_distance(case_.bones[b].distance_field, p);
      if (seen.is_inside_grid) room = std::min(room, static_cast<double>(seen.distance_mm));
    }
  }
  return room;
}

/// Whether no other bone lies about the wire's way in from outside.
bool Reducing::is_way_free(const Snapshot& now, const Way& way) const {
  for (std::size_t b = 0; b < case_.bones.size(); ++b) {
    if (b == way.body) continue;
    for (const Vec3& vertex : case_.bones[b].hull.vertices) {
      const Vec3 w = in_patient(now, b, vertex) - way.entry;
      const double out = -dot(w, way.inward);
      if (out > -1.0 && out < kFarMm && length(w + way.inward * out) < kBesideBonesMm) return false;
    }
    for (double out = 1.0; out < kFarMm; out += 1.0) {
      const Vec3 p = way.entry - way.inward * out;
      const Vec3 local = (now.patient_from_bone[b].inverse() * Point<frame::Patient>{p}).v;
      const auto seen = fields::sample_distance(case_.bones[b].distance_field, local);
      if (seen.is_inside_grid && seen.distance_mm < kBesideBonesMm) return false;
    }
  }
  return true;
}

/// Into the fragment that has more room where it is to be led, else into the other: towards its
/// middle or past it, off the fracture and beside the screw's way; of those that are free the one
/// that meets the bone most squarely.
std::optional<Reducing::Way> Reducing::find_way(const Snapshot& now) const {
  constexpr std::size_t kTries = 1600;
  const std::vector<LyingPoint> structures = structures_now(case_, now);
  std::optional<Way> best;
  double best_worth = 0.75;  // less square than that it skates
  const bool is_first_freer = room_of(now, first_) > room_of(now, second_);
  for (const bool of_first : {is_first_freer, !is_first_freer}) {
    if (best) break;
    const std::size_t body = of_first ? first_ : second_;
    const MeshIn<frame::Bone>& mesh = case_.bones[body].surface;
    const std::vector<Vec3> normals = vertex_normals(mesh);
    Vec3 centre;
    for (const Vec3& v : mesh.vertices) centre += v;
    centre *= 1.0 / static_cast<double>(mesh.vertices.size());
    const BoneLine& axis = of_first ? first_axis_ : second_axis_;
    const Vec3& middle = of_first ? faces_->first_middle : faces_->second_middle;
    const Vec3& normal = of_first ? faces_->first_normal : faces_->second_normal;
    const std::size_t every = std::max<std::size_t>(1, mesh.vertices.size() / kTries);
    const Vec3 along = normalized_or(axis.end - axis.start, {0, 0, 1});
    for (std::size_t v = 0; v < mesh.vertices.size(); v += every) {
      const Vec3& p = mesh.vertices[v];
      const Vec3 beside = normalized_or(cross(along, p - centre), {}) * kPastMiddleMm;
      const Vec3 aside = along * kPastMiddleMm;
      for (const Vec3& aim :
           {centre, centre + beside, centre - beside, centre + aside, centre - aside}) {
        const Vec3 inward = normalized_or(aim - p, normals[v]);
        const double square = -dot(inward, normals[v]);
        const Vec3 tip = p + inward * kInMm;
        if (square <= best_worth || dot(middle - p, normal) < kOffFaceMm ||
            dot(middle - tip, normal) < kOffFaceMm / 2 ||
            distance_from_line(p, axis.start, axis.end) < kBesideAxisMm ||
            distance_from_line(tip, axis.start, axis.end) < kBesideAxisMm) {
          continue;
        }
        const Way way{body, in_patient(now, body, p), turned(now, body, inward)};
        if (!is_beside_structures(structures, way) ||
            !is_beside_structures(structures, led(now, way)) || !is_way_free(now, way)) {
          continue;
        }
        best = way;
        best_worth = square;
      }
    }
  }
  return best;
}

void Reducing::drive(const Snapshot& now, Input& input) {
  constexpr double kThrustN = 30.0;
  constexpr double kMostN = 55.0;
  constexpr Tick kPatience = 200;
  const ItemView item = item_of(now);
  HandInput& hand = input.hands[kHand];
  hand.driver = Driver::Forward;
  if (in_stage_ % kPatience == 0) {
    const bool has_moved = item.depth_mm > depth_mm_ + 0.05;
    lean_n_ = std::clamp(lean_n_ + (has_moved ? -4.0 : 4.0), 0.0, kMostN - kThrustN);
    depth_mm_ = item.depth_mm;
  }
  hand.thrust_n = kThrustN + lean_n_;
  if (item.body != simulation::kNoBody && item.depth_mm >= kInMm) {
    enter(Stage::Apart);
  } else if (in_stage_ > kDriveTicks) {
    enter(Stage::LetGo);
  }
}

/// The hand goes where the fragment has to, and as much farther as the wire lags behind.
void Reducing::lead(const Snapshot& now, Input& input) {
  constexpr double kNearMm = 0.05;
  const ItemView item = item_of(now);
  const bool leads_first = way_.body == first_;
  const Face moving = face_of(now, leads_first);
  const Face other = face_of(now, !leads_first);
  const double gap = dot(moving.middle - other.middle, other.normal);
  Vec3 middle =
      other.middle + error_ + other.normal * (stage_ == Stage::Across ? kApartMm : kTogetherMm);
  Vec3 normal = -other.normal;
  if (stage_ == Stage::Apart) {
    middle = moving.middle + other.normal * std::max(0.0, kApartMm - gap);
    normal = moving.normal;
  }
  HandInput& hand = input.hands[kHand];
  const Vec3 tip = middle + turned_as(moving.normal, normal, item.tip_in_patient - moving.middle);
  const Vec3 shaft = turned_as(moving.normal, normal, item.shaft_in_patient);
  const Vec3 way = tip - item.tip_in_patient;
  const Vec3 turn = shaft - item.shaft_in_patient;
  hand.tip_in_patient = tip + normalized_or(way, {}) * kSlackMm;
  hand.shaft_in_patient = normalized_or(shaft + normalized_or(turn, {}) * kSlackRad, shaft);
  const bool is_there = length(way) < kNearMm && length(turn) < kSlackRad;
  if (!is_there && in_stage_ < kLeadTicks) return;
  enter(stage_ == Stage::Apart    ? Stage::Across
        : stage_ == Stage::Across ? Stage::Together
                                  : Stage::LetGo);
}

bool Reducing::next(const Snapshot& now, Input& input) {
  ++in_stage_;
  HandInput& hand = input.hands[kHand];
  const ItemView item = item_of(now);
  const bool is_fixed = item.body != simulation::kNoBody;
  hand.driver = Driver::Off;
  hand.thrust_n = 0.0;
  // Drawn out, the hand is where its wire came out, not where it went in before the piece was led.
  if (is_fixed) hand_ = {item.tip_in_patient, item.shaft_in_patient};
  hand.tip_in_patient = is_fixed ? item.tip_in_patient : hand_.tip;
  hand.shaft_in_patient = is_fixed ? item.shaft_in_patient : hand_.shaft;
  switch (stage_) {
    case Stage::Take:
      input.command = {CommandKind::Take, kHand, joystick_, 0, 0};
      move_ = MinimumJerkMove(hand_, {way_.entry - way_.inward * kFarMm, -way_.inward}, kComeTicks);
      enter(Stage::Come);
      break;
    case Stage::Come:
      hand_ = move_.at(in_stage_);
      if (!move_.is_over(in_stage_)) break;
      move_ = MinimumJerkMove(hand_, {way_.entry + way_.inward, -way_.inward}, kComeTicks);
      enter(Stage::Approach);
      break;
    case Stage::Approach:
      hand_ = move_.at(in_stage_);
      if (move_.is_over(in_stage_)) enter(Stage::Drive);
      break;
    case Stage::Drive:
      drive(now, input);
      break;
    case Stage::Apart:
    case Stage::Across:
    case Stage::Together:
      if (!is_fixed) {
        enter(Stage::LetGo);
        break;
      }
      lead(now, input);
      break;
    case Stage::LetGo:
      left_ = is_fixed ? now.hands[kHand].item : simulation::kNoItem;
      input.command = {CommandKind::PutDown, kHand, 0, 0, 0};
      enter(Stage::Over);
      break;
    case Stage::PickUp:
      input.command = {CommandKind::PickUp, kHand, left_, 0, 0};
      left_ = simulation::kNoItem;
      enter(Stage::DrawOut);
      break;
    case Stage::DrawOut:
      hand.driver = Driver::Reverse;
      // The first tick shows the hand as it was before.
      if (is_fixed && in_stage_ < kDriveTicks) break;
      if (!is_fixed && in_stage_ < kTakenTicks) break;
      enter(Stage::LetGo);
      break;
    case Stage::Over:
      return true;
  }
  return false;
}

}  // namespace carpus::trainee
