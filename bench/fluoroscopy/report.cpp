// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/fluoroscopy/report.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/provenance.hpp"

namespace carpus::bench {
namespace {

template <typename... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

std::string text_of(const FluoroscopyReport& r) {
  const Provenance p = provenance();
  std::string text = p.machine + "\n" + p.compiler + "; " + p.flags + "; commit " + p.commit + "\n";
  text += line("case '%s'%s, %d x %d x %d voxels\n\n", r.case_name.c_str(),
               r.case_simulated ? " (simulated)" : "", r.voxels[0], r.voxels[1], r.voxels[2]);
  text += "attenuation, in percent of the picture's range\n";
  text += line("%-20s %5s %-14s %8s %8s %8s %12s %10s\n", "view", "flex", "against", "mean", "p99",
               "worst", "within 1 %", "left out");
  for (const Difference& d : r.differences) {
    text += line("%-20s %5.0f %-14s %8.3f %8.3f %8.3f %12.2f %10.2f\n", d.view.c_str(),
                 d.flexion_deg, d.oracle.c_str(), d.mean_percent, d.p99_percent, d.worst_percent,
                 d.share_within_1_percent, d.left_out_percent);
  }
  text += line("\n%-30s %6s %10s %10s %12s %10s\n", "pictures, receptor and all", "pixels",
               "median ms", "worst ms", "processor ms", "a second");
  for (const PictureTimes& t : r.times) {
    text += line("%-30s %6d %10.1f %10.1f %12.1f %10.1f\n", t.what.c_str(), t.pixels,
                 t.seconds * 1e3, t.worst_seconds * 1e3, t.processor_seconds * 1e3, 1 / t.seconds);
  }
  return text;
}

std::string json_of(const FluoroscopyReport& r) {
  using Json = nlohmann::ordered_json;
  const Provenance p = provenance();
  Json json{{"case", r.case_name},    {"case_simulated", r.case_simulated},
            {"voxels", r.voxels},     {"machine", p.machine},
            {"compiler", p.compiler}, {"flags", p.flags},
            {"commit", p.commit},     {"cores", std::thread::hardware_concurrency()}};
  for (const Difference& d : r.differences) {
    json["differences"].push_back({{"view", d.view},
                                   {"flexion_deg", d.flexion_deg},
                                   {"against", d.oracle},
                                   {"mean_percent", d.mean_percent},
                                   {"p99_percent", d.p99_percent},
                                   {"worst_percent", d.worst_percent},
                                   {"within_1_percent", d.share_within_1_percent},
                                   {"left_out_percent", d.left_out_percent},
                                   {"pixels", d.pixels}});
  }
  for (const PictureTimes& t : r.times) {
    json["pictures"].push_back({{"what", t.what},
                                {"pixels", t.pixels},
                                {"seconds", t.seconds},
                                {"worst_seconds", t.worst_seconds},
                                {"processor_seconds", t.processor_seconds},
                                {"runs", t.pictures}});
  }
  return json.dump(1) + "\n";
}

}  // namespace carpus::bench
