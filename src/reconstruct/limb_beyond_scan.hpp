// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The hand and the forearm where the scan's field cut them off, so that a draped patient has
// fingers and an arm. Generated, seen in no CT, for the eye alone: nothing is measured on it.
#pragma once

#include "cases/case_data.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::reconstruct {

/// Open surfaces, frame Patient as scanned [mm]; empty where the skin was not cut off. Each begins
/// a little within the skin that it goes on from.
struct LimbBeyondScan {
  TriangleMesh hand;     ///< goes with the hand
  TriangleMesh forearm;  ///< goes with the radius; its far end is open
};

/// From each rim of the skin its outline goes on and within 25 mm becomes what is generated: along
/// the rays of the metacarpals, whose bases and ways are the case's, knuckles and fingers of a
/// grown-up's mean lengths [buryanov2010hand] times the palm's breadth against the generic wrist's,
/// a little bent; and an arm that widens.
/// @param data  its skin already trimmed (skin_surface.hpp); needs side, wrist frame, metacarpals.
[[nodiscard]] LimbBeyondScan limb_beyond_scan(const cases::CaseData& data);

}  // namespace carpus::reconstruct
