// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Contact of instruments with bones of the reference wrist, against the triangles themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "contact/instrument_contact.hpp"
#include "contact/instrument_scene.hpp"
#include "fields/cut_tissue.hpp"
#include "fields/distance_field.hpp"
#include "fields/exact_surface.hpp"
#include "fields/surface_test_support.hpp"

namespace carpus::contact {
namespace {

using fields::test::amount;

/// A bone of the reference wrist as 32-bit floats give it; empty where that is absent
/// ($CARPUS_REFERENCE_WRIST, default ../shared/reference-wrist). Reads what those files hold and no
/// other PLY.
TriangleMesh reference_bone(const std::string& name) {
  const char* set = std::getenv("CARPUS_REFERENCE_WRIST");  // NOLINT(concurrency-mt-unsafe)
  const std::string folder = set != nullptr ? set : "../shared/reference-wrist";
  std::ifstream file(folder + "/meshes/" + name + ".ply", std::ios::binary);
  std::size_t vertices = 0;
  std::size_t facets = 0;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) facets = std::stoul(line.substr(13));
  }
  TriangleMesh mesh;
  for (std::size_t i = 0; i < vertices; ++i) {
    std::array<float, 3> v{};
    file.read(reinterpret_cast<char*>(v.data()), sizeof v);
    mesh.vertices.push_back({v[0], v[1], v[2]});
  }
  for (std::size_t i = 0; i < facets; ++i) {
    std::array<std::int32_t, 3> t{};
    file.get();
    file.read(reinterpret_cast<char*>(t.data()), sizeof t);
    mesh.facets.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                           static_cast<std::uint32_t>(t[2])});
  }
  return mesh;
}

/// How far contacts are off the triangles', of shapes that touch or nearly so.
struct Errors {
  std::vector<double> gap_mm;
  std::vector<double> point_mm;     ///< the contact point's distance from the surface
  std::vector<double> normal_sine;  ///< from outside, where one part of the surface is nearest
};

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// One instrument near a random vertex, against the triangles.
void compare(const fields::ContactField& field,
             const fields::ExactSurface& exact,
             const InstrumentShape& shape,
             Rng& rng,
             Errors& errors) {
  const auto& vertices = exact.surface().vertices;
  const Vec3 shaft = fields::test::random_direction(rng);
  const Vec3 centre =
      vertices[rng.below(vertices.size())] +
      fields::test::random_direction(rng) * rng.uniform(0, 2 * shape.greatest_radius_mm());
  const double z = rng.uniform(shape.front_z_mm(), shape.back_z_mm());
  const Pose<frame::Bone, frame::Tool> pose{fields::test::turned_to(shaft), centre - shaft * z};
  const SurfaceContact contact = find_contact(field, shape, pose, 1.0);
  constexpr double kTolerance = 1e-3;
  const double truth = exact.gap_of(shape, pose, kTolerance).gap_mm;
  ASSERT_NE(contact.outcome, ContactOutcome::NotKnown);
  ASSERT_GE(truth, contact.lowest_gap_mm - 1e-6);
  ASSERT_LE(truth, contact.highest_gap_mm + kTolerance);
  if (contact.outcome == ContactOutcome::Far || contact.outcome == ContactOutcome::Buried) return;
  errors.gap_mm.push_back(std::abs(contact.gap_mm - truth));
  const Vec3 ball = (pose * Point<frame::Tool>{{0, 0, contact.z_mm}}).v;
  const double distance = exact.signed_distance(ball);
  const auto nearest = exact.tree().nearest(ball);
  if (std::abs(contact.steepness - 1) > 0.03 || distance < 0.3 || !nearest) return;
  errors.point_mm.push_back(std::abs(exact.signed_distance(contact.point.v)));
  errors.normal_sine.push_back(length(cross((ball - nearest->point) / distance, contact.normal.v)));
}

std::vector<InstrumentShape> instruments() {
  return {InstrumentShape(SphereShape{1.5}), InstrumentShape(CapsuleShape{1.0, 30}),
          InstrumentShape(ConeTipShape{0.57, 1.5, 40}),
          InstrumentShape(ThreadedCylinderShape{1.0, 1.5, 0.8, 24})};
}

/// A bone's triangles and what tools swept in it: g = max(d, -t) of fields/cut_field.hpp.
class DrilledSurface {
 public:
  DrilledSurface(const fields::ContactField& field, const fields::ExactSurface& exact)
      : field_(field), exact_(exact) {}
  void drill(const SweptTool& tool) { tools_.push_back(tool); }
  [[nodiscard]] const std::vector<SweptTool>& tools() const { return tools_; }

  [[nodiscard]] double depth_in_tools(const Vec3& p) const {
    double depth = -std::numeric_limits<double>::infinity();
    for (const SweptTool& tool : tools_) depth = std::max(depth, -tool.signed_distance(p));
    return depth;
  }
  [[nodiscard]] double at(const Vec3& p) const {
    // The field is sure of the sign but near the surface; the winding number is slow.
    const double sample = field_.sample(p);
    const auto nearest = exact_.tree().nearest(p);
    const bool is_sure = std::abs(sample) > field_.error_mm() && nearest.has_value();
    const double d =
        is_sure ? std::copysign(distance(nearest->point, p), sample) : exact_.signed_distance(p);
    return std::max(d, depth_in_tools(p));
  }

  /// The least g - radius along a shape, by pieces whose lower bound may still be smaller: no more
  /// than `tolerance_mm` above it.
  [[nodiscard]] double gap_of(const InstrumentShape& shape,
                              const Pose<frame::Bone, frame::Tool>& pose,
                              double tolerance_mm) const {
    const auto value = [&](double z) {
      return at((pose * Point<frame::Tool>{{0, 0, z}}).v) - shape.radius_at(z);
    };
    struct Part {
      double from, to, at_from, at_to;
    };
    const double front = shape.front_z_mm();
    const double back = shape.back_z_mm();
    std::vector<Part> parts{{front, back, value(front), value(back)}};
    double best = std::min(parts[0].at_from, parts[0].at_to);
    while (!parts.empty()) {
      const Part p = parts.back();
      parts.pop_back();
      constexpr double kSteepest = 1.5;  // a distance's 1 and the steepest cone's 0.36
      if (0.5 * (p.at_from + p.at_to - kSteepest * (p.to - p.from)) > best - tolerance_mm) continue;
      const double middle = 0.5 * (p.from + p.to);
      const double at_middle = value(middle);
      best = std::min(best, at_middle);
      parts.push_back({p.from, middle, p.at_from, at_middle});
      parts.push_back({middle, p.to, at_middle, p.at_to});
    }
    return best;
  }

  /// No more than this is the true gap: to corners that no tool took, and in what is left.
  [[nodiscard]] double highest_gap_of(const InstrumentShape& shape,
                                      const Pose<frame::Bone, frame::Tool>& pose) const {
    double highest = std::numeric_limits<double>::infinity();
    const auto tool_from_bone = pose.inverse();
    for (const Vec3& corner : exact_.surface().vertices) {
      if (depth_in_tools(corner) > 0) continue;
      const Vec3 in_tool = (tool_from_bone * Point<frame::Bone>{corner}).v;
      highest = std::min(highest, shape.signed_distance(in_tool));
    }
    return highest;
  }

 private:
  const fields::ContactField& field_;
  const fields::ExactSurface& exact_;
  std::vector<SweptTool> tools_;
};

/// A pose near a random corner of the bone, or along a tool that went through it.
Pose<frame::Bone, frame::Tool> pose_near(const DrilledSurface& drilled,
                                         const TriangleMesh& mesh,
                                         const InstrumentShape& shape,
                                         Rng& rng) {
  const Vec3 shaft = fields::test::random_direction(rng);
  Vec3 centre = mesh.vertices[rng.below(mesh.vertices.size())];
  if (!drilled.tools().empty() && rng.below(2) == 0) {
    const SweptTool& tool = drilled.tools()[rng.below(drilled.tools().size())];
    centre = tool.origin() + tool.axis() * rng.uniform(0, 15);
  }
  centre += fields::test::random_shift(rng, 2);
  const double z = rng.uniform(shape.front_z_mm(), shape.back_z_mm());
  return {fields::test::turned_to(shaft), centre - shaft * z};
}

TEST(SurfaceContactOracle, KeepsItsBoundsForDrilledReferenceBonesThatMove) {
  const TriangleMesh mesh = reference_bone("scaphoid");
  if (mesh.facets.empty()) {
    GTEST_SKIP() << "no reference wrist; set CARPUS_REFERENCE_WRIST to its folder";
  }
  const std::vector<fields::ContactField> bone{{fields::build_distance_field(mesh), mesh}};
  const fields::ExactSurface exact(mesh);
  const auto shapes = instruments();
  Rng rng(9);
  int outside = 0;
  int asked = 0;
  std::vector<double> gaps;
  for (int round = 0; round < amount(2, 4, 40); ++round) {
    fields::CutTissue tissue(bone);
    DrilledSurface drilled(bone[0], exact);
    InstrumentScene scene(bone, shapes, {.within_mm = 0.8, .look_ahead_mm = 1.0});
    scene.set_cuts(tissue.fields());
    for (int tick = 0; tick < amount(4, 12, 60); ++tick) {
      if (round > 0 && tick % 4 == 0) {  // the first round moves whole bones
        const InstrumentShape& tool = shapes[tick % 8 == 0 ? 2 : 1];
        auto way = pose_near(drilled, mesh, tool, rng);
        way.translation = mesh.vertices[rng.below(mesh.vertices.size())] -
                          way.rotation.column(2) * rng.uniform(0, 6);
        drilled.drill(SweptTool::whole(tool, way, 1));
        ASSERT_NE(tissue.remove(0, drilled.tools().back()).outcome,
                  fields::RemovalOutcome::NotKnown);
      }
      const std::vector<Pose<frame::Patient, frame::Bone>> patient_from_bone{
          {fields::test::turned_to(fields::test::random_direction(rng)),
           fields::test::random_shift(rng, 80)}};
      std::vector<Pose<frame::Patient, frame::Tool>> patient_from_tool;
      for (const InstrumentShape& shape : shapes) {
        patient_from_tool.push_back(patient_from_bone[0] * pose_near(drilled, mesh, shape, rng));
      }
      scene.update(patient_from_bone, patient_from_tool);
      for (std::size_t i = 0; i < shapes.size(); ++i) {
        const SurfaceContact& contact = scene.contact(i, 0);
        const auto pose = patient_from_bone[0].inverse() * patient_from_tool[i];
        constexpr double kTolerance = 5e-3;
        const double g = drilled.gap_of(shapes[i], pose, kTolerance);
        ++asked;
        // g - radius is at most the true gap; corners and what is left bound it from above.
        const double highest = drilled.highest_gap_of(shapes[i], pose);
        if (contact.highest_gap_mm < g - kTolerance || contact.lowest_gap_mm > highest) ++outside;
        if (contact.outcome == ContactOutcome::Buried) continue;
        if (contact.outcome == ContactOutcome::Far) {
          if (g < 0.8 - bone[0].error_mm() - kTolerance) ++outside;
          continue;
        }
        gaps.push_back(std::abs(contact.gap_mm - g));
        if (gaps.back() > bone[0].error_mm() + kTolerance) ++outside;
      }
    }
  }
  const std::size_t count = gaps.size();
  std::printf(
      "drilled scaphoid that moves: %d asked, %d outside the bounds; half and 95 %% of %zu"
      " gaps off by at most %.4f and %.4f mm, all %.4f\n",
      asked, outside, count, quantile(gaps, 0.5), quantile(gaps, 0.95), quantile(gaps, 1));
  EXPECT_EQ(outside, 0);
  EXPECT_GT(count, static_cast<std::size_t>(asked / 3));
}

TEST(SurfaceContactOracle, AgreesWithTheTrianglesOfReferenceBones) {
  const std::vector<InstrumentShape> shapes = instruments();
  Rng rng(8);
  std::vector<std::string> names{"scaphoid"};
  if (amount(0, 0, 1) == 1) names = {"scaphoid", "hamate", "radius", "trapezium"};
  for (const std::string& name : names) {
    const TriangleMesh mesh = reference_bone(name);
    if (mesh.facets.empty()) {
      GTEST_SKIP() << "no reference wrist; set CARPUS_REFERENCE_WRIST to its folder";
    }
    const fields::ContactField field(fields::build_distance_field(mesh), mesh);
    const fields::ExactSurface exact(mesh);
    Errors errors;
    for (const InstrumentShape& shape : shapes) {
      for (int i = 0; i < amount(2, 10, 100); ++i) compare(field, exact, shape, rng, errors);
    }
    std::printf(
        "%s, half and 95 %% of gaps off by at most %.4f and %.4f mm, all %.4f (proved %.3f);"
        " points %.4f, %.4f mm; normals' sines %.4f, %.4f\n",
        name.c_str(), quantile(errors.gap_mm, 0.5), quantile(errors.gap_mm, 0.95),
        quantile(errors.gap_mm, 1), field.error_mm(), quantile(errors.point_mm, 0.5),
        quantile(errors.point_mm, 0.95), quantile(errors.normal_sine, 0.5),
        quantile(errors.normal_sine, 0.95));
    EXPECT_LE(quantile(errors.gap_mm, 1), field.error_mm() + 1e-3);
    EXPECT_LT(quantile(errors.gap_mm, 0.5), 0.05);
    EXPECT_LT(quantile(errors.point_mm, 0.5), 0.03);
    EXPECT_LT(quantile(errors.normal_sine, 0.5), 0.1);
  }
}

}  // namespace
}  // namespace carpus::contact
