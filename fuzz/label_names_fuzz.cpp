// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes for the list of --names: refused in words that name the file, or each bone with one
// number.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "anatomy/bone_id.hpp"
#include "reconstruct/label_names.hpp"
#include "refusals.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace carpus;
  fuzz::reads_or_refuses("names.json", [&] {
    const auto map =
        reconstruct::parse_label_names({reinterpret_cast<const char*>(data), size}, "names.json");
    fuzz::require(map[0] == 0);
    std::array<int, kScaphoidDistalLabel + 1> times{};
    for (const std::uint8_t label : map) ++times.at(label);
    fuzz::require(times[0] < 256);
    for (std::size_t label = 1; label < times.size(); ++label) fuzz::require(times[label] <= 1);
  });
  return 0;
}
