// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "view_trainer/view_study.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace carpus::view_trainer {
namespace {

bool says_out(const StudiedScrew& screw, const std::vector<std::size_t>& views, Reading reading) {
  return std::any_of(views.begin(), views.end(), [&](std::size_t view) {
    const Overhang& overhang = screw.overhangs.at(view);
    return (reading == Reading::OnThePicture ? overhang.read_mm : overhang.true_mm) >= kRevealedMm;
  });
}

/// On the longest line, 20 mm long or as near as there is, its end so far beyond a pole.
PlacedScrew screw_at_pole(const cases::CaseData& data, Region pole, double beyond_mm) {
  const cases::AxisSegment& axis = data.scaphoid.longest_line;
  const Vec3 line = normalized_or(axis.distal - axis.proximal, {0, 0, 1});
  PlacedScrew placed;
  double nearest = 1e9;
  const auto all = instruments::catalogue();
  const double wished = std::min(20.0, distance(axis.proximal, axis.distal) - 4.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double off = std::abs(all[i].length_mm - wished);
    if (all[i].work != instruments::Work::Thread || off >= nearest) continue;
    nearest = off;
    placed.screw = static_cast<instruments::InstrumentIndex>(i);
  }
  if (placed.screw == instruments::kNoInstrument) {
    throw InvalidInput("view trainer: the catalogue has no screw");
  }
  // Its tip leads, as in an operation.
  placed.shaft = pole == Region::Distal ? -line : line;
  placed.tip =
      pole == Region::Distal ? axis.distal + line * beyond_mm : axis.proximal - line * beyond_mm;
  return placed;
}

FirstRevealed first_revealed(const ScaphoidSurface& scaphoid, const CaseViews& views, Region pole) {
  constexpr double kStepMm = 0.1;
  constexpr double kFarthestMm = 5.0;
  FirstRevealed first;
  first.region = pole;
  first.depth_mm.resize(views.views().size());
  for (double beyond = -3.0; beyond <= kFarthestMm; beyond += kStepMm) {
    const PlacedScrew placed = screw_at_pole(scaphoid.data(), pole, beyond);
    std::optional<double> depth;
    for (std::size_t i = 0; i < first.depth_mm.size(); ++i) {
      if (first.depth_mm[i] || views.overhang_of(placed, i).true_mm < kRevealedMm) continue;
      if (!depth) depth = scaphoid.protrusion_of(placed).depth_mm;
      first.depth_mm[i] = depth;
    }
  }
  return first;
}

}  // namespace

StudiedCase study_case(const cases::CaseData& data,
                       std::size_t case_index,
                       std::uint64_t first_seed,
                       std::size_t seeds) {
  const ScaphoidSurface scaphoid(data);
  const auto standard = standard_views();
  std::vector<StandardView> seen(standard.begin(), standard.end());
  seen.push_back(pa_extended_view());
  CaseViews views(scaphoid, seen);
  fluoroscopy::ComposedRenderer renderer = make_renderer(data);
  views.read_outlines(renderer);
  StudiedCase studied;
  studied.pseudonym = data.pseudonym;
  for (std::size_t i = 0; i < standard.size(); ++i) {
    studied.reading_errors.push_back(reading_error(*views.at(i).read, views.at(i).truth));
  }
  for (const Region pole : {Region::Distal, Region::Proximal}) {
    studied.first_revealed.push_back(first_revealed(scaphoid, views, pole));
  }
  studied.screws.resize(seeds);
  parallel_for(seeds, 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      StudiedScrew& screw = studied.screws[i];
      const GeneratedScrew made = generate_screw(scaphoid, first_seed + i);
      screw.case_index = case_index;
      screw.seed = first_seed + i;
      screw.truth = made.truth;
      for (std::size_t view = 0; view < standard.size(); ++view) {
        screw.overhangs.push_back(views.overhang_of(made.placed, view));
      }
    }
  });
  return studied;
}

std::vector<std::vector<std::size_t>> view_sets() {
  std::vector<std::vector<std::size_t>> sets;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < standard_views().size(); ++i) {
    sets.push_back({i});
    all.push_back(i);
  }
  const std::size_t pa = view_index("pa");
  const std::size_t lateral = view_index("lateral");
  const std::size_t oblique = view_index("oblique_45_pronated");
  const std::size_t skyline = view_index("skyline");
  sets.push_back({pa, lateral});
  sets.push_back({pa, lateral, oblique});
  sets.push_back({pa, lateral, oblique, skyline});
  sets.push_back(all);
  return sets;
}

StudyRow row_of(const std::vector<StudiedScrew>& screws,
                const std::vector<std::size_t>& views,
                Reading reading,
                std::optional<Region> region) {
  StudyRow row;
  row.views = views;
  std::size_t out = 0;
  std::size_t found = 0;
  std::size_t in = 0;
  std::size_t left_alone = 0;
  for (const StudiedScrew& screw : screws) {
    if (region && screw.truth.region != *region) continue;
    const bool says = says_out(screw, views, reading);
    if (screw.is_out()) {
      ++out;
      if (says) ++found;
    } else {
      ++in;
      if (!says) ++left_alone;
    }
  }
  row.screws = out + in;
  if (out > 0) row.sensitivity = static_cast<double>(found) / static_cast<double>(out);
  if (in > 0) row.specificity = static_cast<double>(left_alone) / static_cast<double>(in);
  return row;
}

std::optional<double> limit_that_misses_half(const std::vector<StudiedScrew>& screws,
                                             const std::vector<std::size_t>& views,
                                             Reading reading,
                                             Region region) {
  std::vector<double> greatest;
  for (const StudiedScrew& screw : screws) {
    if (!screw.is_out() || screw.truth.region != region) continue;
    double most = -1e9;
    for (const std::size_t view : views) {
      const Overhang& overhang = screw.overhangs.at(view);
      most = std::max(most, reading == Reading::OnThePicture ? overhang.read_mm : overhang.true_mm);
    }
    greatest.push_back(most);
  }
  if (greatest.empty()) return std::nullopt;
  const auto middle = greatest.begin() + static_cast<std::ptrdiff_t>(greatest.size() / 2);
  std::nth_element(greatest.begin(), middle, greatest.end());
  return *middle;
}

MeanFirstRevealed mean_first_revealed(const std::vector<StudiedCase>& cases,
                                      Region region,
                                      std::size_t view) {
  MeanFirstRevealed mean;
  double sum = 0;
  for (const StudiedCase& each : cases) {
    for (const FirstRevealed& first : each.first_revealed) {
      if (first.region != region || !first.depth_mm.at(view)) continue;
      sum += *first.depth_mm[view];
      ++mean.cases;
    }
  }
  if (mean.cases > 0) mean.depth_mm = sum / static_cast<double>(mean.cases);
  return mean;
}

}  // namespace carpus::view_trainer
