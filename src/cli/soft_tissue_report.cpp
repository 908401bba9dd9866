// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/soft_tissue_report.hpp"

#include <array>
#include <cstdio>

#include "arthroscopy/disc_table.hpp"
#include "arthroscopy/yielding_figures.hpp"

namespace carpus::cli {
namespace {

template <typename... Values>
void print(std::string& out, const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  out += text.data();
}

std::string bone_name(const cases::CaseData& data, std::uint8_t label) {
  for (const cases::Bone& bone : data.bones) {
    if (bone.label == label) return std::string(name_of(bone.bone, bone.part));
  }
  return "?";
}

}  // namespace

std::string soft_tissue_table(const soft_tissue::SoftTissue& tissue, const cases::CaseData& data) {
  std::string out;
  print(out, "size %.3f of the generic wrist, worst fit of a bone %.2f mm rms\n", tissue.size,
        tissue.worst_misfit_mm);
  print(out, "generated, not seen in the CT; ranges: published or proposed, times the size;\n");
  print(out, "N/mm: of all strands, as published or proposed, for no measured range is known\n\n");
  print(out, "%-18s %9s %15s %9s %15s %7s %8s %8s %6s\n", "ligament", "length mm", "range",
        "thick mm", "range", "width", "straight", "strands", "N/mm");
  for (const soft_tissue::Ligament& l : tissue.ligaments) {
    double n_per_mm = 0;
    for (const soft_tissue::Strand& s : l.strands) n_per_mm += s.stiffness_n_per_mm;
    print(out, "%-18s %9.1f %7.1f to %4.1f %9.2f %7.2f to %4.2f %7.1f %8.1f %8zu %6.1f\n",
          l.id.c_str(), l.length_mm, l.length_range_mm.low, l.length_range_mm.high,
          l.measured_thickness_mm, l.thickness_range_mm.low, l.thickness_range_mm.high, l.width_mm,
          l.straight_mm, l.strands.size(), n_per_mm);
  }
  if (!tissue.disc.body.facets.empty()) {
    print(out, "%-18s %9s %15s %9.2f %7.2f to %4.2f\n", "disc", "", "",
          tissue.disc.measured_thickness_mm, tissue.disc.thickness_range_mm.low,
          tissue.disc.thickness_range_mm.high);
  }
  print(out, "\n%-20s %9s %8s %8s %15s\n", "cartilage", "area mm2", "mean mm", "most mm", "range");
  for (const soft_tissue::Cartilage& c : tissue.cartilage) {
    print(out, "%-20s %9.0f %8.2f %8.2f %7.2f to %4.2f\n", bone_name(data, c.label).c_str(),
          c.area_mm2, c.mean_thickness_mm, c.greatest_thickness_mm, c.thickness_range_mm.low,
          c.thickness_range_mm.high);
  }
  for (const soft_tissue::Cartilage& c : tissue.cartilage) {
    if (!(c.pressed_area_mm2 > 0)) continue;
    print(out, "%s: %.0f %% of it pressed by what lies displaced, there %.2f mm in the mean\n",
          bone_name(data, c.label).c_str(), 100 * c.pressed_area_mm2 / c.area_mm2,
          c.pressed_thickness_mm);
  }
  print(out, "\n%-30s %10s %8s\n", "space", "volume mm3", "facets");
  for (const soft_tissue::Space& s : tissue.spaces) {
    print(out, "%-30s %10.0f %8zu\n", s.name.c_str(), s.volume_mm3, s.surface.facets.size());
  }
  print(out, "\ndeepest in bone %.3f mm, of one tissue in another %.2f mm\n",
        tissue.deepest_in_bone_mm, tissue.deepest_in_other_mm);
  for (const std::string& problem : tissue.problems) out += "problem: " + problem + "\n";
  return out;
}

std::string portal_table(const cases::ArthroscopicMap& map, const cases::CaseData& data) {
  std::string out;
  print(out, "\nportals under traction; beside the way's middle line, mm to the surface of\n");
  print(out, "%-6s %-12s %8s %11s  %-26s  %-26s  %s\n", "portal", "joint", "room mm", "capsule mm",
        "tendon", "artery", "nerve");
  for (const cases::Portal& portal : map.portals) {
    print(out, "%-6s %-12s %8.2f %11.1f", portal.id.c_str(), map.joints[portal.joint].id.c_str(),
          portal.room_mm, portal.capsule_mm);
    for (const auto& beside : portal.beside) {
      if (beside) {
        const std::string& name = data.structures[beside->structure].id;
        print(out, "  %5.2f %-20s", beside->mm, name.c_str());
      } else {
        print(out, "  %-26s", "none");
      }
    }
    out.erase(out.find_last_not_of(' ') + 1);
    out += "\n";
  }
  for (const std::string& problem : map.problems) out += "problem: " + problem + "\n";
  return out;
}

std::string yielding_table(const cases::CaseData& data, const cases::ArthroscopicMap& map) {
  std::string out;
  const auto& published = arthroscopy::DiscTable::generic().published;
  print(out, "\nthe disc under a probe's 1 N; mm; published [S78] in brackets\n");
  print(out, "%-16s %18s %18s %22s %10s\n", "", "pressed, middle", "rests off by",
        "lifted by its edge", "particles");
  for (const arthroscopy::DiscFigures& f : arthroscopy::disc_figures(data, map)) {
    print(out, "%-16s %11.2f (%.1f) %11.1f (%.1f) %22.2f %10zu\n",
          f.has_come_off ? "off the fovea" : "whole", f.press_mm,
          f.has_come_off ? published.pressed_off_mm : published.pressed_whole_mm, f.rests_off_mm,
          f.has_come_off ? published.rests_off_mm : 0.0, f.lifted_mm, f.particles);
  }
  print(out, "\nligaments under a probe's 1 N in their middle; mm, and N/mm along the fibres\n");
  print(out, "%-16s %6s %8s %9s %11s %7s %8s %9s %11s %10s\n", "sheet", "grade", "pressed",
        "fitted to", "from behind", "bulge", "along", "of fibres", "whole, B10", "particles");
  for (const arthroscopy::BandFigures& f : arthroscopy::band_figures(map)) {
    print(out, "%-16s %6s %8.2f %9.2f %11.2f %7.2f %8.0f %9.0f %11.0f %10zu\n", f.band.c_str(),
          f.grade.c_str(), f.press_mm, f.wanted_mm.value_or(0), f.press_behind_mm, f.bulge_mm,
          f.along_n_per_mm, f.fibres_n_per_mm, f.whole_n_per_mm, f.particles);
  }
  print(out, "\nthe intervals behind them, from the midcarpal joint, under full traction; mm\n");
  print(out, "%-16s %6s %8s %14s %14s %18s\n", "ligament", "grade", "gap", "1.0 mm probe",
        "2.7 mm scope", "deep, to ligament");
  for (const arthroscopy::IntervalFigures& f : arthroscopy::interval_figures(data, map)) {
    print(out, "%-16s %6s %8.2f %14.1f %14.1f %18.1f\n", f.band.c_str(), f.grade.c_str(), f.gap_mm,
          f.probe_mm, f.scope_mm, f.deep_mm);
  }
  return out;
}

std::string soft_tissue_line(const soft_tissue::SoftTissue& tissue) {
  std::string out;
  print(out,
        "%zu ligaments, %zu of cartilage, %s, %zu joint spaces; deepest in bone %.2f mm; "
        "%zu pairs of tissues in each other by up to %.2f mm",
        tissue.ligaments.size(), tissue.cartilage.size(),
        tissue.disc.body.facets.empty() ? "no disc" : "disc", tissue.spaces.size(),
        tissue.deepest_in_bone_mm, tissue.overlaps.size(), tissue.deepest_in_other_mm);
  return out;
}

}  // namespace carpus::cli
