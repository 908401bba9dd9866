// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Tendons, arteries and nerves in the tick: where they are as the wrist is held, and how near to
// them something turns. They push nothing and are pushed by nothing but a sleeve
// (docs/decisions/0057-what-harms-a-structure.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cases/case_data.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"
#include "simulation/detail/operation_state.hpp"
#include "simulation/snapshot.hpp"

namespace carpus::simulation::detail {

/// Farther than this nothing is told of a structure [mm].
inline constexpr double kFarFromStructureMm = 100.0;

/// What came near a structure so far; no undo takes it back.
struct StructureHarm {
  double least_mm = kFarFromStructureMm;  ///< surface to surface, while something turned
  bool was_struck = false;
  InstrumentIndex by = kNoInstrument;  ///< that came nearest
};

struct StructureState {
  std::uint8_t count = 0;  ///< as many as the case has
  std::array<StructureHarm, cases::kMaxStructures> harm{};
  /// By item: a sleeve stood round it when it went into bone, so that its way to the bone is
  /// spread.
  std::array<bool, kMaxItems> is_led{};
};

template <Is<StructureState> SomeState, typename Visitor>
void visit(SomeState& state, Visitor&& v) noexcept {
  v(state.count);
  for (std::size_t i = 0; i < state.count && i < cases::kMaxStructures; ++i) {
    v(state.harm[i].least_mm);
    v(state.harm[i].was_struck);
    v(state.harm[i].by);
  }
  for (auto& led : state.is_led) v(led);
}

/// Whether a tick could have left it in a case with so many structures.
[[nodiscard]] bool is_possible(const StructureState& state,
                               std::size_t structures,
                               std::size_t instruments) noexcept;

/// Where the tubes are. All memory is taken when it is made.
class StructureWatch {
 public:
  explicit StructureWatch(const cases::CaseData& data);

  [[nodiscard]] std::size_t size() const noexcept { return tubes_.size(); }

  /// Lays the tubes where the bones have taken them; poses by body of the case. Only needed before
  /// `gap_mm`, and nearly free while the bones that take them stay. Only + - * / and sqrt.
  void follow(std::span<const Pose<frame::Patient, frame::Bone>> poses) noexcept;

  /// Least distance of a tube's surface from the segment [mm]; negative where the segment is in it;
  /// `below_mm` where it is no nearer than that, which is found out sooner.
  [[nodiscard]] double gap_mm(std::size_t tube,
                              const Vec3& from,
                              const Vec3& to,
                              double below_mm = kFarFromStructureMm) const noexcept;

 private:
  struct Tube {
    std::size_t first = 0;  ///< in the points
    std::size_t count = 0;
    double radius_mm = 0;
    std::uint8_t forearm = kNoBody;
    Vec3 middle;  ///< of a ball round it as it lies now
    double reach_mm = 0;
    double longest_step_mm = 0;  ///< between neighbouring points
  };
  std::vector<Tube> tubes_;
  std::vector<Vec3> scanned_;
  std::vector<double> hand_share_;
  std::vector<Vec3> now_;
  std::uint8_t hand_ = kNoBody;
  std::array<std::uint8_t, 3> carriers_{};  ///< hand, radius, ulna
  std::array<Pose<frame::Patient, frame::Bone>, 3> laid_by_{};
  bool is_laid_ = false;
};

/// Least distance of two segments [mm]. Source: [ericson2004realtime] §5.1.9.
[[nodiscard]] double segment_distance(const Vec3& a0,
                                      const Vec3& a1,
                                      const Vec3& b0,
                                      const Vec3& b1) noexcept;

}  // namespace carpus::simulation::detail
