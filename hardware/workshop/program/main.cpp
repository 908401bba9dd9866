// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// carpus_workshop FOLDER clearance|pictures...: looks at the arm of hardware/ as it is printed.
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>

#include "arm/delta_arm.hpp"
#include "core/error.hpp"
#include "hardware/workshop/clearance.hpp"
#include "hardware/workshop/guide_pictures.hpp"

namespace {

using namespace carpus;
using namespace carpus::hardware;

/// The nearest approach of each pair of parts over a grid of the workspace.
void print_clearance(const Numbers& numbers, const Parts& parts, Drive drive, int steps) {
  std::map<std::pair<std::string, std::string>, std::pair<double, Vec3>> nearest;
  Clearance clearance;
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      for (int z = -steps; z <= steps; ++z) {
        AssemblyOptions options;
        options.drive = drive;
        options.tip += Vec3{50.0 * x / steps, 50.0 * y / steps, 40.0 * z / steps};
        // The tool is in its portal: it does not lean as far as the arm could go.
        options.has_tool = tool_may_be_at(options.tip);
        for (const Nearness& near : clearance.near_pairs(assemble(numbers, parts, options), 2)) {
          auto& kept = nearest.try_emplace({near.one, near.other}, 1e9, Vec3{}).first->second;
          if (near.distance_mm < kept.first) kept = {near.distance_mm, options.tip};
        }
      }
    }
  }
  for (const auto& [pair, value] : nearest) {
    std::printf("drive %s: %-14s %-14s %5.2f mm at %4.0f %4.0f %4.0f\n",
                drive == Drive::A ? "A" : "B", pair.first.c_str(), pair.second.c_str(), value.first,
                value.second.x, value.second.y, value.second.z);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string what = argc >= 3 ? argv[2] : "";
    if (what != "clearance" && what != "pictures") {
      std::fputs("usage: carpus_workshop FOLDER clearance [STEPS] | pictures OUT [NAME...]\n",
                 stderr);
      return 2;
    }
    const std::filesystem::path folder = argv[1];
    const Numbers numbers(folder / "parts/numbers.scad");
    const Parts parts = read_parts(folder);
    if (what == "clearance") {
      const int steps = argc > 3 ? std::stoi(argv[3]) : 2;
      for (const Drive drive : {Drive::A, Drive::B}) print_clearance(numbers, parts, drive, steps);
      return 0;
    }
    draw_guide(numbers, parts, argc > 3 ? argv[3] : "pictures",
               {argv + std::min(argc, 4), argv + argc});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "carpus_workshop: %s\n", error.what());
    return 1;
  }
}
