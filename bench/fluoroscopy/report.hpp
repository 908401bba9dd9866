// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What `carpus bench fluoroscopy` found, for people and as JSON (docs/json.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/fluoroscopy/accuracy.hpp"
#include "bench/fluoroscopy/speed.hpp"

namespace carpus::bench {

struct FluoroscopyReport {
  std::string case_name;
  bool case_simulated = false;
  std::array<int, 3> voxels{};
  std::vector<Difference> differences;
  std::vector<PictureTimes> times;
};

[[nodiscard]] std::string text_of(const FluoroscopyReport& report);
[[nodiscard]] std::string json_of(const FluoroscopyReport& report);

}  // namespace carpus::bench
