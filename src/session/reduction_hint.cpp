// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "session/reduction_hint.hpp"

#include <cmath>
#include <vector>

#include "anatomy/bone_words.hpp"
#include "cases/direction_words.hpp"
#include "core/units.hpp"

namespace carpus::session {

namespace {

constexpr double kMeetMm = 1.0;
constexpr double kMeetDeg = 7.0;

std::string whole(double value) { return std::to_string(std::lround(value)); }

}  // namespace

std::optional<BrokenBone> broken_bone_of(const cases::CaseData& data, BoneId target) {
  std::vector<std::size_t> pieces;
  for (std::size_t b = 0; b < data.bones.size(); ++b) {
    if (data.bones[b].bone == target) pieces.push_back(b);
  }
  if (pieces.size() != 2) return std::nullopt;
  const auto faces =
      anatomy::reduction_of(data.bones[pieces[0]].surface, data.bones[pieces[1]].surface);
  if (!faces) return std::nullopt;
  return BrokenBone{pieces[0], pieces[1], *faces};
}

std::string reduction_hint(const cases::CaseData& data,
                           const BrokenBone& broken,
                           const simulation::Snapshot& now) {
  // In the first piece as scanned: there the case's directions are those of the hand.
  const Pose<frame::Bone, frame::Bone> first_from_second =
      now.patient_from_bone[broken.first].inverse() * now.patient_from_bone[broken.second];
  const anatomy::Reduction& faces = broken.faces;
  const Vec3 way =
      faces.first_middle - (first_from_second * Point<frame::Bone>{faces.second_middle}).v;
  const Vec3 looks = (first_from_second * Direction<frame::Bone>{faces.second_normal}).v;
  const Vec3 wanted = -faces.first_normal;
  const double angle_deg =
      degrees_from_radians(std::atan2(length(cross(looks, wanted)), dot(looks, wanted)));
  const cases::Bone& second = data.bones[broken.second];
  std::string hint;
  if (length(way) > kMeetMm) {
    hint = "Lead the " + std::string(words_of(second.bone, second.part)) + " " +
           whole(length(way)) + " mm " + cases::direction_in_words(data, way);
  }
  if (angle_deg > kMeetDeg) {
    hint += hint.empty() ? "Turn the " + std::string(words_of(second.bone, second.part)) +
                               " until its fracture face looks "
                         : "; turn it until its fracture face looks ";
    hint += whole(angle_deg) + "° more " + cases::direction_in_words(data, wanted - looks);
  }
  return hint.empty() ? "The pieces meet." : hint + ".";
}

}  // namespace carpus::session
