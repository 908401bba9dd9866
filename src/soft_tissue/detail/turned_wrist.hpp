// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The wrist with a moment on its hand, which is free in every way: strands, joint surfaces, and a
// press that holds the joint together. Led from rest to rest as the moment grows.
#pragma once

#include <span>
#include <vector>

#include "cases/case_data.hpp"
#include "soft_tissue/detail/force_lines.hpp"
#include "soft_tissue/detail/joint_contacts.hpp"
#include "soft_tissue/detail/rest_search.hpp"
#include "soft_tissue/soft_tissue.hpp"

namespace carpus::soft_tissue::detail {

/// A pull of constant force between a place on the hand and one on the forearm, both as scanned:
/// tendons that hold the joint together without turning it.
struct Press {
  double newtons = 0;
  Vec3 on_hand;
  Vec3 on_forearm;
};

/// What is done to the hand. Its rotation vector from the scan has components along unit vectors
/// (frame Patient); for a turn about one of them that component is the plain angle.
struct HandLoad {
  /// Its work is its amount times the component along `axis`: for a turn about that axis the plain
  /// moment about it, beside it half way between one that keeps its direction in space and one that
  /// turns with the hand. So it has an energy, which a moment with a fixed direction has not.
  Vec3 axis{0, 0, 1};
  double moment_nmm = 0;
  struct Guide {
    Vec3 axis;
    double angle_rad = 0;
  };
  std::vector<Guide> guides;  ///< components that a jig holds
};

class TurnedWrist {
 public:
  /// @param data  with distance fields; outlives this.
  /// @param holding_n_per_mm  pulls each body back to where it was scanned, so that nothing floats.
  TurnedWrist(const cases::CaseData& data,
              std::vector<ForceLine> lines,
              const ContactOptions& contacts,
              const Press& press,
              double holding_n_per_mm);

  /// Leads the bodies from where they lie to rest.
  LeftOver rest_under(const HandLoad& hand);

  [[nodiscard]] const Bodies& bodies() const noexcept { return bodies_; }
  void lay(const Bodies& bodies);
  [[nodiscard]] const std::vector<ForceLine>& lines() const noexcept { return lines_; }

 private:
  [[nodiscard]] Load load_at(const Bodies& bodies, const HandLoad& hand);
  void stiffness_at(const Bodies& bodies, const HandLoad& hand, Stiffness& stiffness) const;
  void find_contacts(const Bodies& bodies);
  /// At most, of any place of a body's carpal bones since contacts were found.
  [[nodiscard]] double gone_mm(const Bodies& bodies) const noexcept;
  /// Those that may push where bodies have gone so far since contacts were found.
  [[nodiscard]] std::span<const Contact> contacts_within(double gone_mm) const noexcept;

  const cases::CaseData& data_;
  std::vector<ForceLine> lines_;
  ContactOptions contact_options_;
  Press press_;
  double holding_n_per_mm_ = 0;
  std::array<double, kBodies> reach_mm_{};  ///< of a body's carpal bones from its middle
  Bodies bodies_;
  std::vector<Contact> contacts_;  ///< those with least room first
  Bodies contacts_found_at_;
};

/// Axis times angle [rad]; the angle is under half a turn.
[[nodiscard]] Vec3 rotation_vector(const Mat3& rotation) noexcept;

}  // namespace carpus::soft_tissue::detail
