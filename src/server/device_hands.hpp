// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Devices as hands: where a device moves, the instrument's tip is wished, on the same input that a
// page's hand has; what the tip meets, or is about to, goes back as planes in the device's frame,
// with what the tool does (haptics/operation_feel). A device that gives forces is pushed with:
// thrust is what its hand presses. One that says how its tool rolls turns the scope that it holds.
// The driver is the page's. In the simulation's thread.
#pragma once

#include <array>

#include "devices/host_loop.hpp"
#include "haptics/operation_feel.hpp"
#include "server/device_aim.hpp"
#include "server/tick_guest.hpp"

namespace carpus::server {

/// How a device's axes lie in the patient: as on the screen of whoever holds it.
struct DeviceView {
  Vec3 right_in_patient{1, 0, 0};
  Vec3 up_in_patient{0, 0, 1};
  bool is_used = false;        ///< the hand is a device's
  Aim aim = Aim::Page;         ///< what the shaft follows
  std::uint32_t revision = 0;  ///< raised with each change: the tip stays, whatever else turns
};

class DeviceHands final : public TickGuest {
 public:
  /// For the loops of the devices; it lives as long as this.
  [[nodiscard]] devices::DeviceExchange& exchange(std::size_t hand) noexcept {
    return hands_[hand].exchange;
  }
  /// By the network's thread.
  void set_view(std::size_t hand, const DeviceView& view) noexcept {
    hands_[hand].views.publish(view);
  }

  void before(simulation::Input& input, const simulation::Snapshot& last) noexcept override;
  void after(const simulation::Snapshot& now) noexcept override;

  /// As they would be on some clock: for tests.
  void before_at(devices::Nanoseconds now,
                 simulation::Input& input,
                 const simulation::Snapshot& last) noexcept;
  void after_at(devices::Nanoseconds now, const simulation::Snapshot& snapshot) noexcept;

 private:
  struct Hand {
    devices::DeviceExchange exchange;
    LatestValue<DeviceView> views;
    // The simulation's thread's own:
    DeviceView view;
    devices::LoopState state;
    bool is_engaged = false;  ///< its moves count from the anchors
    std::uint8_t item = simulation::kNoItem;
    Vec3 device_anchor_mm;
    Vec3 tip_anchor_mm;
    Vec3 tip_in_patient;  ///< wished in the last tick
    DeviceAim aim;
    bool turns_scope = false;  ///< the roll counts from the anchors
    double roll_anchor_deg = 0;
    double turn_anchor_deg = 0;
    double turned_deg = 0;  ///< the scope's shaft, as it was last seen or asked for
    simulation::Driver driver = simulation::Driver::Off;
    double depth_mm = 0;  ///< of what it holds, at the last tick
    haptics::OperationFeel feel{haptics::feel_table()};
    devices::Nanoseconds ticked_ns = 0;
  };

  void guide(Hand& hand,
             devices::Nanoseconds now,
             simulation::HandInput& input,
             const simulation::Snapshot& last,
             std::size_t index) noexcept;
  static void engage(Hand& hand,
                     const simulation::HandInput& input,
                     const simulation::Snapshot& last) noexcept;
  /// At most one command a tick, and only where nobody else has one.
  static void turn_scope(Hand& hand,
                         simulation::Command& command,
                         const simulation::Snapshot& last,
                         std::size_t index) noexcept;
  static void press(const Hand& hand,
                    simulation::HandInput& input,
                    const simulation::Snapshot& last) noexcept;
  [[nodiscard]] static haptics::FeltMoment moment_of(Hand& hand,
                                                     const simulation::Snapshot& snapshot,
                                                     std::size_t index) noexcept;

  std::array<Hand, simulation::kHands> hands_;
};

}  // namespace carpus::server
