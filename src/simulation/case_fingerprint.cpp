// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "core/state_hash.hpp"
#include "simulation/recording.hpp"

namespace carpus::simulation {
namespace {

void add_vector(StateHash& hash, const Vec3& v) {
  for (std::size_t i = 0; i < 3; ++i) hash.add(v[i]);
}

void add_grid_geometry(StateHash& hash, const GridGeometry& geometry) {
  for (const int n : geometry.size) hash.add(static_cast<std::uint64_t>(n));
  for (std::size_t i = 0; i < 3; ++i) {
    hash.add(geometry.spacing[i]);
    hash.add(geometry.origin[i]);
    for (std::size_t j = 0; j < 3; ++j) hash.add(geometry.direction.rows[i][j]);
  }
}

/// Four voxels at a time: a CT has tens of millions of bytes.
template <typename T, typename Convert>
void add_values(StateHash& hash, std::span<const T> values, Convert convert) {
  constexpr std::size_t kPacked = 8 / sizeof(T);
  for (std::size_t i = 0; i < values.size(); i += kPacked) {
    std::uint64_t word = 0;
    for (std::size_t j = i; j < std::min(i + kPacked, values.size()); ++j) {
      word = (word << (8 * sizeof(T) % 64)) ^ convert(values[j]);
    }
    hash.add(word);
  }
}

void add_hand_motion(StateHash& hash, const cases::HandMotion& motion) {
  for (const double angle : motion.flexion_rad) hash.add(angle);
  for (const double angle : motion.deviation_rad) hash.add(angle);
  for (const cases::HandMotionNode& node : motion.nodes) {
    for (const cases::GroupMotion& group : node.groups) {
      for (const double q : group.quaternion) hash.add(q);
      add_vector(hash, group.shift);
    }
  }
  for (const Vec3& reference : motion.reference) add_vector(hash, reference);
  add_vector(hash, motion.hand_axis);
  add_vector(hash, motion.pronation_axis);
  add_vector(hash, motion.pronation_centre);
  for (const Vec3& shift : motion.pronation_shift) add_vector(hash, shift);
}

}  // namespace

std::uint64_t fingerprint_of(const cases::CaseData& data) {
  StateHash hash;
  hash.add(static_cast<std::uint64_t>(data.side));
  add_grid_geometry(hash, data.ct.geometry());
  add_values(hash, data.ct.values(),
             [](std::int16_t v) { return std::uint64_t{static_cast<std::uint16_t>(v)}; });
  for (const cases::Bone& bone : data.bones) {
    hash.add(static_cast<std::uint64_t>(bone.label));
    for (const Vec3& v : bone.surface.vertices) add_vector(hash, v);
    add_grid_geometry(hash, bone.distance_field.geometry());
    add_values(hash, bone.distance_field.values(),
               [](float v) { return std::uint64_t{std::bit_cast<std::uint32_t>(v)}; });
  }
  add_vector(hash, data.wrist_from_patient.translation);
  for (const Vec3& row : data.wrist_from_patient.rotation.rows) add_vector(hash, row);
  const cases::ScaphoidLandmarks& scaphoid = data.scaphoid;
  for (const Vec3& end :
       {scaphoid.central_axis.proximal, scaphoid.central_axis.distal,
        scaphoid.longest_line.proximal, scaphoid.longest_line.distal, scaphoid.waist}) {
    add_vector(hash, end);
  }
  hash.add(scaphoid.central_radius_mm);
  add_hand_motion(hash, data.hand_motion);
  // A case without them keeps the fingerprint that it had before there were any.
  for (const cases::Structure& structure : data.structures) {
    hash.add(structure.radius_mm);
    hash.add(static_cast<std::uint64_t>(structure.forearm));
    for (const cases::StructurePoint& point : structure.course) {
      add_vector(hash, point.at);
      hash.add(point.hand_share);
    }
  }
  return hash.value();
}

}  // namespace carpus::simulation
