// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The case and the procedure as the tick reads them: fixed once a world is set up.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/bone_solid.hpp"
#include "anatomy/carpal_kinematics.hpp"
#include "fields/contact_field.hpp"
#include "instruments/instrument.hpp"
#include "simulation/detail/bodies.hpp"
#include "simulation/detail/loose_bodies.hpp"
#include "simulation/detail/scope_drill.hpp"
#include "simulation/detail/skin_surface.hpp"
#include "simulation/detail/yielding_sheet.hpp"
#include "simulation/world.hpp"
#include "yielding/net_state.hpp"

namespace carpus::simulation {

struct World::Model {
  Model(const cases::CaseData& data,
        const procedure::Procedure& procedure,
        std::uint64_t seed,
        procedure::Mode mode,
        const std::optional<cases::PreparedPathology>& prepared);

  void open_skin();

  const cases::CaseData& data;
  const procedure::Procedure& procedure;
  std::uint64_t seed;
  procedure::Mode mode;
  std::optional<cases::PreparedPathology> prepared;  ///< of an examination; else none
  detail::BodyKinds kinds;
  std::span<const instruments::Instrument> catalogue;
  std::vector<fields::ContactField> fields;  ///< by body
  std::array<anatomy::CarpalGroup, kMaxBodies> groups{};
  std::optional<detail::FragmentFaces> fracture;  ///< of a target in two pieces
  std::vector<Vec3> centres;                      ///< of the bodies' surfaces, frame Bone
  std::vector<double> reaches_mm;                 ///< of the surfaces, from those
  std::vector<BoneSolid> target;  ///< one: the target's fragments as scanned, gap bridged
  procedure::Opening opening;
  /// Of an arthroscopy; nullptr where nothing on the tray enters joints.
  const cases::ArthroscopicMap* map = nullptr;
  std::optional<cases::JointLesions> lesions;  ///< of an examination, or what lies loose
  std::array<std::size_t, detail::kMaxLooseBodies> floats{};  ///< of these those that float
  std::size_t float_count = 0;
  std::array<std::uint8_t, kMaxBodies> loose{};  ///< bodies that it lets stand apart
  std::size_t loose_count = 0;
  std::vector<detail::YieldingSheet> sheets;  ///< of an arthroscopy, the disc first; else none
  std::size_t disc_edge = yielding::kMaxParticles;  ///< what a hook test pulls at
  /// Of a procedure that makes portals: the skin, which portals, what is felt for before each.
  std::optional<detail::SkinSurface> skin;
  std::array<std::uint8_t, procedure::kPortalsMade> asked{};
  struct LandmarkPlace {
    Vec3 at;  ///< frame Bone of `body`
    std::uint8_t body = 0;
  };
  std::array<LandmarkPlace, procedure::kPortalsMade> felt_first{};
  std::array<std::uint32_t, procedure::kPortalsMade> drawn_aside{};  ///< bit i: structure i
  std::array<bool, procedure::kPortalsMade> is_opened_first{};
  bool has_joint_tools = false;  ///< on the tray: what enters joints
  [[nodiscard]] bool makes_portals() const noexcept { return skin.has_value(); }
  /// Its joints are entered by portals that were made before, and by no other.
  [[nodiscard]] bool goes_in_by_own() const noexcept { return makes_portals() && has_joint_tools; }
  detail::DrillPlan drill;    ///< of a procedure that declares one
  bool has_punch = false;     ///< on the tray, and there is tissue to be taken away
  double cartilage_mm = 0.0;  ///< over bone (data/tissue_feel.json), of what has jaws that bite
  /// What a shaver or a punch takes away; none of most procedures.
  [[nodiscard]] std::span<const cases::TissuePiece> pieces() const noexcept;
};

}  // namespace carpus::simulation
