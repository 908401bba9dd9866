// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/hull_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

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
    const HullRow& any = *by_engine.begin()->second;
    const std::string note = note_on(any.origin, any.n);
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
    const auto ratio = [fast](double peer) {
      return fast > 0 && std::isfinite(peer) ? format("  %6.2f x", peer / fast) : "         -";
    };
    text += ratio(best_exact) + ratio(best) + (note.empty() ? "" : "  " + note) + "\n";
  }
  return text + "!: not the same corners, facets and volume as the exact answer\n";
}

}  // namespace carpus::bench
