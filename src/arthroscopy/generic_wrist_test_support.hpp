// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The generic wrist with its soft tissue and its map, right, larger and turned; made once a
// process.
#pragma once

#include "arthroscopy/make_map.hpp"
#include "cases/make_hand_motion.hpp"
#include "fields/distance_field.hpp"
#include "soft_tissue/make_soft_tissue.hpp"
#include "soft_tissue/model_case_test_support.hpp"

namespace carpus::arthroscopy::test {

struct GenericWrist {
  cases::CaseData data;
  soft_tissue::SoftTissue tissue;
  cases::ArthroscopicMap map;
};

inline const GenericWrist& generic_wrist() {
  static const GenericWrist kWrist = [] {
    const Mat3 turned = Mat3::from_columns({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    GenericWrist made;
    made.data = soft_tissue::test::model_case(Side::Right, 1.05, turned);
    for (cases::Bone& bone : made.data.bones) {
      bone.distance_field = fields::build_distance_field(bone.surface, {0.6, 4.0});
    }
    cases::ensure_hand_motion(made.data);
    made.tissue = soft_tissue::make_soft_tissue(made.data);
    made.map = make_map(made.data, made.tissue);
    return made;
  }();
  return kWrist;
}

}  // namespace carpus::arthroscopy::test
