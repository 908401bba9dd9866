// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/section_report.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace carpus::cli {
namespace {

using Json = nlohmann::ordered_json;
using soft_tissue::BodyTurn;
using soft_tissue::HeldWrist;
using soft_tissue::MomentCurve;
using soft_tissue::PublishedStatement;
using soft_tissue::RestingWrist;
using soft_tissue::SectionedWrist;
using soft_tissue::SectioningResult;
using soft_tissue::SectioningTable;
using soft_tissue::StatementCheck;
using Kind = PublishedStatement::Kind;

template <typename... Values>
void print(std::string& out, const char* format, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  out += text.data();
}

std::string spaced(std::string id) {
  for (char& c : id) {
    if (c == '_') c = ' ';
  }
  return id;
}

const char* unit_of(Kind kind) {
  switch (kind) {
    case Kind::Share:
      return "%";
    case Kind::Stiffness:
      return "Nm/deg";
    default:
      return "deg";
  }
}

std::string name_of_cut(const SectioningTable& table, const std::string& id) {
  for (const auto& cut : table.cuts) {
    if (cut.id == id) return cut.name;
  }
  return id;
}

const char* verdict_of(const StatementCheck& check) {
  if (!check.is_measured) return "not measured";
  if (!check.is_reached) return "not reached";
  return check.statement->is_fitted ? "fitted" : "reached";
}

void print_capsule(std::string& out, const SectioningResult& result, const SectioningTable& table) {
  print(out, "capsule, mm longer than in the scan before it pulls:\n");
  for (std::size_t i = 0; i < table.capsule.size(); ++i) {
    const auto& line = table.capsule[i];
    print(out, "%6.1f  %s%s\n", result.capsule_slack_mm[i], line.name.c_str(),
          line.slack_mm ? "" : ": as the whole wrist's motion asks for");
  }
  out += "\n";
}

void print_curves(std::string& out, const SectioningResult& result, const SectioningTable& table) {
  print(out, "%-12s %-17s %6s %7s %7s %13s %13s %6s %7s %8s\n", "cut", "moment", "angle", "change",
        "Nm/deg", "scaphoid f/r", "lunate f/r", "gap mm", "SL deg", "left N");
  for (std::size_t d = 0; d < table.directions.size(); ++d) {
    for (const SectionedWrist& wrist : result.wrists) {
      const MomentCurve& c = wrist.curves[d];
      const RestingWrist& w = c.steps.back();
      print(out, "%-12s %-17s %6.1f %+7.1f %7.2f %6.1f %6.1f %6.1f %6.1f %6.1f %7.1f %8.2f%s\n",
            name_of_cut(table, wrist.cut).c_str(), spaced(c.direction).c_str(), c.range_deg,
            c.range_deg - result.wrists.front().curves[d].range_deg, c.stiffness_nm_per_deg,
            w.scaphoid.flexion_deg, w.scaphoid.radial_deviation_deg, w.lunate.flexion_deg,
            w.lunate.radial_deviation_deg, w.gap_mm, w.sl_angle_deg(), w.left_n,
            w.is_settled ? "" : "  no rest found");
    }
  }
}

void print_held(std::string& out, const SectioningResult& result, const SectioningTable& table) {
  print(out, "\nthe hand held, from the scan; it may twist\n");
  print(out, "%-12s %-17s %13s %13s %6s %7s %8s\n", "cut", "position", "scaphoid f/r", "lunate f/r",
        "gap mm", "SL deg", "left N");
  for (std::size_t p = 0; p < table.positions.size(); ++p) {
    for (const SectionedWrist& wrist : result.wrists) {
      const RestingWrist& w = wrist.held[p].wrist;
      print(out, "%-12s %-17s %6.1f %6.1f %6.1f %6.1f %6.1f %7.1f %8.2f%s\n",
            name_of_cut(table, wrist.cut).c_str(), spaced(wrist.held[p].position).c_str(),
            w.scaphoid.flexion_deg, w.scaphoid.radial_deviation_deg, w.lunate.flexion_deg,
            w.lunate.radial_deviation_deg, w.gap_mm, w.sl_angle_deg(), w.left_n,
            w.is_settled ? "" : "  no rest found");
    }
  }
}

void print_published(std::string& out,
                     const SectioningResult& result,
                     const SectioningTable& table) {
  print(out, "\n%10s %-7s %-12s  %s\n", "ours", "", "", "published");
  for (const StatementCheck& check : soft_tissue::compare_with_published(result, table)) {
    const PublishedStatement& s = *check.statement;
    const int digits = s.kind == Kind::Stiffness ? 2 : 1;
    print(out, "%10.*f %-7s %-12s  ", digits, check.ours, unit_of(s.kind), verdict_of(check));
    out += s.published + " " + s.mark + "\n";
    if (check.is_measured && !check.is_reached && !s.why_not.empty()) {
      out += std::string(33, ' ') + "on the demo: " + s.why_not + "\n";
    }
  }
}

Json json_of(const BodyTurn& turn) {
  return {{"twist_deg", turn.twist_deg},
          {"flexion_deg", turn.flexion_deg},
          {"radial_deviation_deg", turn.radial_deviation_deg}};
}

Json json_of(const RestingWrist& w) {
  return {{"moment_nm", w.moment_nm},
          {"hand", json_of(w.hand)},
          {"scaphoid", json_of(w.scaphoid)},
          {"lunate", json_of(w.lunate)},
          {"triquetrum", json_of(w.triquetrum)},
          {"gap_mm", w.gap_mm},
          {"sl_angle_deg", w.sl_angle_deg()},
          {"left_n", w.left_n},
          {"left_nmm", w.left_nmm},
          {"is_settled", w.is_settled}};
}

}  // namespace

std::string section_table(const SectioningResult& result, const SectioningTable& table) {
  std::string out;
  print(out,
        "\nligaments cut: %.1f Nm on the hand, free otherwise, pressed by %.0f N; turns from the "
        "scan, deg,\nflexion and radial deviation positive; simulated\n",
        table.moment_nm, table.press_n);
  print_capsule(out, result, table);
  print_curves(out, result, table);
  print_held(out, result, table);
  print_published(out, result, table);
  print(out, "\n%zu rests, %zu not found; left over in the others at most %.2f N and %.1f N mm\n",
        result.rests, result.unsettled, result.worst_left_n, result.worst_left_nmm);
  return out;
}

std::string section_json(const SectioningResult& result,
                         const SectioningTable& table,
                         std::string_view pseudonym,
                         bool is_simulated) {
  Json json;
  json["case"] = pseudonym;
  json["case_simulated"] = is_simulated;
  json["moment_nm"] = table.moment_nm;
  json["press_n"] = table.press_n;
  json["capsule"] = Json::array();
  for (std::size_t i = 0; i < table.capsule.size(); ++i) {
    json["capsule"].push_back(
        {{"name", table.capsule[i].name}, {"slack_mm", result.capsule_slack_mm[i]}});
  }
  json["cuts"] = Json::array();
  for (const SectionedWrist& wrist : result.wrists) {
    Json cut{{"id", wrist.cut}, {"name", name_of_cut(table, wrist.cut)}};
    cut["curves"] = Json::array();
    for (const MomentCurve& c : wrist.curves) {
      Json steps = Json::array();
      for (const RestingWrist& w : c.steps) steps.push_back(json_of(w));
      cut["curves"].push_back({{"direction", c.direction},
                               {"range_deg", c.range_deg},
                               {"stiffness_nm_per_deg", c.stiffness_nm_per_deg},
                               {"steps", steps}});
    }
    cut["held"] = Json::array();
    for (const HeldWrist& h : wrist.held) {
      Json held = json_of(h.wrist);
      held["position"] = h.position;
      held.erase("moment_nm");
      cut["held"].push_back(held);
    }
    json["cuts"].push_back(cut);
  }
  json["published"] = Json::array();
  for (const StatementCheck& check : soft_tissue::compare_with_published(result, table)) {
    const PublishedStatement& s = *check.statement;
    json["published"].push_back({{"id", s.id},
                                 {"published", s.published},
                                 {"mark", s.mark},
                                 {"ours", check.is_measured ? Json(check.ours) : Json(nullptr)},
                                 {"unit", unit_of(s.kind)},
                                 {"verdict", verdict_of(check)}});
  }
  json["rests"] = result.rests;
  json["unsettled"] = result.unsettled;
  json["worst_left_n"] = result.worst_left_n;
  json["worst_left_nmm"] = result.worst_left_nmm;
  return json.dump(1) + "\n";
}

}  // namespace carpus::cli
