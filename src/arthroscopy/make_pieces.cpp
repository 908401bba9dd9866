// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "arthroscopy/make_pieces.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "arthroscopy/disc_net.hpp"
#include "arthroscopy/make_lesions.hpp"
#include "arthroscopy/pathology_table.hpp"
#include "core/rng.hpp"
#include "fields/distance_field.hpp"

namespace carpus::arthroscopy {
namespace {

using cases::TissueKind;
using cases::TissuePiece;

constexpr std::uint64_t kSynoviumStream = 0x54F;  // apart from other draws of the same seed
constexpr std::uint64_t kTearStream = 0x7EA;
// A patch of villi, [E] throughout.
constexpr double kPatchMm = 2.4;
constexpr double kApartMm = 0.55;
constexpr std::array<double, 2> kHighMm{0.7, 1.5};
constexpr std::array<double, 2> kThickMm{0.3, 0.5};
constexpr double kSameSideCosine = 0.3;
constexpr int kTriesATuft = 30;

struct OnWall {
  Vec3 at;
  Vec3 inwards;
  bool is_there = false;
};

OnWall on_wall(const Grid<float>& wall, Vec3 at) {
  OnWall found;
  for (int i = 0; i < 4; ++i) {
    const fields::DistanceSample near = fields::sample_distance(wall, at);
    const Vec3 outwards = normalized_or(near.gradient, {});
    if (!near.is_inside_grid || !(squared_length(outwards) > 0.5)) return {};
    at -= outwards * near.distance_mm;
    found = {at, -outwards, true};
  }
  return found;
}

double to_line(const Vec3& at, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double whole = squared_length(along);
  const double share = whole > 0 ? std::clamp(dot(at - from, along) / whole, 0.0, 1.0) : 0.0;
  return distance(at, from + along * share);
}

/// Stands tuft by tuft about a place, all of them on its side of the joint.
void add_patch(cases::JointLesions& made,
               const cases::ArthroscopicMap& map,
               const cases::TourPoint& place,
               std::uint8_t patch,
               std::uint64_t tufts,
               Rng& rng) {
  const Grid<float>& wall = map.joints[place.joint].wall;
  const OnWall middle = on_wall(wall, place.at);
  const std::size_t first = made.pieces.size();
  for (std::uint64_t i = 0; i < tufts * kTriesATuft; ++i) {
    const Vec3 aside{rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)};
    TissuePiece tuft;
    tuft.height_mm = rng.uniform(kHighMm[0], kHighMm[1]);
    tuft.radius_mm = rng.uniform(kThickMm[0], kThickMm[1]);
    const bool is_full = made.pieces.size() - first >= tufts;
    if (!middle.is_there || is_full || made.pieces.size() >= cases::kMaxPieces) return;
    const OnWall stands = on_wall(wall, place.at + aside * kPatchMm);
    const bool is_here = stands.is_there && distance(stands.at, middle.at) <= kPatchMm &&
                         dot(stands.inwards, middle.inwards) >= kSameSideCosine;
    const auto from = made.pieces.begin() + static_cast<std::ptrdiff_t>(first);
    const bool is_apart = std::all_of(from, made.pieces.end(), [&](const TissuePiece& other) {
      return distance(other.at, stands.at) >= kApartMm;
    });
    if (!is_here || !is_apart) continue;
    tuft.kind = TissueKind::Synovium;
    tuft.patch = patch;
    tuft.joint = place.joint;
    tuft.body = place.body;
    tuft.at = stands.at;
    tuft.inwards = stands.inwards;
    made.pieces.push_back(tuft);
  }
}

/// The finding whose scale has this grade; and the grade.
std::pair<std::size_t, std::uint8_t> graded(const PathologyTable& table, const std::string& id) {
  for (std::size_t f = 0; f < table.findings.size(); ++f) {
    const std::vector<Grade>& grades = table.scale_of(f).grades;
    for (std::size_t g = 1; g < grades.size(); ++g) {
      if (grades[g].id == id) return {f, static_cast<std::uint8_t>(g)};
    }
  }
  return {table.findings.size(), 0};
}

}  // namespace

cases::JointLesions make_synovitis(const cases::CaseData& data,
                                   const cases::ArthroscopicMap& map,
                                   const SynovitisChoice& choice,
                                   std::uint64_t seed) {
  Rng rng(seed ^ kSynoviumStream);
  cases::JointLesions made;
  made.shifts.assign(data.bones.size(), {});
  std::vector<const cases::TourPoint*> places;
  for (const cases::TourPoint& point : map.points) {
    const auto number = static_cast<std::uint8_t>(point.number);
    const auto& asked = choice.places;
    if (std::find(asked.begin(), asked.end(), number) != asked.end()) places.push_back(&point);
  }
  const std::uint64_t spread = choice.patches[1] - choice.patches[0] + 1U;
  const std::uint64_t patches = choice.patches[0] + rng.below(spread);
  for (std::uint64_t p = 0; p < patches && !places.empty(); ++p) {
    const auto at = static_cast<std::ptrdiff_t>(rng.below(places.size()));
    const cases::TourPoint& place = *places[static_cast<std::size_t>(at)];
    places.erase(places.begin() + at);
    const std::uint64_t tufts = choice.tufts[0] + rng.below(choice.tufts[1] - choice.tufts[0] + 1U);
    add_patch(made, map, place, static_cast<std::uint8_t>(p), tufts, rng);
  }
  return made;
}

cases::JointLesions make_torn_disc(const cases::CaseData& data,
                                   const cases::ArthroscopicMap& map,
                                   const TornDiscChoice& choice,
                                   std::uint64_t seed) {
  Rng rng(seed ^ kTearStream);
  const PathologyTable& table = PathologyTable::generic();
  const auto [finding, grade] = graded(table, choice.tears[rng.below(choice.tears.size())]);
  cases::Grades grades{};
  if (finding < grades.size()) grades[finding] = grade;
  cases::JointLesions made = make_lesions(data, map, table, grades, seed);
  if (made.lesions.empty()) return made;
  const cases::Lesion& tear = made.lesions.front();
  const yielding::Net net = disc_net(map, &made);
  for (std::size_t i = 0; i < net.size(); ++i) {
    TissuePiece piece;
    piece.kind = TissueKind::Disc;
    piece.joint = tear.joint;
    piece.body = map.forearm;
    piece.inwards = net.normals()[i];
    piece.at = net.rest()[i] + piece.inwards * kHalfDiscMm;
    piece.radius_mm = net.spacing_mm() / 2;
    const double off = to_line(piece.at, tear.from, tear.to);
    // A slit has no room of its own; what is worn through has.
    piece.is_gone = tear.look == cases::LesionLook::Worn && off < tear.radius_mm;
    piece.is_ill = !piece.is_gone && off < tear.radius_mm + choice.frayed_mm;
    for (std::size_t k = 0; k < net.size() && !piece.is_ill && !piece.is_gone; ++k) {
      const bool is_near = distance(net.rest()[k], net.rest()[i]) < choice.rim_mm;
      piece.is_rim = piece.is_rim || (net.is_held(k) && is_near);
    }
    made.pieces.push_back(piece);
  }
  return made;
}

}  // namespace carpus::arthroscopy
