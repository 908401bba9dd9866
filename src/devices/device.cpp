// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "devices/device.hpp"

namespace carpus::devices {

const char* in_words(Health health) noexcept {
  switch (health) {
    case Health::Closed:
      return "not in use";
    case Health::Starting:
      return "starting";
    case Health::Uncalibrated:
      return "not calibrated";
    case Health::Good:
      return "good";
    case Health::HoldingBack:
      return "holding back";
    case Health::Silent:
      return "silent";
    case Health::Faulty:
      return "faulty";
    case Health::Gone:
      return "unplugged";
  }
  return "not known";
}

std::string in_words(const Capabilities& able) {
  std::string words;
  const auto add = [&words](bool can, const char* word) {
    if (can) words += (words.empty() ? "" : ", ") + std::string(word);
  };
  add(able.position, able.absolute ? "position" : "speed");
  add(able.rotation, "rotation");
  add(able.force, "force");
  add(able.stop, "stops");
  add(able.local_plane, "local planes");
  add(able.vibration, "vibration");
  add(able.torque, "torque");
  return words;
}

const char* what_to_do(Health health) noexcept {
  switch (health) {
    case Health::Uncalibrated:
      return "Calibrate it: carpus device calibrate";
    case Health::HoldingBack:
      return "Press less for a while: it is hot or at its limit.";
    case Health::Silent:
      return "Look whether it is switched on and its cable sits.";
    case Health::Faulty:
      return "A sensor is broken or unplugged: see docs/devices.md.";
    case Health::Gone:
      return "Plug it in: it goes on by itself.";
    case Health::Starting:
    case Health::Closed:
    case Health::Good:
      break;
  }
  return "";
}

}  // namespace carpus::devices
