// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/thesis_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/thesis_page.hpp"
#include "core/error.hpp"
#include "core/text_format.hpp"

namespace carpus::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string seconds_in_words(double s) {
  if (s < 1e-3) return format("%.3g µs", s * 1e6);
  if (s < 1) return format("%.3g ms", s * 1e3);
  if (s < 7200) return format("%.4g s", s);
  if (s < 86400 * 3) return format("%.3g h", s / 3600);
  return format("%.3g days", s / 86400);
}

std::string cell(const std::string& text, bool is_printed = false) {
  return std::string(is_printed ? "<td class=\"printed\">" : "<td>") + escaped(text) + "</td>";
}

std::string printed_cell(const Json& value) {
  return cell(value.is_number() ? format("%.10g", value.get<double>()) : "–", true);
}

const Json* row_of(const Json& rows, std::string_view name, std::string_view engine) {
  for (const Json& row : rows) {
    if (row.at("case").get<std::string>() == name &&
        row.at("engine").get<std::string>() == engine) {
      return &row;
    }
  }
  return nullptr;
}

/// Measured seconds, marked where the answer was another.
std::string here(const Json* row) {
  if (row == nullptr || !row->at("seconds").is_number()) return cell("not run");
  return cell(seconds_in_words(row->at("seconds").get<double>()) +
              (row->at("agrees").get<bool>() ? "" : " !"));
}

std::string printed_seconds(const Json* row) {
  if (row == nullptr || !row->contains("thesis_seconds")) return cell("–", true);
  return cell(format("%.8g s", row->at("thesis_seconds").get<double>()), true);
}

std::string under_heads(const std::vector<std::string>& heads) {
  std::string html = "<tr><th rowspan=\"2\">3-D model</th>";
  for (const std::string& head : heads) html += "<th colspan=\"2\">" + head + "</th>";
  html += "</tr>\n<tr>";
  for (std::size_t i = 0; i < heads.size(); ++i) html += "<th>printed</th><th>here</th>";
  return html + "</tr>\n";
}

std::string machine_of(const Json& bench) {
  return escaped(bench.at("machine").get<std::string>() + ", " +
                 bench.at("compiler").get<std::string>() + ", one thread; " +
                 (bench.at("bones").get<std::string>().empty()
                      ? std::string("bones of the parametric wrist (simulated)")
                      : "bones of " + bench.at("bones").get<std::string>()));
}

template <typename Make>
std::string made(const char* what, Make make) {
  try {
    return make();
  } catch (const nlohmann::json::exception& error) {
    throw InvalidInput(std::string(what) + " has another form than expected: " + error.what());
  }
}

constexpr std::array<std::pair<const char*, const char*>, 5> kAlgorithms{{
    {"brute_force", "Brute force"},
    {"gift_wrapping", "Gift wrapping"},
    {"quickhull", "QuickHull"},
    {"chan", "Chan"},
    {"hybrid", "Hybrid"},
}};

std::string brute_force_here(const Json* row, const PowerLaw& law, double n) {
  if (row != nullptr && row->at("seconds").is_number()) return here(row);
  if (law.exponent <= 0) return cell("not run");
  return cell("≈ " + seconds_in_words(law.factor * std::pow(n, law.exponent)) + " (not run)");
}

}  // namespace

PowerLaw fit_power(const std::vector<std::pair<double, double>>& n_and_seconds) {
  const auto count = static_cast<double>(n_and_seconds.size());
  if (n_and_seconds.size() < 2) return {};
  double sum_x = 0;
  double sum_y = 0;
  double sum_xx = 0;
  double sum_xy = 0;
  for (const auto& [n, s] : n_and_seconds) {
    const double x = std::log(n);
    const double y = std::log(s);
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  const double spread = count * sum_xx - sum_x * sum_x;
  if (spread <= 0) return {};
  const double k = (count * sum_xy - sum_x * sum_y) / spread;
  return {std::exp((sum_y - k * sum_x) / count), k};
}

namespace {

/// One bone of a table of hulls, in print and here.
struct HullEntry {
  const Json& printed;
  std::string name;
  const Json& hybrid;  ///< its row; what counts vertices here
};

std::vector<HullEntry> hull_entries(const Json& bench) {
  std::vector<HullEntry> entries;
  for (const Json& bone : bench.at("thesis")) {
    const auto name = bone.at("case").get<std::string>();
    if (const Json* row = row_of(bench.at("rows"), name, "hybrid")) {
      entries.push_back({bone, name, *row});
    }
  }
  return entries;
}

std::string counts_table(const Json& bench) {
  std::string html = "<table>\n<caption>" + machine_of(bench) + "</caption>\n" +
                     under_heads({"vertices", "facets", "hull vertices", "hull facets"});
  for (const HullEntry& e : hull_entries(bench)) {
    std::string title = escaped(e.name);
    if (e.hybrid.contains("is_stand_in") && e.hybrid.at("is_stand_in").get<bool>()) {
      title += " (here: " + escaped(e.hybrid.at("source").get<std::string>()) + ")";
    }
    const double h = e.hybrid.at("h").get<double>();
    const Json& facets = e.hybrid.at("surface_facets");
    html += "<tr><td>" + title + "</td>" + printed_cell(e.printed.at("n")) +
            cell(e.hybrid.at("n").dump()) + printed_cell(e.printed.at("surface_facets")) +
            cell(facets.is_number() ? facets.dump() : "–") + printed_cell(e.printed.at("h")) +
            cell(format("%.0f", h)) + printed_cell(e.printed.at("hull_facets")) +
            cell(format("%.0f", 2 * h - 4)) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string times_table(const Json& bench, const PowerLaw& brute_force) {
  const Json& rows = bench.at("rows");
  const std::vector<HullEntry> entries = hull_entries(bench);
  const auto is_printed = [&](std::string_view engine) {
    return std::any_of(entries.begin(), entries.end(), [&](const HullEntry& e) {
      const Json* row = row_of(rows, e.name, engine);
      return row != nullptr && row->contains("thesis_seconds");
    });
  };
  std::vector<std::string> heads;
  for (const auto& [engine, words] : kAlgorithms) {
    if (is_printed(engine)) heads.emplace_back(words);
  }
  std::string html = "<table>\n" + under_heads(heads);
  for (const HullEntry& e : entries) {
    html += "<tr><td>" + escaped(e.name) + "</td>";
    for (const auto& [engine, words] : kAlgorithms) {
      if (!is_printed(engine)) continue;
      const Json* row = row_of(rows, e.name, engine);
      html += printed_seconds(row);
      html += std::string_view(engine) == "brute_force"
                  ? brute_force_here(row, brute_force, e.hybrid.at("n").get<double>())
                  : here(row);
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string ratios_table(const Json& bench) {
  std::string html =
      "<table>\n<caption>Time of the hybrid method over that of another</caption>\n" +
      under_heads({"÷ gift wrapping", "÷ QuickHull", "÷ Chan"});
  for (const HullEntry& e : hull_entries(bench)) {
    html += "<tr><td>" + escaped(e.name) + "</td>";
    for (const char* other : {"gift_wrapping", "quickhull", "chan"}) {
      const Json& ratio = e.printed.at("hybrid_over").at(other);
      html += cell(format("%.2f", ratio.at("thesis").get<double>()), true);
      html +=
          cell(ratio.at("here").is_number() ? format("%.2f", ratio.at("here").get<double>()) : "–");
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::string hull_table_html(const Json& bench) {
  return made("the table of hulls", [&] {
    std::vector<std::pair<double, double>> parts;
    for (const Json& row : bench.at("rows")) {
      if (row.at("engine") == "brute_force" && row.at("seconds").is_number()) {
        parts.emplace_back(row.at("n").get<double>(), row.at("seconds").get<double>());
      }
    }
    const PowerLaw law = fit_power(parts);
    std::string html = counts_table(bench) + times_table(bench, law);
    if (law.exponent > 0) {
      html += "<p class=\"note\">Brute force ran on parts of a bone:";
      for (const auto& [n, s] : parts) {
        html += format(" %.0f points in ", n) + escaped(seconds_in_words(s)) + ",";
      }
      html += format(
          " which grows as n<sup>%.1f</sup>. What stands in its column is that law taken to the "
          "bone's count, not a run.</p>\n",
          law.exponent);
    }
    return html + ratios_table(bench);
  });
}

std::string collision_table_html(const Json& bench) {
  return made("the table of collisions", [&] {
    const Json& rows = bench.at("rows");
    std::string html = "<table>\n<caption>" + machine_of(bench) +
                       "; mean of cold queries</caption>\n<tr><th rowspan=\"2\">3-D model</th>"
                       "<th rowspan=\"2\">vertices</th><th rowspan=\"2\">hull facets</th>"
                       "<th colspan=\"2\">Proposed</th><th colspan=\"2\">IVRI-CD</th>"
                       "<th colspan=\"2\">Proposed ÷ IVRI-CD</th>"
                       "<th rowspan=\"2\">our best program</th></tr>\n<tr>";
    for (int i = 0; i < 3; ++i) html += "<th>printed</th><th>here</th>";
    html += "</tr>\n";
    for (const Json& row : rows) {
      if (row.at("engine") != "lp_scan" || !row.contains("thesis_seconds")) continue;
      const auto name = row.at("case").get<std::string>();
      if (name.ends_with(" warm")) continue;
      const Json* ivri = row_of(rows, name, "ivri_all_vertices");
      const Json* best = nullptr;
      for (const Json& other : rows) {
        if (other.at("case") != name || !other.at("seconds").is_number() ||
            !other.at("agrees").get<bool>() ||
            !other.at("engine").get<std::string>().starts_with("lp_")) {
          continue;
        }
        if (best == nullptr ||
            other.at("seconds").get<double>() < best->at("seconds").get<double>()) {
          best = &other;
        }
      }
      html += "<tr><td>" + escaped(name) + "</td>" + cell(row.at("vertices").dump()) +
              cell(format("%.0f", row.at("facets").get<double>())) + printed_seconds(&row) +
              here(&row) + printed_seconds(ivri) + here(ivri);
      const bool both = ivri != nullptr && ivri->contains("thesis_seconds") &&
                        ivri->at("seconds").is_number() && row.at("seconds").is_number();
      html += cell(both ? format("%.2f", row.at("thesis_seconds").get<double>() /
                                             ivri->at("thesis_seconds").get<double>())
                        : "–",
                   true);
      html += cell(
          both ? format("%.2f", row.at("seconds").get<double>() / ivri->at("seconds").get<double>())
               : "–");
      html += cell(best != nullptr ? best->at("engine").get<std::string>() + ", " +
                                         seconds_in_words(best->at("seconds").get<double>())
                                   : "–");
      html += "</tr>\n";
    }
    return html +
           "</table>\n<p class=\"note\">! marks a row whose answers differ from exact "
           "arithmetic somewhere.</p>\n";
  });
}

}  // namespace carpus::cli
