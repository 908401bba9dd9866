// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A box of a joint far from the bones, with a portal into it and a disc for its floor, and a hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "simulation/operation_test_support.hpp"
#include "simulation/world.hpp"

namespace carpus::simulation::box_joint {

/// The joint's middle. Its box is 24 by 24 by 6 mm; +z is distal, the disc is its floor.
inline const Vec3 kMiddle{150, 0, 0};
inline constexpr double kHalf = 12;
inline constexpr double kHalfHigh = 3;
inline constexpr double kDiscHalf = 6;
inline const Vec3 kEdge = kMiddle + Vec3{0, 4.5, -kHalfHigh};

inline Grid<float> box(const Vec3& middle = kMiddle) {
  GridGeometry geometry;
  geometry.size = {81, 81, 45};
  geometry.spacing = {0.4, 0.4, 0.4};
  geometry.origin = middle - Vec3{16, 16, 8.8};
  std::vector<float> values;
  for (int z = 0; z < 45; ++z) {
    for (int y = 0; y < 81; ++y) {
      for (int x = 0; x < 81; ++x) {
        const double dx = std::abs(x * 0.4 - 16) - kHalf;
        const double dy = std::abs(y * 0.4 - 16) - kHalf;
        const double dz = std::abs(z * 0.4 - 8.8) - kHalfHigh;
        const double outside = std::hypot(std::max(dx, 0.0), std::max(dy, 0.0), std::max(dz, 0.0));
        const double inside = std::min(0.0, std::max({dx, dy, dz}));
        values.push_back(static_cast<float>(std::clamp(outside + inside, -4.0, 4.0)));
      }
    }
  }
  return {geometry, values};
}

inline TriangleMesh disc_sheet() {
  constexpr int kCells = 12;
  TriangleMesh mesh;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      mesh.vertices.push_back(kMiddle + Vec3{kDiscHalf * (2.0 * i / kCells - 1),
                                             kDiscHalf * (2.0 * j / kCells - 1), -kHalfHigh - 0.7});
    }
  }
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(j * (kCells + 1) + i); };
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      mesh.facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

inline const cases::CaseData& box_wrist() {
  static const cases::CaseData data = [] {
    cases::CaseData made = test::wrist();
    auto map = std::make_shared<cases::ArthroscopicMap>();
    const std::uint8_t radius = test::body_of(BoneId::Radius);
    map->joints.push_back({"radiocarpal", "radiocarpal joint", box(), radius, radius});
    cases::Portal portal;
    portal.id = "3-4";
    portal.skin = kMiddle + Vec3{kHalf + 6, 0, 0};
    portal.inwards = {-1, 0, 0};
    portal.capsule_mm = 6;
    portal.body = radius;
    map->portals.push_back(portal);
    cases::TourPoint edge;
    edge.number = 16;
    edge.id = "foveal_insertion";
    edge.at = kEdge;
    edge.body = radius;
    edge.is_probed = true;
    map->points.push_back(edge);
    map->forearm = radius;
    map->disc_sheet = disc_sheet();
    map->distal = {0, 0, 1};
    made.arthroscopy = map;
    return made;
  }();
  return data;
}

/// The box with a ligament for its ceiling, fibres along y from the radius to the lunate, and the
/// places of the tour by which it is torn.
inline const cases::CaseData& box_wrist_with_ligament() {
  static const cases::CaseData data = [] {
    constexpr std::size_t kRows = 12;
    constexpr std::size_t kColumns = 6;
    cases::CaseData made = box_wrist();
    auto map = std::make_shared<cases::ArthroscopicMap>(*made.arthroscopy);
    cases::LigamentBand band;
    band.id = "scapholunate";
    band.first = test::body_of(BoneId::Radius);
    band.second = test::body_of(BoneId::Lunate);
    band.rows = kRows;
    band.columns = kColumns;
    band.thickness_mm = 1;
    band.along_n_per_mm = 100;
    for (std::size_t r = 0; r < kRows; ++r) {
      for (std::size_t c = 0; c < kColumns; ++c) {
        band.at.push_back(kMiddle + Vec3{static_cast<double>(r) - 5.5, static_cast<double>(c) - 2.5,
                                         kHalfHigh + 0.5});
        band.inwards.push_back({0, 0, -1});
      }
    }
    map->bands.push_back(band);
    for (const char* id : {"sl_ligament", "sl_gap"}) {
      cases::TourPoint point;
      point.number = 20;
      point.id = id;
      point.at = kMiddle + Vec3{0, 0, kHalfHigh};
      point.body = band.first;
      map->points.push_back(point);
    }
    made.arthroscopy = map;
    // So that its volar, along which it is torn, is across the fibres.
    made.wrist_from_patient = {Mat3::from_columns({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), {}};
    return made;
  }();
  return data;
}

inline procedure::Opening open_beside(const cases::CaseData&) {
  procedure::Opening opening;
  opening.shaft_in_target = {1, 0, 0};
  opening.tip_in_target = kMiddle + Vec3{40, 0, 0};
  return opening;
}

inline procedure::Procedure probing(bool examines) {
  procedure::Procedure made = test::exercise();
  made.target = BoneId::Radius;
  made.tray = {*instruments::instrument_of("hook_probe")};
  for (procedure::Step& step : made.steps) step.instrument = instruments::kNoInstrument;
  made.opening = open_beside;
  made.examines = examines;
  return made;
}

inline const procedure::Procedure& probe_alone() {
  static const procedure::Procedure kProcedure = probing(false);
  return kProcedure;
}

/// The probe's wish goes straight from place to place at 20 mm/s.
class Hand {
 public:
  explicit Hand(World& world) : world_(world) {
    input_.hands[0].tip_in_patient = kMiddle + Vec3{40, 0, 0};
    input_.hands[0].shaft_in_patient = {1, 0, 0};
    input_.hands[1] = input_.hands[0];
  }
  void go(const Vec3& to, int then_ticks = 0) {
    Vec3& tip = input_.hands[led].tip_in_patient;
    while (distance(tip, to) > 1e-9) {
      const double far = distance(tip, to);
      tip = far <= mm_per_tick ? to : tip + (to - tip) * (mm_per_tick / far);
      step();
    }
    for (int i = 0; i < then_ticks; ++i) step();
  }
  /// There at once.
  void lead(const Vec3& to) {
    input_.hands[0].tip_in_patient = to;
    step();
  }
  void step() {
    const Snapshot& now = world_.step(input_);
    inputs.push_back(input_);
    if (listener) listener(now);
  }
  void command(const Command& command) {
    input_.command = command;
    step();
    input_.command = {};
  }
  [[nodiscard]] const Snapshot& now() const { return world_.now(); }
  [[nodiscard]] Vec3 tip() const { return now().items[0].tip_in_patient; }
  void pull(double newtons) { input_.wrist.traction_n = newtons; }
  void bend(double flexion_rad) { input_.wrist.flexion_rad = flexion_rad; }
  void drive(Driver driver) {
    input_.hands[led].driver = driver;
    step();
  }
  std::uint8_t led = 0;  ///< the hand that goes; the other one stays
  std::vector<Input> inputs;
  std::function<void(const Snapshot&)> listener;  ///< told of each tick
  double mm_per_tick = 0.02;

 private:
  World& world_;
  Input input_;
};

inline void enter(Hand& hand) {
  hand.go(kMiddle + Vec3{kHalf + 2, 0, 0});
  hand.go(kMiddle + Vec3{0, 0, 0});
}

}  // namespace carpus::simulation::box_joint
