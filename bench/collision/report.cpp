// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/report.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/provenance.hpp"
#include "bench/text_format.hpp"
#include "core/error.hpp"

namespace carpus::bench {
namespace {

constexpr double kMicro = 1e6;

std::string cell(const CollisionRow* row) {
  if (row == nullptr) return format("%20s", "");
  if (!row->ran) return format("%20s", "not run");
  return format("%9.3f /%8.3f%s", row->timing.median * kMicro, row->timing.p99 * kMicro,
                row->agrees ? " " : "!");
}

template <typename Get>
std::vector<std::string> distinct(const std::vector<CollisionRow>& rows, Get get) {
  std::vector<std::string> values;
  for (const CollisionRow& row : rows) {
    if (std::find(values.begin(), values.end(), get(row)) == values.end()) {
      values.push_back(get(row));
    }
  }
  return values;
}

/// The fastest by median among ours that agree, or among the peers.
const CollisionRow* fastest(const std::vector<const CollisionRow*>& rows, bool peers) {
  const CollisionRow* best = nullptr;
  for (const CollisionRow* row : rows) {
    if (!row->ran || row->is_peer != peers || (!peers && !row->agrees)) continue;
    if (best == nullptr || row->timing.median < best->timing.median) best = row;
  }
  return best;
}

std::string query_text(const std::string& query, const std::vector<CollisionRow>& rows) {
  const auto columns = distinct(rows, [](const CollisionRow& r) { return r.pose_case; });
  const auto engines = distinct(rows, [](const CollisionRow& r) { return r.engine; });
  std::string text = format("%s: median / p99, microseconds\n%-20s", query.c_str(), "");
  for (const std::string& c : columns) text += format("%20s", c.c_str());
  text += "\n";
  for (const std::string& engine : engines) {
    text += format("%-20s", engine.c_str());
    std::string notes;
    for (const std::string& column : columns) {
      const CollisionRow* found = nullptr;
      for (const CollisionRow& r : rows) {
        if (r.engine == engine && r.pose_case == column) found = &r;
      }
      text += cell(found);
      if (found == nullptr || !found->ran || found->agrees) continue;
      const Timing& t = found->timing;
      notes += "  " + column + ":";
      if (t.wrong > 0) notes += format(" %llu wrong", static_cast<unsigned long long>(t.wrong));
      if (t.unknown > 0) {
        notes += format(" %llu unknown", static_cast<unsigned long long>(t.unknown));
      }
      if (t.missing > 0) {
        notes += format(" %llu missing", static_cast<unsigned long long>(t.missing));
      }
      if (t.largest_error_mm > 0) notes += format(" error %.1e mm", t.largest_error_mm);
    }
    text += (notes.empty() ? "" : "  !" + notes) + "\n";
  }
  for (const std::string& column : columns) {
    std::vector<const CollisionRow*> here;
    for (const CollisionRow& r : rows) {
      if (r.pose_case == column) here.push_back(&r);
    }
    const CollisionRow* own = fastest(here, false);
    const CollisionRow* peer = fastest(here, true);
    if (own == nullptr || peer == nullptr) continue;
    text += format("%-20s %s is %.1f times as fast as %s (p99 %.1f times)\n", column.c_str(),
                   own->engine.c_str(), peer->timing.median / own->timing.median,
                   peer->engine.c_str(), peer->timing.p99 / own->timing.p99);
  }
  return text + "\n";
}

}  // namespace

std::string text_of(const std::vector<CollisionRow>& rows) {
  std::string text;
  for (const std::string& query : distinct(rows, [](const CollisionRow& r) { return r.query; })) {
    std::vector<CollisionRow> here;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(here),
                 [&](const CollisionRow& r) { return r.query == query; });
    text += query_text(query, here);
  }
  return text;
}

void write_json(const std::filesystem::path& file,
                const std::string& table,
                const std::string& bones,
                const std::vector<CollisionRow>& rows) {
  const Provenance p = provenance();
  nlohmann::ordered_json json{{"table", table},
                              {"bones", bones},
                              {"machine", p.machine},
                              {"compiler", p.compiler},
                              {"flags", p.flags},
                              {"commit", p.commit},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const CollisionRow& row : rows) {
    nlohmann::ordered_json r{{"case", row.pose_case},
                             {"query", row.query},
                             {"engine", row.engine},
                             {"is_peer", row.is_peer},
                             {"facets", row.facets}};
    if (row.original_vertices != 0) r["vertices"] = row.original_vertices;
    if (row.ran) {
      const Timing& t = row.timing;
      r["seconds"] = t.median;
      r["mean"] = t.mean;
      r["p99"] = t.p99;
      r["p999"] = t.p999;
      r["p99_one_pass"] = t.p99_one_pass;
      r["queries"] = t.queries;
      r["agrees"] = row.agrees;
      r["wrong"] = t.wrong;
      r["wrong_touching"] = t.wrong_near;
      r["unknown"] = t.unknown;
      if (row.query == "distance" || row.query == "depth") {
        r["largest_error_mm"] = t.largest_error_mm;
        r["missing"] = t.missing;
      }
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
