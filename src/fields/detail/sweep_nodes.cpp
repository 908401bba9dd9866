// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// In float, over whole arrays of 128, so that the compiler works on four nodes at once
// (CMakeLists.txt gives this file the options for it; they change no result). Distances are off by
// less than 4e-5 mm: coordinates are taken from the tool's origin, at most 60 mm away, each
// rounded once (2e-6 mm), and half a dozen operations follow. The axis must be the tool's own to
// 1e-6.
#include "fields/detail/sweep_nodes.hpp"

#include <cmath>
#include <cstddef>

#include "fields/cut_field.hpp"

namespace carpus::fields::detail {
namespace {

constexpr std::size_t kLanes = 128;

}  // namespace

SweepNodes::SweepNodes(const SweptTool& tool, const Vec3& origin, double spacing_mm) noexcept
    : from_tool_(origin - tool.origin()), spacing_(spacing_mm) {
  for (std::size_t a = 0; a < 3; ++a) axis_[a] = static_cast<float>(tool.axis()[a]);
  const auto knots = tool.knots();
  if (knots.size() == 1) {
    const auto z = static_cast<float>(knots[0].z_mm);
    pieces_[0] = {z, z, static_cast<float>(knots[0].radius_mm), 0, 0};
    count_ = 1;
  }
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double slope =
        (knots[i].radius_mm - knots[i - 1].radius_mm) / (knots[i].z_mm - knots[i - 1].z_mm);
    pieces_[i - 1] = {static_cast<float>(knots[i - 1].z_mm), static_cast<float>(knots[i].z_mm),
                      static_cast<float>(knots[i - 1].radius_mm), static_cast<float>(slope),
                      static_cast<float>(slope / std::sqrt(1 - slope * slope))};
    ++count_;
  }
}

void SweepNodes::depths(const VoxelIndex& low_node,
                        std::array<std::int16_t, 128>& out) const noexcept {
  constexpr int kNodes = CutBrick::kNodes;
  std::array<float, kNodes> px{};
  std::array<float, kNodes> py{};
  std::array<float, kNodes> pz{};
  for (int i = 0; i < kNodes; ++i) {
    const auto at = static_cast<std::size_t>(i);
    px[at] = static_cast<float>(from_tool_.x + (low_node.x + i) * spacing_);
    py[at] = static_cast<float>(from_tool_.y + (low_node.y + i) * spacing_);
    pz[at] = static_cast<float>(from_tool_.z + (low_node.z + i) * spacing_);
  }
  alignas(64) std::array<float, kLanes> along{};
  alignas(64) std::array<float, kLanes> squared{};  // of the way off the axis
  std::size_t lane = 0;
  for (std::size_t k = 0; k < kNodes; ++k) {
    for (std::size_t j = 0; j < kNodes; ++j) {
      for (std::size_t i = 0; i < kNodes; ++i) {
        const float z = px[i] * axis_[0] + py[j] * axis_[1] + pz[k] * axis_[2];
        const float x = px[i] - z * axis_[0];
        const float y = py[j] - z * axis_[1];
        const float w = pz[k] - z * axis_[2];
        along[lane] = z;
        squared[lane] = x * x + y * y + w * w;
        ++lane;
      }
    }
  }
  alignas(64) std::array<float, kLanes> depth{};
  for (float& d : depth) d = -static_cast<float>(kCutDepthMm);
  for (int p = 0; p < count_; ++p) {
    const Piece piece = pieces_[static_cast<std::size_t>(p)];
    const auto deepen = [&](std::size_t i, float nearest) {
      const float low = nearest < piece.from ? piece.from : nearest;
      const float z = low > piece.to ? piece.to : low;
      const float off = along[i] - z;
      const float d =
          piece.radius + piece.slope * (z - piece.from) - std::sqrt(squared[i] + off * off);
      depth[i] = d > depth[i] ? d : depth[i];
    };
    if (piece.lean == 0) {
      for (std::size_t i = 0; i < kLanes; ++i) deepen(i, along[i]);
    } else {
      for (std::size_t i = 0; i < kLanes; ++i) {
        deepen(i, along[i] + std::sqrt(squared[i]) * piece.lean);
      }
    }
  }
  constexpr float kMost = static_cast<float>(kCutReachMm);
  constexpr float kPerUnit = static_cast<float>(1 / kCutUnitMm);
  alignas(64) std::array<std::int32_t, kLanes> steps{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const float d = depth[i] > kMost ? kMost : depth[i];
    // Positive before it is cut to a whole number: rounds to the nearest.
    steps[i] = static_cast<std::int32_t>((d + 2) * kPerUnit + 0.5F) - 2 * 4096;
  }
  for (std::size_t i = 0; i < kLanes; ++i) out[i] = static_cast<std::int16_t>(steps[i]);
  for (std::size_t i = CutBrick::kNodeCount; i < kLanes; ++i) out[i] = CutBrick::kUncut;
}

}  // namespace carpus::fields::detail
