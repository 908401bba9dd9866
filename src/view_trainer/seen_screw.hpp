// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A case in its standard views, and what of a screw each of them reveals.
#pragma once

#include <optional>
#include <vector>

#include "fluoroscopy/composed_renderer.hpp"
#include "view_trainer/outline_map.hpp"
#include "view_trainer/scaphoid_surface.hpp"
#include "view_trainer/standard_views.hpp"

namespace carpus::view_trainer {

/// Metal beyond the outline by at least this is revealed [mm in the bone's plane]: twice the full
/// width at half maximum of the receptor's blur (deviation 0.14 mm at the receptor, 0.33 mm wide,
/// 0.26 mm in the bone's plane), so that the metal's and the bone's edge are told apart.
inline constexpr double kRevealedMm = 0.5;

/// One view of a case.
struct CaseView {
  PosedView posed;
  OutlineMap truth;                ///< the scaphoid's outline as projected
  std::optional<OutlineMap> read;  ///< as read on the rendered picture; none until asked for
};

/// What a view shows of a screw [mm beyond the outline; negative: so far inside it].
struct Overhang {
  double true_mm = 0.0;
  double read_mm = 0.0;  ///< the same as true_mm where no outline was read
};

class CaseViews {
 public:
  /// @param scaphoid  must outlive it.
  CaseViews(const ScaphoidSurface& scaphoid, std::vector<StandardView> views);

  /// Renders a picture of each view, without a screw, and reads the outlines.
  void read_outlines(fluoroscopy::ComposedRenderer& renderer);

  [[nodiscard]] const std::vector<StandardView>& views() const noexcept { return views_; }
  [[nodiscard]] const CaseView& at(std::size_t view) const { return seen_.at(view); }
  [[nodiscard]] Overhang overhang_of(const PlacedScrew& placed, std::size_t view) const;

 private:
  std::vector<StandardView> views_;
  std::vector<CaseView> seen_;
};

/// Takes a case's scan apart for pictures: about half a second.
[[nodiscard]] fluoroscopy::ComposedRenderer make_renderer(const cases::CaseData& data);

}  // namespace carpus::view_trainer
