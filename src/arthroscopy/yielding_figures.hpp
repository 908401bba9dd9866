// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How tissue that yields feels on a case, to be printed beside what is published: how deep a probe
// presses it in, what it bears along its fibres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/arthroscopic_map.hpp"
#include "cases/case_data.hpp"
#include "yielding/net.hpp"

namespace carpus::arthroscopy {

/// How deep a probe of 1 mm presses the net in, at the place nearest to `at`, until the tissue
/// bears so much [mm]. @param half_thick_mm  the net lies so deep under what is touched
/// @param is_behind  from its other side
[[nodiscard]] double pressed_in_mm(const yielding::Net& net,
                                   const Vec3& at,
                                   double half_thick_mm,
                                   double newtons,
                                   bool is_behind = false);

/// How far a hook with that force lifts the net's particle nearest to `at` along its normal,
/// beyond where it rests [mm].
[[nodiscard]] double lifted_mm(const yielding::Net& net, const Vec3& at, double newtons);

/// The disc, whole or come off the fovea (Palmer 1B); under 1 N.
struct DiscFigures {
  bool has_come_off = false;
  double press_mm = 0;      ///< trampoline: in its middle
  double rests_off_mm = 0;  ///< of its ulnar edge, from where a whole one has it
  double lifted_mm = 0;     ///< hook test: at that edge, besides
  std::size_t particles = 0;
};

/// Whole, then come off; none where the case has no disc, the first alone where nothing of a tear
/// can be laid on it.
[[nodiscard]] std::vector<DiscFigures> disc_figures(const cases::CaseData& data,
                                                    const cases::ArthroscopicMap& map);

/// One ligament at one grade; under 1 N.
struct BandFigures {
  std::string band;
  std::string grade;
  double press_mm = 0;              ///< in its middle
  double press_behind_mm = 0;       ///< ... and from its other side
  std::optional<double> wanted_mm;  ///< what it is fitted to
  double bulge_mm = 0;              ///< as it rests
  double fibres_n_per_mm = 0;       ///< of its fibres in data, at this grade
  double along_n_per_mm = 0;        ///< what the net bears
  double whole_n_per_mm = 0;        ///< published, of the ligament with what no scope sees
  std::size_t particles = 0;
  std::size_t springs = 0;
};

/// Of every ligament that yields, whole and attenuated.
[[nodiscard]] std::vector<BandFigures> band_figures(const cases::ArthroscopicMap& map);

/// The interval behind one ligament, from the joint that it opens into, at one grade: the bones as
/// far apart as under full traction.
struct IntervalFigures {
  std::string band;
  std::string grade;
  double gap_mm = 0;    ///< between the cartilage of both bones, in the mean
  double deep_mm = 0;   ///< from its mouth to the ligament
  double probe_mm = 0;  ///< so far in a probe of 1 mm goes
  double scope_mm = 0;  ///< ... and a scope of 2.7 mm
};

/// Of every ligament that yields, at every grade; without those that the case has no place for.
[[nodiscard]] std::vector<IntervalFigures> interval_figures(const cases::CaseData& data,
                                                            const cases::ArthroscopicMap& map);

}  // namespace carpus::arthroscopy
