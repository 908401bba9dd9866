// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "bench/collision/surface_peer.hpp"

namespace carpus::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> vertices;
  for (const Vec3& v : mesh.vertices) vertices.emplace_back(v.x, v.y, v.z);
  std::vector<fcl::Triangle> triangles;
  for (const Triangle& t : mesh.facets) triangles.emplace_back(t[0], t[1], t[2]);
  auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(vertices, triangles);
  model->endModel();
  return model;
}

class FclSurfacePeer final : public SurfacePeer {
 public:
  FclSurfacePeer(std::span<const TriangleMesh> bones, std::span<const TriangleMesh> tools) {
    for (const TriangleMesh& m : bones) bones_.push_back(model_of(m));
    for (const TriangleMesh& m : tools) tools_.push_back(model_of(m));
  }
  double distance(std::size_t bone, std::size_t tool, const convex::PairPose& pose) override {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(bones_[bone].get(), fcl::Transform3d::Identity(), tools_[tool].get(),
                         placed(pose), request, result);
  }
  bool collide(std::size_t bone, std::size_t tool, const convex::PairPose& pose) override {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(bones_[bone].get(), fcl::Transform3d::Identity(), tools_[tool].get(),
                        placed(pose), request, result) > 0;
  }

 private:
  static fcl::Transform3d placed(const convex::PairPose& pose) {
    fcl::Transform3d t = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
      const Vec3& row = pose.rotation.rows[static_cast<std::size_t>(i)];
      t.linear().row(i) << row.x, row.y, row.z;
      t.translation()[i] = pose.translation[static_cast<std::size_t>(i)];
    }
    return t;
  }
  std::vector<std::shared_ptr<Model>> bones_;
  std::vector<std::shared_ptr<Model>> tools_;
};

}  // namespace

std::unique_ptr<SurfacePeer> fcl_surface_peer(std::span<const TriangleMesh> bones,
                                              std::span<const TriangleMesh> tools) {
  return std::make_unique<FclSurfacePeer>(bones, tools);
}

}  // namespace carpus::bench
