// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// An arm, its host, a hand and one wall on one clock: what every law and drive is measured in.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "firmware/core/wire.hpp"
#include "haptics/local_planes.hpp"
#include "virtual_arm/stop_board.hpp"
#include "virtual_arm/virtual_arm.hpp"

namespace carpus::device_bench {

using virtual_arm::HandModel;

enum class Law : std::uint8_t {
  Thesis,  ///< motors off in free space, on at collision [yaacoub2008] figure 6.8
  Ours,    ///< drive A: programmable stop; drive B: local planes
};

/// The board that runs drive A's firmware; empty: the core compiled for the host.
using BoardMaker = std::function<std::unique_ptr<virtual_arm::StopBoard>()>;

struct RigOptions {
  Law law = Law::Ours;
  firmware::Drive drive = firmware::Drive::Motor;
  HandModel hand = virtual_arm::kHandModels[1];
  std::uint64_t seed = 1;
  /// Unit, out of the bone, in the device's frame.
  Vec3 normal{0, 0, 1};
  /// Asked of it where the law computes a spring.
  double stiffness_n_per_mm = 2;
  BoardMaker board;
};

/// What a bad line or host does, of each frame.
struct LineFaults {
  double corrupt = 0;
  double lost = 0;
  double doubled = 0;
  double reordered = 0;
  bool host_is_silent = false;
};

class Rig {
 public:
  explicit Rig(const RigOptions& options);
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;
  virtual ~Rig() = default;

  [[nodiscard]] virtual virtual_arm::ArmPlant& plant() = 0;
  /// One tick of the host.
  virtual void run_ms() = 0;
  /// Places that a pulse or an encoder tells apart, at the tip [mm].
  [[nodiscard]] virtual double quantum_mm() const = 0;
  /// Whether the drives can still push, not only resist.
  [[nodiscard]] virtual bool is_driven() const = 0;

  /// Where measures begin, ten millimetres outside the wall.
  [[nodiscard]] Vec3 start() const { return start_; }
  [[nodiscard]] const RigOptions& options() const { return options_; }
  void set_wall(bool is_there) { has_wall_ = is_there; }
  [[nodiscard]] bool has_wall() const { return has_wall_; }
  [[nodiscard]] haptics::SurfacePlane wall() const;
  /// Into the wall, where the sensors see the tip [mm].
  [[nodiscard]] double depth_mm();
  /// Of the arm on the hand, out of the wall [N].
  [[nodiscard]] double felt_along_n();

  /// Of the drives at the tip, without holding its weight, out of the wall [N].
  [[nodiscard]] double driven_along_n();

  /// Work that the drives did on the arm since the last reset, without holding its weight [mJ].
  [[nodiscard]] double given_mj() const { return given_mj_; }
  /// The most that it ever was since then.
  [[nodiscard]] double most_given_mj() const { return most_given_mj_; }
  void reset_given() { given_mj_ = most_given_mj_ = 0; }

  /// After every step of the plant.
  std::function<void()> on_step;
  LineFaults faults;
  /// Moves the wall out of the bone, towards the start.
  double raise_wall_mm = 0;

 protected:
  /// To be called after every step of the plant. @param torques  of the drives @param held  of them
  /// those that hold the weight.
  void book(double seconds,
            const virtual_arm::JointValues& torques,
            const virtual_arm::JointValues& held);
  void set_start(const Vec3& start) { start_ = start; }

 private:
  RigOptions options_;
  Vec3 start_;
  bool has_wall_ = true;
  virtual_arm::JointValues booked_{};
  double given_mj_ = 0;
  double most_given_mj_ = 0;
};

[[nodiscard]] std::unique_ptr<Rig> make_rig(const RigOptions& options);

}  // namespace carpus::device_bench
