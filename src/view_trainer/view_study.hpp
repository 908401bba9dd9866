// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How often a view, or a set of views, tells that a screw is out, and how often it says so of one
// that is not. In silico: the reader is a model (docs/view_trainer.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cases/case_data.hpp"
#include "view_trainer/generated_screw.hpp"
#include "view_trainer/outline_reader.hpp"
#include "view_trainer/seen_screw.hpp"

namespace carpus::view_trainer {

/// A generated screw and what each standard view shows of it.
struct StudiedScrew {
  std::size_t case_index = 0;
  std::uint64_t seed = 0;
  Protrusion truth;
  std::vector<Overhang> overhangs;  ///< by standard_views()

  [[nodiscard]] bool is_out() const noexcept { return truth.depth_mm > kOutMm; }
};

/// How far a pole's screw stands out when a view first reveals it: the screw on the central axis is
/// moved out in steps of 0.1 mm, as cadaver studies do in 0.5 mm [skyline2021]; nothing where it
/// is not revealed within 5 mm. By standard_views(), then pa_extended_view().
struct FirstRevealed {
  Region region = Region::Proximal;
  std::vector<std::optional<double>> depth_mm;
};

struct StudiedCase {
  std::string pseudonym;
  std::vector<ReadingError> reading_errors;   ///< by standard_views()
  std::vector<FirstRevealed> first_revealed;  ///< distal, proximal
  std::vector<StudiedScrew> screws;
};

/// Places one screw a seed, from `first_seed` on, in the scaphoid of a case. Deterministic; about
/// 3 s and 0.05 s a screw.
[[nodiscard]] StudiedCase study_case(const cases::CaseData& data,
                                     std::size_t case_index,
                                     std::uint64_t first_seed,
                                     std::size_t seeds);

/// Whose reading counts.
enum class Reading {
  OnThePicture,  ///< of the outline as read on the rendered picture
  OfTheTruth,    ///< of the outline as projected, which nobody sees
};

/// One row: of a set of views, each of which may say "out".
struct StudyRow {
  std::vector<std::size_t> views;     ///< of standard_views()
  std::size_t screws = 0;             ///< that are in or out
  std::optional<double> sensitivity;  ///< share revealed of those out; none without one
  std::optional<double> specificity;  ///< share not revealed of those in
};

/// Every single view; PA and lateral; those and 45 degrees pronated; those and the skyline; all.
[[nodiscard]] std::vector<std::vector<std::size_t>> view_sets();

/// @param region  only screws whose farthest place is there; all where there is none.
[[nodiscard]] StudyRow row_of(const std::vector<StudiedScrew>& screws,
                              const std::vector<std::size_t>& views,
                              Reading reading,
                              std::optional<Region> region = std::nullopt);

/// From how far beyond the outline on metal may be called, that half of the screws which are out in
/// a region are missed by a set of views [mm]; none without such screws.
[[nodiscard]] std::optional<double> limit_that_misses_half(const std::vector<StudiedScrew>& screws,
                                                           const std::vector<std::size_t>& views,
                                                           Reading reading,
                                                           Region region);

/// Mean of what was first revealed over cases: of those cases in which it was, and their number.
struct MeanFirstRevealed {
  std::optional<double> depth_mm;
  std::size_t cases = 0;
};
[[nodiscard]] MeanFirstRevealed mean_first_revealed(const std::vector<StudiedCase>& cases,
                                                    Region region,
                                                    std::size_t view);

}  // namespace carpus::view_trainer
