// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// All instruments against the true surfaces of all bones, each tick: our fields beside FCL's trees
// over the same triangles, which meet a mesh of each instrument.
#include <cmath>
#include <cstdio>

#include "bench/collision/surface_peer.hpp"
#include "bench/collision/tables.hpp"
#include "bench/stopwatch.hpp"
#include "contact/instrument_scene.hpp"
#include "core/error.hpp"
#include "fields/distance_field.hpp"
#include "hull/fast_hull.hpp"

namespace carpus::bench {
namespace {

using fields::ContactField;
using BonePose = Pose<frame::Patient, frame::Bone>;
using ToolPose = Pose<frame::Patient, frame::Tool>;

constexpr double kSpacingMm = 0.4;
constexpr double kBandMm = 4;
/// Nearer to touching than this, the instrument's mesh and the field may differ.
constexpr double kSureMm = 0.35;
constexpr std::size_t kTicks = 200;

std::vector<InstrumentShape> instruments() {
  return {InstrumentShape(ConeTipShape{0.57, 1.5, 80}),           // wire
          InstrumentShape(ConeTipShape{1.2, 2.5, 60}),            // drill
          InstrumentShape(ThreadedCylinderShape{1, 1.5, 1, 24}),  // screw
          InstrumentShape(CapsuleShape{2, 60}),                   // driver
          InstrumentShape(SphereShape{1.5})};                     // probe
}

/// The hull of points of its balls: inside the true shape by some hundredths of a millimetre.
TriangleMesh mesh_of(const InstrumentShape& shape) {
  constexpr int kRings = 6;
  constexpr int kSides = 20;
  constexpr double kPi = 3.14159265358979323846;
  std::vector<Vec3> points;
  for (const AxisKnot& knot : shape.knots()) {
    for (int i = 0; i <= 2 * kRings; ++i) {
      const double up = kPi * (static_cast<double>(i) / (2 * kRings) - 0.5);
      for (int k = 0; k < kSides; ++k) {
        const double a = 2 * kPi * k / kSides;
        points.push_back({knot.radius_mm * std::cos(up) * std::cos(a),
                          knot.radius_mm * std::cos(up) * std::sin(a),
                          knot.z_mm + knot.radius_mm * std::sin(up)});
      }
    }
  }
  return hull::build_fast_hull(points).polytope.surface();
}

struct SurfaceScript {
  std::vector<std::vector<BonePose>> bones;
  std::vector<std::vector<ToolPose>> tools;
};

/// Instruments stroke along bones, in and out; bones and instruments take a step each tick.
SurfaceScript make_script(const BoneSet& set, std::size_t tool_count) {
  Rng rng(5);
  SurfaceScript script;
  std::vector<BonePose> bones(set.bones.size());
  std::vector<Vec3> entries;
  std::vector<Vec3> approach;
  for (std::size_t i = 0; i < tool_count; ++i) {
    const std::vector<Vec3>& surface = set.bones[(2 + 3 * i) % set.bones.size()].surface.vertices;
    entries.push_back(surface[rng.below(surface.size())]);
    const Vec3 centre = set.bones[(2 + 3 * i) % set.bones.size()].body->interior_point();
    approach.push_back(normalized_or(entries.back() - centre, {0, 0, 1}));
  }
  for (std::size_t t = 0; t < kTicks; ++t) {
    for (BonePose& b : bones) {
      b.rotation = rotation_about(random_direction(rng), kStepRad / 10) * b.rotation;
      b.translation += random_direction(rng) * (kStepMm / 4) - b.translation * 0.1;
    }
    std::vector<ToolPose> tools;
    for (std::size_t i = 0; i < tool_count; ++i) {
      const double phase = 0.05 * static_cast<double>(t) + static_cast<double>(i);
      const Vec3 z = approach[i];
      const Vec3 x = any_perpendicular(z);
      tools.push_back({Mat3::from_columns(x, cross(z, x), z),
                       entries[i] + z * std::sin(phase) + x * (0.8 * std::sin(0.7 * phase))});
    }
    script.bones.push_back(bones);
    script.tools.push_back(std::move(tools));
  }
  return script;
}

/// 1: touching, 0: not, 2: too near to call, by pair (instrument, bone) and tick.
using Outcomes = std::vector<std::vector<std::uint8_t>>;

struct SurfaceRun {
  const SurfaceScript* script = nullptr;
  std::vector<ContactField> fields;
  std::vector<TriangleMesh> meshes;
  std::vector<TriangleMesh> tool_meshes;
};

Timing time_own(const SurfaceRun& run, bool cold, Outcomes* outcomes) {
  std::vector<std::vector<double>> passes;
  for (int pass = 0; pass < kPasses; ++pass) {
    contact::InstrumentScene scene(run.fields, instruments(), {.within_mm = kSureMm});
    scene.update(run.script->bones[0], run.script->tools[0]);
    std::vector<double> seconds;
    for (std::size_t t = 0; t < kTicks; ++t) {
      if (cold) scene.forget();
      const Stopwatch watch;
      scene.update(run.script->bones[t], run.script->tools[t]);
      seconds.push_back(watch.seconds());
      if (outcomes == nullptr || pass != 0) continue;
      std::vector<std::uint8_t> row;
      for (std::size_t i = 0; i < scene.instrument_count(); ++i) {
        for (std::size_t b = 0; b < scene.bone_count(); ++b) {
          const auto& c = scene.contact(i, b);
          const bool far = c.outcome == contact::ContactOutcome::Far;
          row.push_back(!far && std::abs(c.gap_mm) < kSureMm ? 2 : (c.has_contact() ? 1 : 0));
        }
      }
      outcomes->push_back(std::move(row));
    }
    passes.push_back(std::move(seconds));
  }
  return timing_of(passes);
}

#ifdef CARPUS_HAS_COLLISION_FCL_SURFACE
Timing time_peer(const SurfaceRun& run,
                 const Outcomes& outcomes,
                 bool distance,
                 double budget_seconds) {
  const auto peer = fcl_surface_peer(run.meshes, run.tool_meshes);
  std::vector<double> seconds;
  Timing counts;
  const Stopwatch total;
  for (std::size_t t = 0; t < kTicks && (t < 3 || total.seconds() < budget_seconds); ++t) {
    std::vector<std::uint8_t> touching;
    const Stopwatch watch;
    for (std::size_t i = 0; i < run.tool_meshes.size(); ++i) {
      for (std::size_t b = 0; b < run.meshes.size(); ++b) {
        const auto relative = run.script->bones[t][b].inverse() * run.script->tools[t][i];
        const convex::PairPose pose{relative.rotation, relative.translation};
        touching.push_back(distance ? peer->distance(b, i, pose) <= 0 : peer->collide(b, i, pose));
      }
    }
    seconds.push_back(watch.seconds());
    for (std::size_t p = 0; p < touching.size(); ++p) {
      if (outcomes[t][p] != 2) counts.wrong += touching[p] != outcomes[t][p];
    }
  }
  Timing timing = timing_of({seconds});
  timing.wrong = counts.wrong;
  return timing;
}
#endif

}  // namespace

std::vector<CollisionRow> surface_table(const BoneSet& bones, const BenchOptions& options) {
  SurfaceRun run;
  double facets = 0;
  for (const Bone& bone : bones.bones) {
    if (bone.surface.facets.empty()) {
      throw InvalidInput("table surface needs surfaces: give --bones, a folder of <bone>.ply");
    }
    std::fprintf(stderr, "field of %s\n", bone.name.c_str());
    run.fields.emplace_back(
        fields::build_distance_field(bone.surface, {.spacing_mm = kSpacingMm, .band_mm = kBandMm}),
        bone.surface);
    run.meshes.push_back(bone.surface);
    facets += static_cast<double>(bone.surface.facets.size());
  }
  const std::vector<InstrumentShape> shapes = instruments();
  for (const InstrumentShape& shape : shapes) run.tool_meshes.push_back(mesh_of(shape));
  const SurfaceScript script = make_script(bones, shapes.size());
  run.script = &script;
  Outcomes outcomes;
  std::vector<CollisionRow> rows;
  const auto add = [&](const std::string& engine, bool is_peer, const std::string& query,
                       const std::optional<Timing>& timing) {
    CollisionRow row{"instruments",
                     query,
                     engine,
                     is_peer,
                     facets / static_cast<double>(bones.bones.size()),
                     timing.has_value(),
                     {},
                     false,
                     0};
    if (timing) row.timing = *timing;
    row.agrees = timing && timing->wrong == 0;
    rows.push_back(row);
  };
  add("instrument_scene", false, "tick_distance", time_own(run, false, &outcomes));
  add("instrument_scene_cold", false, "tick_distance", time_own(run, true, nullptr));
#ifdef CARPUS_HAS_COLLISION_FCL_SURFACE
  for (const bool distance : {true, false}) {
    add(distance ? "fcl_bvh_distance" : "fcl_bvh_collide", true, "tick_distance",
        run_capped<Timing>(options.caps, [&] {
          return time_peer(run, outcomes, distance, options.budget_seconds);
        }));
  }
#else
  (void)options;
#endif
  return rows;
}

}  // namespace carpus::bench
