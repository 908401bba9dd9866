// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bodies of one exercise: each bone or fragment of the case, its true surface as a field that
// drilling changes, its density, its pose of now.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/reduction.hpp"
#include "cases/case_data.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"
#include "procedure/procedure.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation::detail {

using BodyPose = Pose<frame::Patient, frame::Bone>;

/// A bit for each body.
using BodySet = std::uint32_t;

[[nodiscard]] constexpr BodySet bit_of(std::uint8_t body) noexcept {
  return body < kMaxBodies ? 1U << body : 0U;
}

/// What kind each body is to a procedure.
struct BodyKinds {
  BodySet target = 0;     ///< the bone that is operated on, all its fragments
  BodySet allowed = 0;    ///< may be entered on the way
  BodySet fragments = 0;  ///< parts of a broken bone, which move apart where pushed
};

/// @throws InvalidInput when there are more than kMaxBodies, none of the target, or a bone without
///     a distance field.
[[nodiscard]] BodyKinds kinds_of(const cases::CaseData& data,
                                 const procedure::Procedure& procedure);

/// A target in two pieces, and where they broke.
struct FragmentFaces {
  std::uint8_t first = kNoBody;
  std::uint8_t second = kNoBody;
  anatomy::Reduction faces;
};

/// Nothing for a whole bone, one in more pieces, or pieces without a face.
[[nodiscard]] std::optional<FragmentFaces> fracture_in(const cases::CaseData& data,
                                                       const BodyKinds& kinds);

/// The first of a set, which must not be empty.
[[nodiscard]] constexpr std::uint8_t first_of(BodySet bodies) noexcept {
  std::uint8_t body = 0;
  while (body + 1U < kMaxBodies && (bodies & bit_of(body)) == 0) ++body;
  return body;
}

[[nodiscard]] constexpr double absolute(double value) noexcept {
  return value < 0 ? -value : value;
}

}  // namespace carpus::simulation::detail
