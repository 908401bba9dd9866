// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A hand that makes portals through the plate of skin over the box.
#pragma once

#include "simulation/skin_over_box_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation::box_joint {

/// So far out of the skin, before the portal's place or aside of it.
inline Vec3 at(double out_mm, double y = 0.0, double z = 0.0) {
  return Vec3{kSkinX + out_mm, kMiddle.y + y, kMiddle.z + z};
}

class Maker {
 public:
  explicit Maker(World& world) : hand(world), world_(world) { hand.go(at(15)); }
  void take(const char* id) {
    Command command;
    command.kind = CommandKind::Take;
    command.hand = hand.led;
    command.index = tool(id);
    hand.command(command);
    hand.go(hand_at(), 60);
  }
  void feel(double y, double z) {
    for (const double dy : {-2.5, 0.0, 2.5}) {
      for (const double dz : {-2.5, 0.0, 2.5}) hand.go(at(-2, y + dy, z + dz), 300);
    }
    hand.go(at(15, y, z), 50);
  }
  void prick(double y = 0.0, double z = 0.0, double deep = 9.0) {
    take("needle_22g");
    hand.go(at(15, y, z));
    hand.go(at(-deep, y, z), 500);
    hand.go(at(15, y, z), 100);
  }
  void cut(double y = 0.0, double deep = 1.7, double half = 2.5) {
    take("blade_15");
    hand.go(at(15, y, -half), 50);
    hand.go(at(-deep, y, -half), 300);
    hand.go(at(-deep, y, half), 300);
    hand.go(at(15, y, half), 100);
  }
  void spread(double y = 0.0) {
    take("mosquito_clamp");
    hand.go(at(15, y));
    hand.go(at(-6.5, y), 300);
    hand.drive(Driver::Forward);
    for (int i = 0; i < 600; ++i) hand.step();
    hand.drive(Driver::Off);
    hand.go(at(15, y), 100);
  }
  void enter(double y = 0.0, double deep = 11.0) {
    take("scope_sheath_1_9");
    hand.go(at(15, y));
    hand.go(at(-deep, y), 500);
  }
  [[nodiscard]] const procedure::PortalMade& made(std::size_t which = 0) const {
    return world_.now().skin.facts.portal[which];
  }

  Hand hand;

 private:
  [[nodiscard]] Vec3 hand_at() const { return at(15); }
  World& world_;
};

inline double tip_out_mm(const World& world) {
  return world.now().items[world.now().hands[0].item].tip_in_patient.x - kSkinX;
}

}  // namespace carpus::simulation::box_joint
