// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// carpus-shader-cost VERTEX.spv FRAGMENT.spv: prints as JSON what they cost the device that
// RADV_FORCE_FAMILY names.
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bench/graphics/pipeline_cost.hpp"

namespace {

std::vector<std::uint32_t> read_code(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.empty() || bytes.size() % 4 != 0)
    throw std::runtime_error(std::string(path) + " is no SPIR-V");
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  if (words[0] != 0x07230203u) throw std::runtime_error(std::string(path) + " is no SPIR-V");
  return words;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::cerr << "Usage: carpus-shader-cost VERTEX.spv FRAGMENT.spv\n";
    return 2;
  }
  try {
    const auto vertex = read_code(arguments[1]);
    const auto fragment = read_code(arguments[2]);
    const carpus::bench::NullDevice device;
    nlohmann::json stages = nlohmann::json::array();
    for (const auto& cost : carpus::bench::pipeline_cost(device, vertex, fragment)) {
      stages.push_back({{"stage", cost.stage},
                        {"lanes", cost.lanes},
                        {"cycles", cost.cycles},
                        {"instructions", cost.instructions},
                        {"registers", cost.registers}});
    }
    std::cout << nlohmann::json{{"device", device.name()}, {"stages", stages}}.dump() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "carpus-shader-cost: " << error.what() << '\n';
    return 1;
  }
}
