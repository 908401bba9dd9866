// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What can be taken away in the box of a joint: its disc, torn in the middle, or inflamed synovium.
#pragma once

#include <initializer_list>
#include <memory>
#include <utility>

#include "simulation/box_joint_test_support.hpp"

namespace carpus::simulation::box_joint {

inline const Vec3 kFloor = kMiddle + Vec3{0, 0, -kHalfHigh};

/// Synovium is inflamed at one place. @param tray  ids of the catalogue
inline procedure::Procedure inflamed_with(std::initializer_list<const char*> tray) {
  procedure::Procedure made = probe_alone();
  made.tray.clear();
  for (const char* id : tray) made.tray.push_back(*instruments::instrument_of(id));
  made.shaving.emplace();
  made.shaving->synovium = {{1, 1}, {6, 6}, {16}};
  return made;
}

/// The disc is torn in its middle.
inline procedure::Procedure torn_with(std::initializer_list<const char*> tray) {
  procedure::Procedure made = inflamed_with(tray);
  made.shaving.emplace();
  made.shaving->disc = procedure::TornDisc{{"1A"}, 0.8, 2.0};
  return made;
}

/// The map of a wrist with the disc's middle on the tour, by which it is torn.
inline cases::ArthroscopicMap map_with_disc() {
  cases::ArthroscopicMap map = *box_wrist().arthroscopy;
  cases::TourPoint disc = map.points.front();
  disc.number = 15;
  disc.id = "disc";
  disc.at = kFloor;
  map.points.push_back(disc);
  return map;
}

inline cases::CaseData box_wrist_with(cases::ArthroscopicMap map) {
  cases::CaseData made = box_wrist();
  made.arthroscopy = std::make_shared<const cases::ArthroscopicMap>(std::move(map));
  return made;
}

}  // namespace carpus::simulation::box_joint
