// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/detail/bodies.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace carpus::simulation::detail {

BodyKinds kinds_of(const cases::CaseData& data, const procedure::Procedure& procedure) {
  if (data.bones.size() > kMaxBodies) {
    throw InvalidInput("simulation: the case has " + std::to_string(data.bones.size()) +
                       " bones, at most " + std::to_string(kMaxBodies) + " are expected");
  }
  if (data.ct.values().empty()) {
    throw InvalidInput("simulation: the case has no CT; resistance and pictures come from it");
  }
  BodyKinds kinds;
  for (std::size_t i = 0; i < data.bones.size(); ++i) {
    const cases::Bone& bone = data.bones[i];
    if (bone.distance_field.values().empty()) {
      throw InvalidInput("simulation: the " + std::string(name_of(bone.bone, bone.part)) +
                         " has no distance field; reconstruct the case again");
    }
    const BodySet bit = bit_of(static_cast<std::uint8_t>(i));
    if (bone.bone == procedure.target) kinds.target |= bit;
    if (std::find(procedure.allowed.begin(), procedure.allowed.end(), bone.bone) !=
        procedure.allowed.end()) {
      kinds.allowed |= bit;
    }
    if (bone.part != BonePart::Whole) kinds.fragments |= bit;
  }
  if (kinds.target == 0) {
    throw InvalidInput("simulation: the case has no " + std::string(name_of(procedure.target)) +
                       " to operate on");
  }
  return kinds;
}

std::optional<FragmentFaces> fracture_in(const cases::CaseData& data, const BodyKinds& kinds) {
  const BodySet pieces = kinds.target & kinds.fragments;
  const BodySet others = pieces & (pieces - 1U);
  if (others == 0 || (others & (others - 1U)) != 0) return std::nullopt;
  const std::uint8_t first = first_of(pieces);
  const std::uint8_t second = first_of(others);
  const auto faces = anatomy::reduction_of(data.bones[first].surface, data.bones[second].surface);
  if (!faces) return std::nullopt;
  return FragmentFaces{first, second, *faces};
}

}  // namespace carpus::simulation::detail
