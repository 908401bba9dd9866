// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "device_bench/rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "device_bench/measures.hpp"
#include "device_bench/our_rig.hpp"

namespace carpus::device_bench {
namespace {

constexpr double kRatedNPerMm = 2;
constexpr std::array kTrials{0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0,
                             3.0,  4.0, 5.0, 6.0, 7.0, 8.0,  9.0, 10.0};
constexpr double kSoftestToLetGo = 0.5;
constexpr std::array kSpeedsMmPerS{50.0, 100.0, 200.0, 500.0};
constexpr double kThird = 0.57735026918962576;
constexpr std::array<Vec3, 5> kNormals{
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}, {kThird, kThird, kThird}, {-0.6, 0, -0.8}}};

bool rings(const RigOptions& options) {
  const auto rig = make_rig(options);
  const Press pressed = press(*rig);
  return !rig->plant().is_sound() || !pressed.is_still(rig->quantum_mm());
}

double largest_stable(RigOptions options) {
  double largest = 0;
  for (const double stiffness : kTrials) {
    // Into anything softer the hand that is to let go sinks out of the workspace.
    if (options.hand.stiffness_n_per_mm == 0 && stiffness < kSoftestToLetGo) continue;
    options.stiffness_n_per_mm = stiffness;
    if (rings(options)) break;
    largest = stiffness;
  }
  return largest;
}

double own_stiffness(const Press& pressed) {
  // An arm whose gears alone are felt so much before the wall begins at the wall.
  const double way = pressed.depth_mm - std::max(pressed.half_depth_mm, -0.5);
  return way > 0.01 ? 0.75 * pressed.force_n / way : 0;
}

/// Stages of a chain whose parts were each timed.
Stage stage_of(std::string name, std::vector<double> times_us) {
  if (times_us.empty()) return {std::move(name), 0, 0};
  std::sort(times_us.begin(), times_us.end());
  return {std::move(name), times_us[times_us.size() / 2], times_us.back()};
}

/// From a change of what the host wishes until the drive's torque has gone two thirds of its way.
std::vector<double> times_to_force(firmware::Drive drive, const BoardMaker& board) {
  std::vector<double> times;
  for (int trial = 0; trial < 20; ++trial) {
    RigOptions options;
    options.drive = drive;
    options.board = board;
    options.hand = virtual_arm::kHandModels[2];
    OurRig rig(options);
    rig.set_wall(false);
    // At another place of the servo's frame each time.
    for (int ms = 0; ms < 300 + trial; ++ms) rig.run_ms();
    const auto along = [&rig] {
      return force_of(rig.plant().linkage_state(), rig.arm().torques()).z;
    };
    const double before = along();
    if (drive == firmware::Drive::Motor) {
      rig.besides_n = {0, 0, 1.5};
    } else {
      rig.raise_wall_mm = 13;  // 3 mm above where the tip is
      rig.set_wall(true);
    }
    double us = 0;
    bool is_there = false;
    const double begun = rig.arm().now_us();
    rig.on_step = [&] {
      if (!is_there && along() - before > 1.0) {
        is_there = true;
        us = rig.arm().now_us() - begun;
      }
    };
    for (int ms = 0; ms < 600 && !is_there; ++ms) rig.run_ms();
    if (is_there) times.push_back(us);
  }
  return times;
}

}  // namespace

Row measure_row(Law law,
                firmware::Drive drive,
                const HandModel& hand,
                int seeds,
                const BoardMaker& board) {
  Row row;
  row.law = law;
  row.drive = drive;
  row.hand = hand;
  row.has_free_space = row.has_penetration = hand.stiffness_n_per_mm > 0;
  row.largest_stable_n_per_mm = 1e9;
  for (int seed = 1; seed <= seeds; ++seed) {
    RigOptions options;
    options.law = law;
    options.drive = drive;
    options.hand = hand;
    options.seed = static_cast<std::uint64_t>(seed);
    options.board = board;
    options.stiffness_n_per_mm = kRatedNPerMm;
    double own = 0;
    double down = 0;
    double worst = 0;
    bool is_ringing = false;
    for (const Vec3& normal : kNormals) {
      options.normal = normal;
      const auto rig = make_rig(options);
      const Press pressed = press(*rig);
      const bool is_down = &normal == &kNormals.front();
      if (is_down) own = own_stiffness(pressed);
      if (is_down) down = pressed.depth_mm;
      worst = std::max(worst, pressed.depth_mm);
      if (!rig->plant().is_sound() || !pressed.is_still(rig->quantum_mm())) is_ringing = true;
    }
    options.normal = kNormals.front();
    const double stable = drive == firmware::Drive::Motor ? largest_stable(options) : own;
    row.largest_stable_n_per_mm = std::min(row.largest_stable_n_per_mm, stable);
    if (is_ringing) {
      // How deep it is then says nothing: as hard as it can be without.
      row.limit_cycle = true;
      options.stiffness_n_per_mm = stable;
      down = worst = press(*make_rig(options)).depth_mm;
      options.stiffness_n_per_mm = kRatedNPerMm;
    }
    row.penetration_mm_at_2n = std::max(row.penetration_mm_at_2n, down);
    row.penetration_worst_mm_at_2n = std::max(row.penetration_worst_mm_at_2n, worst);
    for (const double speed : kSpeedsMmPerS) {
      const auto rig = make_rig(options);
      const Strike struck = strike(*rig, speed);
      row.energy_returned_mj = std::max(row.energy_returned_mj, struck.most_given_mj);
      row.pull_back_n = std::max(row.pull_back_n, struck.pulled_back_n);
    }
    if (row.has_free_space) {
      const auto rig = make_rig(options);
      row.free_space_n = std::max(row.free_space_n, free_space_n(*rig));
    }
  }
  return row;
}

std::vector<Stage> measure_latency(Law law, firmware::Drive drive, const BoardMaker& board) {
  std::vector<Stage> stages;
  if (law == Law::Thesis) {
    // By its construction: a move waits for its frame of 20 ms.
    if (drive == firmware::Drive::Stop) {
      stages.push_back({"sensors: three conversions of the card", 30, 30});
    }
    stages.push_back({"wait for the next frame of 20 ms", 10'000, 20'000});
    if (drive == firmware::Drive::Stop) stages.push_back({"pulse of the servo", 1500, 2000});
    return stages;
  }
  RigOptions options;
  options.drive = drive;
  options.board = board;
  OurRig rig(options);
  for (int ms = 0; ms < 1500; ++ms) rig.run_ms();
  if (drive == firmware::Drive::Stop) {
    stages.push_back(stage_of("age of the sample when its frame leaves", rig.sample_ages_us()));
  }
  // Without the first, of the calibration's longer frames.
  const std::vector<double>& trips = rig.round_trips_us();
  stages.push_back(
      stage_of("round trip host, line, firmware, line, host",
               {trips.begin() + std::min<std::ptrdiff_t>(20, std::ssize(trips)), trips.end()}));
  stages.push_back(stage_of(drive == firmware::Drive::Stop
                                ? "a stop 3 mm into the tip until it pushes with 1 N"
                                : "a force until two thirds of it are there",
                            times_to_force(drive, board)));
  return stages;
}

}  // namespace carpus::device_bench
