// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/hull_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/provenance.hpp"
#include "core/error.hpp"

namespace carpus::bench {
namespace {

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

std::vector<std::string> engines_of(const std::vector<HullRow>& rows) {
  std::vector<std::string> names;
  for (const HullRow& row : rows) {
    if (std::find(names.begin(), names.end(), row.engine) == names.end())
      names.push_back(row.engine);
  }
  return names;
}

std::string cell(const HullRow* row) {
  if (row == nullptr || !row->ran) return format("%14s", "not run");
  return format("%11.3f ms%s", row->seconds * 1e3, row->agrees ? " " : "!");
}

/// Slope of log(seconds) over log(n).
double exponent(const std::vector<std::pair<double, double>>& samples) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [n, seconds] : samples) {
    const double x = std::log(n);
    const double y = std::log(seconds);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const auto count = static_cast<double>(samples.size());
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

}  // namespace

std::string text_of(const std::vector<HullRow>& rows) {
  const std::vector<std::string> engines = engines_of(rows);
  std::string text = format("%-18s %9s %8s", "points", "n", "h");
  for (const std::string& engine : engines) text += format("%14s", engine.c_str());
  text += "   fast against the best exact peer, any peer\n";
  using Key = std::pair<std::string, std::size_t>;
  std::vector<Key> order;
  std::map<Key, std::map<std::string, const HullRow*>> table;
  for (const HullRow& row : rows) {
    const Key key{row.set, row.n};
    if (table.find(key) == table.end()) order.push_back(key);
    table[key][row.engine] = &row;
  }
  for (const Key& key : order) {
    const auto& by_engine = table[key];
    std::size_t h = 0;
    double fast = 0;
    double best_exact = std::numeric_limits<double>::infinity();
    double best = best_exact;
    for (const auto& [name, row] : by_engine) {
      if (!row->ran) continue;
      if (name == "fast") fast = row->seconds;
      if (name == "quickhull") h = row->h;
      if (row->is_peer) best = std::min(best, row->seconds);
      if (row->is_peer && name != "bullet") best_exact = std::min(best_exact, row->seconds);
    }
    text += format("%-18s %9zu %8zu", key.first.c_str(), key.second, h);
    for (const std::string& engine : engines) {
      const auto found = by_engine.find(engine);
      text += cell(found == by_engine.end() ? nullptr : found->second);
    }
    text += fast > 0 && std::isfinite(best)
                ? format("   %.2f x  %.2f x\n", best_exact / fast, best / fast)
                : "\n";
  }
  return text + "!: not the same corners, facets and volume as the exact answer\n";
}

std::string growth_of(const std::vector<HullRow>& rows) {
  std::map<std::pair<std::string, std::string>, std::vector<std::pair<double, double>>> samples;
  for (const HullRow& row : rows) {
    if (row.ran)
      samples[{row.set, row.engine}].push_back({static_cast<double>(row.n), row.seconds});
  }
  std::string text;
  for (const auto& [key, points] : samples) {
    if (points.size() < 3) continue;
    text += format("%-10s %-14s seconds grow with n^%.2f\n", key.first.c_str(), key.second.c_str(),
                   exponent(points));
  }
  return text;
}

void write_json(const std::filesystem::path& file,
                const std::string& table,
                const std::vector<HullRow>& rows) {
  const Provenance p = provenance();
  nlohmann::ordered_json json{{"table", table},         {"machine", p.machine},
                              {"compiler", p.compiler}, {"flags", p.flags},
                              {"commit", p.commit},     {"rows", nlohmann::ordered_json::array()}};
  for (const HullRow& row : rows) {
    nlohmann::ordered_json r{{"case", row.set}, {"n", row.n}, {"h", row.h}, {"engine", row.engine}};
    if (row.ran) {
      r["seconds"] = row.seconds;
      r["fastest_seconds"] = row.fastest_seconds;
      r["runs"] = row.runs;
      r["agrees"] = row.agrees;
      if (row.engine == "hybrid") r["discarded_share"] = row.discarded_share;
    } else {
      r["seconds"] = nullptr;
      r["status"] = "not run";
    }
    json["rows"].push_back(std::move(r));
  }
  std::ofstream out(file);
  out << json.dump(1) << '\n';
  out.flush();
  if (!out) throw IoError(file.string() + ": could not be written; check the folder and the disk");
}

}  // namespace carpus::bench
