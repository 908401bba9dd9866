// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/collision/report.hpp"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "bench/output_file.hpp"
#include "bench/provenance.hpp"
#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

constexpr int kCell = 26;

/// In microseconds, four digits.
std::string micro(double seconds) {
  const double us = seconds * 1e6;
  return format("%.*f", us < 10 ? 3 : us < 100 ? 2 : us < 1000 ? 1 : 0, us);
}

std::string cell(const CollisionRow* row) {
  if (row == nullptr) return format("%*s", kCell, "");
  if (!row->ran) return format("%*s", kCell, "not run ");
  const Timing& t = row->timing;
  return format(
      "%*s", kCell,
      (micro(t.mean) + " / " + micro(t.median) + " / " + micro(t.p99) + (row->agrees ? " " : "!"))
          .c_str());
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

using Figure = double Timing::*;

/// The fastest by that figure among ours that agree, or among the peers.
const CollisionRow* fastest(const std::vector<const CollisionRow*>& rows,
                            bool peers,
                            Figure figure) {
  const CollisionRow* best = nullptr;
  for (const CollisionRow* row : rows) {
    if (!row->ran || row->is_peer != peers || (!peers && !row->agrees)) continue;
    if (best == nullptr || row->timing.*figure < best->timing.*figure) best = row;
  }
  return best;
}

/// Ours that agree, of those names.
const CollisionRow* fastest_named(const std::vector<const CollisionRow*>& rows,
                                  std::initializer_list<std::string_view> names) {
  std::vector<const CollisionRow*> named;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(named), [&](const CollisionRow* r) {
    return std::find(names.begin(), names.end(), r->engine) != names.end();
  });
  return fastest(named, false, &Timing::mean);
}

/// How many times as fast: "12.3", below one "0.45", "0.023".
std::string times(double ratio) {
  return format("%.*f times as fast as", ratio < 0.1 ? 3 : ratio < 1 ? 2 : 1, ratio);
}

std::string against_peers(const std::string& column, const std::vector<const CollisionRow*>& rows) {
  std::string text;
  for (const auto& [name, figure] : {std::pair<const char*, Figure>{"mean", &Timing::mean},
                                     {"median", &Timing::median},
                                     {"p99", &Timing::p99}}) {
    const CollisionRow* own = fastest(rows, false, figure);
    const CollisionRow* peer = fastest(rows, true, figure);
    if (own == nullptr || peer == nullptr) return {};
    text +=
        format("%s by %s %s is %s %s", text.empty() ? "" : ";", name, own->engine.c_str(),
               times(peer->timing.*figure / (own->timing.*figure)).c_str(), peer->engine.c_str());
  }
  return format("%-20s", column.c_str()) + text + "\n";
}

/// The thesis's program against our own GJK.
std::string against_gjk(const std::string& column, const std::vector<const CollisionRow*>& rows) {
  const bool is_tick = rows.front()->query == "tick_boolean";
  if (!is_tick && rows.front()->query != "boolean") return {};
  const CollisionRow* growth =
      is_tick ? fastest_named(rows, {"growth_scene", "scene:lp_growth", "lp_growth"})
              : fastest_named(rows, {"lp_growth"});
  const CollisionRow* gjk = is_tick ? fastest_named(rows, {"scene:gjk_table", "gjk_table", "gjk"})
                                    : fastest_named(rows, {"gjk_table", "gjk"});
  if (growth == nullptr || gjk == nullptr) return {};
  return format("%-20s by mean %s is %s our own %s\n", column.c_str(), growth->engine.c_str(),
                times(gjk->timing.mean / growth->timing.mean).c_str(), gjk->engine.c_str());
}

std::string query_text(const std::string& query, const std::vector<CollisionRow>& rows) {
  const auto columns = distinct(rows, [](const CollisionRow& r) { return r.pose_case; });
  const auto engines = distinct(rows, [](const CollisionRow& r) { return r.engine; });
  std::string text = format("%s: mean / median / p99, microseconds\n%-20s", query.c_str(), "");
  for (const std::string& c : columns) text += format("%*s ", kCell - 1, c.c_str());
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
    text += against_peers(column, here) + against_gjk(column, here);
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
    if (row.original_facets != 0) r["surface_facets"] = row.original_facets;
    if (row.hull_vertices != 0) r["hull_vertices"] = row.hull_vertices;
    if (row.thesis_seconds != 0) r["thesis_seconds"] = row.thesis_seconds;
    if (row.ran) {
      const Timing& t = row.timing;
      r["seconds"] = t.mean;  // what a course of queries costs, of which a few need the most
      r["median"] = t.median;
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
  write_text(file, json.dump(1) + "\n");
}

}  // namespace carpus::bench
