// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// The bodies' bone as an exercise has left it: surface, density, what was removed. A body's points
// are in its frame Bone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "core/state_hash.hpp"
#include "fields/contact_field.hpp"
#include "fields/cut_tissue.hpp"
#include "geometry/grid.hpp"
#include "geometry/instrument_shape.hpp"
#include "geometry/pose.hpp"
#include "geometry/vec3.hpp"

namespace carpus::simulation::detail {

using CtView = GridView<const std::int16_t>;

class Tissue {
 public:
  /// @param bones  by body; must outlive this.
  explicit Tissue(std::span<const fields::ContactField> bones) : bones_(bones), cuts_(bones) {}

  [[nodiscard]] const fields::CutTissue& cuts() const noexcept { return cuts_; }
  [[nodiscard]] fields::CutTissue& cuts() noexcept { return cuts_; }

  /// Within the field's box: elsewhere the body is farther than the field reaches.
  [[nodiscard]] bool is_near(std::uint8_t body, const Vec3& point) const noexcept;
  /// Signed distance to the surface as it was [mm]: what "in a bone" means to drill and score.
  [[nodiscard]] double untouched_distance_mm(std::uint8_t body, const Vec3& point) const noexcept {
    return bones_[body].sample(point);
  }
  /// Unit, out of that surface; zero where the field has no slope.
  [[nodiscard]] Vec3 untouched_normal(std::uint8_t body, const Vec3& point) const noexcept;
  /// HU of what is left, at a point of the CT as scanned.
  [[nodiscard]] double density_hu(const CtView& ct,
                                  std::uint8_t body,
                                  const Vec3& point) const noexcept;

  /// Removes what a round bar swept, tapered from `from` to `to`.
  fields::Removal remove(std::uint8_t body, const SweptTool& swept) noexcept {
    return cuts_.remove(body, swept);
  }
  /// Bone between a screw's core and crest that is left, as a share of what stood there [1]
  /// (contact/screw_hold.hpp). 1 where nothing stood.
  [[nodiscard]] double holding_share(const CtView& ct,
                                     std::uint8_t body,
                                     const ThreadedCylinderShape& screw,
                                     const Pose<frame::Bone, frame::Tool>& pose) const noexcept;

 private:
  std::span<const fields::ContactField> bones_;
  fields::CutTissue cuts_;
};

}  // namespace carpus::simulation::detail
