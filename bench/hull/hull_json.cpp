// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/hull_json.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "bench/hull/growth.hpp"
#include "bench/hull/thesis_report.hpp"
#include "bench/provenance.hpp"

namespace carpus::bench {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(std::optional<double> value) { return value ? Json(*value) : Json(nullptr); }

/// Where the points come from.
void describe(const HullRow& row, Json& r) {
  const Origin& o = row.origin;
  if (o.source.empty()) return;
  r["source"] = o.source;
  r["is_stand_in"] = o.is_stand_in;
  r["surface_facets"] = o.surface_facets != 0 ? Json(o.surface_facets) : nullptr;
  if (o.thesis_points == 0) return;
  r["thesis_n"] = o.thesis_points;
  r["has_thesis_n"] = has_thesis_count(o, row.n);
}

Json json_of_row(const HullRow& row, std::span<const ThesisRow> thesis) {
  Json r{{"case", row.set}, {"n", row.n}, {"h", row.h}, {"engine", row.engine}};
  describe(row, r);
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
  for (const ThesisRow& t : thesis) {
    const std::optional<double> seconds = thesis_seconds(t, row.engine);
    if (t.name == row.set && seconds) r["thesis_seconds"] = *seconds;
  }
  return r;
}

Json json_of_bone(const ThesisBeside& b) {
  const ThesisRow& t = *b.thesis;
  Json bone{{"case", t.name},
            {"n", t.vertices},
            {"surface_facets", t.facets},
            {"h", t.hull_vertices},
            {"hull_facets", t.hull_facets},
            {"left_by_stage_1", t.left_by_stage_1 != 0 ? Json(t.left_by_stage_1) : nullptr}};
  const auto compare = [&](const HullRow* other, double thesis_seconds) {
    return Json{{"here", number_or_null(ratio_of(b.hybrid, other))},
                {"thesis", t.hybrid / thesis_seconds}};
  };
  bone["hybrid_over"] = {{"gift_wrapping", compare(b.gift_wrapping, t.gift_wrapping)},
                         {"quickhull", compare(b.quickhull, t.quickhull)},
                         {"chan", compare(b.chan, t.chan)}};
  return bone;
}

Json json_of_growth(const Growth& g) {
  Json steps = Json::array();
  const std::vector<double> exponents = g.steps();
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    steps.push_back({{"from_n", static_cast<std::size_t>(g.samples[i].count)},
                     {"to_n", static_cast<std::size_t>(g.samples[i + 1].count)},
                     {"exponent", exponents[i]}});
  }
  return {{"case", g.set},
          {"engine", g.engine},
          {"exponent", exponent_of(g.samples)},
          {"n_log_n_exponent", n_log_n_exponent(g.samples)},
          {"steps", steps}};
}

}  // namespace

std::string json_of(const HullReport& report) {
  const Provenance p = provenance();
  Json json{{"table", report.table},  {"bones", report.bones}, {"machine", p.machine},
            {"compiler", p.compiler}, {"flags", p.flags},      {"commit", p.commit}};
  for (const ThesisBeside& bone : beside_thesis(report.thesis, report.rows))
    json["thesis"].push_back(json_of_bone(bone));
  if (report.table == "distributions") {
    json["growth"] = Json::array();
    for (const Growth& g : growth_with_points(report.rows))
      json["growth"].push_back(json_of_growth(g));
  }
  json["rows"] = Json::array();
  for (const HullRow& row : report.rows) json["rows"].push_back(json_of_row(row, report.thesis));
  return json.dump(1) + "\n";
}

}  // namespace carpus::bench
