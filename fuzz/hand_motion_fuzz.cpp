// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as hand_motion.json: refused in words that name the file, or a table from which every
// pose of the hand, within its limits or not, gives places that a wrist's bones can have.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "case_io/detail/hand_motion_json.hpp"
#include "refusals.hpp"

namespace {

using namespace carpus;

/// Far beyond what any hand does; the reader's own limits are narrower.
constexpr double kFarthestMm = 500;

void require_usable(const cases::HandMotion& motion) {
  const std::string text = case_io::hand_motion_text(motion);
  fuzz::require(case_io::parse_hand_motion(text, "hand_motion.json") == motion);
  for (const double share : {-1e9, -0.9, -0.3, 0.0, 0.2, 0.7, 1e9}) {
    const anatomy::HandPose pose{share, -0.8 * share, 0.9 * share, 100 * share};
    for (std::size_t g = 0; g < anatomy::kCarpalGroupCount; ++g) {
      const auto place = motion.poses_at(pose)[g];
      fuzz::require(std::abs(place.rotation.determinant() - 1) < 1e-6);
      const Vec3& middle = motion.reference[g];
      fuzz::require(distance(place.rotation * middle + place.translation, middle) < kFarthestMm);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::reads_or_refuses("hand_motion.json", [&] {
    require_usable(case_io::parse_hand_motion({reinterpret_cast<const char*>(data), size},
                                              "hand_motion.json"));
  });
  return 0;
}
