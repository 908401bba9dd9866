// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Of the ways in near a portal's mark that of most worth: room between the pulled bones, less what
// it costs in tendon, off the mark and past what lies ahead; where there is such a one apart from
// the portals before it, in its interval, clear of nerves and arteries.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "arthroscopy/detail/pulled_bones.hpp"
#include "arthroscopy/detail/way_in.hpp"
#include "arthroscopy/detail/wrist_axes.hpp"
#include "arthroscopy/portal_table.hpp"
#include "cases/arthroscopic_map.hpp"
#include "geometry/vec3.hpp"

namespace carpus::arthroscopy::detail {

/// A way in that was tried; the greater is the better.
struct TriedWay {
  WayIn way;
  Vec3 mark;               ///< in the frame of the generic wrist
  double off_mm = 0;       ///< of the usual place
  double leant_deg = 0;    ///< about the forearm, of the usual way
  double past_mm = 0;      ///< what lies ahead
  bool is_apart = true;    ///< from the portals before it
  bool is_between = true;  ///< the structures that it belongs between
  /// Too near to a nerve or an artery by so much, and into a tendon.
  std::array<double, 2> cut_mm{};

  [[nodiscard]] bool has_room() const;
  /// Of two ways with much the same room the one nearer to the usual.
  [[nodiscard]] double value() const;
  [[nodiscard]] bool operator<(const TriedWay& other) const;
};

class PortalSearch {
 public:
  /// Keeps references to both.
  PortalSearch(const WristAxes& axes, const PulledBones& bones) : axes_(axes), bones_(bones) {}

  /// @param nominal  the portal's usual mark, in the frame of the generic wrist
  /// @param ahead    what its way is to lead to, frame Patient under traction
  /// @return none where no line near the mark leads into the joint.
  [[nodiscard]] std::optional<TriedWay> best_way(const TabledPortal& portal,
                                                 const cases::JointSpace& joint,
                                                 const Vec3& nominal,
                                                 const std::optional<Vec3>& ahead) const;
  /// From now on others keep apart from it.
  void take(const WayIn& way) { taken_.push_back(way); }

 private:
  /// Towards the forearm, about it [rad].
  using Lean = std::array<double, 2>;

  /// The same of those that lean so.
  [[nodiscard]] std::optional<TriedWay> best_by(const TabledPortal& portal,
                                                const cases::JointSpace& joint,
                                                const Vec3& nominal,
                                                const std::optional<Vec3>& ahead,
                                                const Lean& lean) const;
  /// Between which structures it lies and what it cuts; not asked of one without room.
  /// @param along  across the forearm, towards the ulnar side of a dorsal way
  void look_beside(const TabledPortal& portal, const Vec3& along, TriedWay& tried) const;
  [[nodiscard]] bool shares_hole(const WayIn& way) const;

  const WristAxes& axes_;
  const PulledBones& bones_;
  std::vector<WayIn> taken_;  ///< by the portals that were placed
};

}  // namespace carpus::arthroscopy::detail
