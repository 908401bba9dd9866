// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/hull/thesis_report.hpp"

#include <algorithm>
#include <cmath>

#include "core/text_format.hpp"

namespace carpus::bench {
namespace {

std::string name_cell(const ThesisRow& t) { return format("%-15s", std::string(t.name).c_str()); }

std::string count_cell(std::size_t count) {
  return count == 0 ? format("%7s", "-") : format("%7zu", count);
}

/// Here and in the thesis.
std::string count_cells(std::size_t here, std::size_t thesis, const char* mark = " ") {
  return count_cell(here) + count_cell(thesis) + mark;
}

std::string percent_cell(std::optional<double> share) {
  return share ? format("%7.1f", 100 * *share) : format("%7s", "-");
}

std::string sizes_text(const std::vector<ThesisBeside>& bones) {
  std::string text = format("%-15s%15s%15s%15s%15s%15s\n%-15s", "", "vertices ", "facets ",
                            "hull vertices ", "hull facets ", "stage 1 cuts % ", "bone");
  for (int i = 0; i < 5; ++i) text += "   here thesis ";
  text += "\n";
  for (const ThesisBeside& b : bones) {
    const ThesisRow& t = *b.thesis;
    const HullRow* any = b.quickhull;
    if (any == nullptr) continue;
    const bool is_misprint = t.hull_facets != 2 * t.hull_vertices - 4;
    std::optional<double> here;
    if (b.hybrid != nullptr) here = b.hybrid->discarded_share;
    std::optional<double> printed;
    if (t.left_by_stage_1 != 0) {
      printed = 1 - static_cast<double>(t.left_by_stage_1) / static_cast<double>(t.vertices);
    }
    const std::string note = note_on(any->origin, any->n);
    text += name_cell(t) + count_cells(any->n, t.vertices) +
            count_cells(any->origin.surface_facets, t.facets) +
            count_cells(any->h, t.hull_vertices) +
            count_cells(any->facets, t.hull_facets, is_misprint ? "*" : " ") + percent_cell(here) +
            percent_cell(printed) + (note.empty() ? "" : "   " + note) + "\n";
  }
  return text + "*: misprinted in the thesis, F = 2V - 4 does not hold\n";
}

std::string seconds_text(const std::vector<ThesisBeside>& bones) {
  std::string text = format("\n%-15s%20s%20s%20s%20s%16s\n%-15s", "", "gift wrapping ",
                            "quickhull ", "Chan ", "hybrid ", "brute force ", "bone");
  for (int i = 0; i < 4; ++i) text += "   here ms  thesis s";
  text += "       thesis s\n";
  const auto cells = [](const HullRow* here, double thesis) {
    return (here == nullptr ? format("%10s", "not run") : format("%10.2f", here->seconds * 1e3)) +
           format("%10.2f", thesis);
  };
  for (const ThesisBeside& b : bones) {
    const ThesisRow& t = *b.thesis;
    text += name_cell(t) + cells(b.gift_wrapping, t.gift_wrapping) +
            cells(b.quickhull, t.quickhull) + cells(b.chan, t.chan) + cells(b.hybrid, t.hybrid) +
            (t.brute_force > 0 ? format("%15.2f", t.brute_force) : format("%15s", "-")) + "\n";
  }
  return text;
}

std::string ratios_text(const std::vector<ThesisBeside>& bones) {
  std::string text = format("\n%-15s%18s%18s%18s\n%-15s", "hybrid's time:", "/ gift wrapping ",
                            "/ quickhull ", "/ Chan ", "bone");
  for (int i = 0; i < 3; ++i) text += "      here   thesis";
  text += "\n";
  for (const ThesisBeside& b : bones) {
    const ThesisRow& t = *b.thesis;
    text += name_cell(t);
    for (const auto& [other, printed] :
         {std::pair{b.gift_wrapping, t.gift_wrapping}, std::pair{b.quickhull, t.quickhull},
          std::pair{b.chan, t.chan}}) {
      const std::optional<double> here = ratio_of(b.hybrid, other);
      text += (here ? format("%10.2f", *here) : format("%10s", "-")) +
              format("%8.2f", t.hybrid / printed);
    }
    text += "\n";
  }
  return text;
}

std::string misprints_text(std::span<const ThesisRow> table) {
  std::string text;
  for (const PrintedGain& gain : misprinted_gains(table)) {
    const auto row = std::find_if(table.begin(), table.end(),
                                  [&](const ThesisRow& t) { return t.name == gain.bone; });
    text += format(
        "The thesis's text says that the hybrid saves %.2f %% of %s's time on the %s; its own "
        "table gives %.2f %%.\n",
        gain.percent, std::string(gain.engine).c_str(), std::string(gain.bone).c_str(),
        gain_of(*row, gain.other));
  }
  return text;
}

std::string chan_text(const std::vector<ThesisBeside>& bones) {
  int thesis_ahead = 0, ahead = 0, both_ran = 0;
  double least = 0, most = 0;
  for (const ThesisBeside& b : bones) {
    if (b.thesis->hybrid < b.thesis->chan) ++thesis_ahead;
    const std::optional<double> ratio = ratio_of(b.hybrid, b.chan);
    if (!ratio) continue;
    least = both_ran == 0 ? *ratio : std::min(least, *ratio);
    most = std::max(most, *ratio);
    ++both_ran;
    if (*ratio < 1) ++ahead;
  }
  if (both_ran == 0) return {};
  return format(
      "The thesis has the hybrid surpass Chan's algorithm in most cases, %d of %zu in this table; "
      "here it\n"
      "does in %d of %d, and takes %.2g to %.2g times Chan's time. What the hybrid wraps is nearly "
      "all points,\n"
      "n h steps however well compiled; Chan's wraps the hulls of groups, and finds each tangent "
      "by "
      "their\n"
      "hierarchies in the logarithm of their size: n log h.\n",
      thesis_ahead, bones.size(), ahead, both_ran, least, most);
}

}  // namespace

std::vector<ThesisBeside> beside_thesis(std::span<const ThesisRow> table,
                                        const std::vector<HullRow>& rows) {
  std::vector<ThesisBeside> bones;
  for (const ThesisRow& t : table) {
    ThesisBeside b{.thesis = &t};
    for (const HullRow& row : rows) {
      if (row.set != t.name || !row.ran) continue;
      if (row.engine == "gift_wrapping") b.gift_wrapping = &row;
      if (row.engine == "quickhull") b.quickhull = &row;
      if (row.engine == "chan") b.chan = &row;
      if (row.engine == "hybrid") b.hybrid = &row;
    }
    bones.push_back(b);
  }
  return bones;
}

std::optional<double> ratio_of(const HullRow* hybrid, const HullRow* other) {
  if (hybrid == nullptr || other == nullptr || !(other->seconds > 0)) return std::nullopt;
  return hybrid->seconds / other->seconds;
}

std::optional<double> thesis_seconds(const ThesisRow& row, const std::string& engine) {
  const double seconds = engine == "gift_wrapping" ? row.gift_wrapping
                         : engine == "quickhull"   ? row.quickhull
                         : engine == "chan"        ? row.chan
                         : engine == "hybrid"      ? row.hybrid
                         : engine == "brute_force" ? row.brute_force
                                                   : 0;
  return seconds > 0 ? std::optional(seconds) : std::nullopt;
}

std::string thesis_text(std::span<const ThesisRow> table, const std::vector<HullRow>& rows) {
  const std::vector<ThesisBeside> bones = beside_thesis(table, rows);
  return "\nBeside the thesis (its seconds include display; its machine is of 2008):\n" +
         sizes_text(bones) + seconds_text(bones) + ratios_text(bones) + misprints_text(table) +
         "Why they differ: the first stage removes what lies in a tetrahedron inscribed in the "
         "bone on\n"
         "either side; nearly every vertex of a closed surface lies outside it. What is left is "
         "wrapped\n"
         "at n h, so that the hybrid is as fast as gift wrapping, and quickhull, at about n log n, "
         "is\n"
         "faster than both by tens. That the thesis finds quickhull and gift wrapping alike may be "
         "due\n"
         "to what its seconds include besides the hull.\n" +
         chan_text(bones);
}

}  // namespace carpus::bench
