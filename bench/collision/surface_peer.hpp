// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A peer that asks triangle meshes against each other.
#pragma once

#include <memory>
#include <span>

#include "convex/pair_query.hpp"
#include "geometry/triangle_mesh.hpp"

namespace carpus::bench {

class SurfacePeer {
 public:
  SurfacePeer() = default;
  SurfacePeer(const SurfacePeer&) = delete;
  SurfacePeer& operator=(const SurfacePeer&) = delete;
  virtual ~SurfacePeer() = default;
  /// Least distance of the surfaces; 0 or less where they cross [mm].
  virtual double distance(std::size_t bone,
                          std::size_t tool,
                          const convex::PairPose& bone_from_tool) = 0;
  virtual bool collide(std::size_t bone,
                       std::size_t tool,
                       const convex::PairPose& bone_from_tool) = 0;
};

/// FCL: a tree of oriented boxes and swept spheres (OBBRSS) over each mesh.
[[nodiscard]] std::unique_ptr<SurfacePeer> fcl_surface_peer(std::span<const TriangleMesh> bones,
                                                            std::span<const TriangleMesh> tools);

}  // namespace carpus::bench
