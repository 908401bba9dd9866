// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a keyframe with the checksum that a forger would make: refused and nothing changed,
// or a state from which ticks go on as from any other: finite, within the limits of force and of
// the wrist, fit to be scored, and a keyframe again.
// First u16 size of the state, the state, what was cut: each of the two gets its checksum.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "checksum.hpp"
#include "haptics/virtual_coupling.hpp"
#include "refusals.hpp"
#include "simulation/operation_test_support.hpp"

namespace {

using namespace carpus;
using simulation::Snapshot;
using simulation::World;
using simulation::test::exercise;
using simulation::test::wrist;

constexpr int kTicks = 12;

void require_sound(const Snapshot& now) {
  for (const simulation::HandView& hand : now.hands) {
    fuzz::require(length(hand.force_in_patient) <= haptics::kForceLimitN * 1.001);
    fuzz::require(hand.item == 255 || hand.item < simulation::kMaxItems);
  }
  for (const simulation::ItemView& item : now.items) {
    if (item.instrument == 255) continue;
    fuzz::require(item.instrument < instruments::catalogue().size());
    fuzz::require(is_finite(item.tip_in_patient) && is_finite(item.shaft_in_patient));
    fuzz::require(std::isfinite(item.depth_mm) && std::isfinite(item.buried_mm));
  }
  for (std::size_t b = 0; b < now.body_count; ++b) {
    fuzz::require(is_finite(now.patient_from_bone[b].translation));
  }
  fuzz::require(std::abs(now.wrist.flexion_rad) < 2 && std::abs(now.wrist.pronation_rad) < 2);
  fuzz::require(now.shots <= simulation::kMaxShots && now.step <= exercise().steps.size());
}

/// Two hands that do all they can.
simulation::Input input_of(const Snapshot& now, int tick) {
  using simulation::CommandKind;
  simulation::Input input;
  input.wrist = now.wrist;
  input.wrist.flexion_rad += 0.01;
  for (std::size_t h = 0; h < simulation::kHands; ++h) {
    const std::uint8_t item = now.hands[h].item;
    if (item < simulation::kMaxItems) {
      input.hands[h].tip_in_patient = now.items[item].tip_in_patient;
      input.hands[h].shaft_in_patient = now.items[item].shaft_in_patient;
    }
    input.hands[h].tip_in_patient.x += 0.05;
    input.hands[h].thrust_n = 30;
    input.hands[h].driver =
        tick % 5 == 4 ? simulation::Driver::Reverse : simulation::Driver::Forward;
    if (tick % 2 == 1) input.hands[h].guidance = simulation::Guidance::Planned;
  }
  input.c_arm = {10, 0, tick % 4 != 3};
  constexpr std::array kCommands{
      CommandKind::None,   CommandKind::TakeShot, CommandKind::PutDown, CommandKind::ReadGauge,
      CommandKind::PickUp, CommandKind::Undo,     CommandKind::Take,    CommandKind::Finish};
  if (tick >= 4) {
    input.command.kind = kCommands[static_cast<std::size_t>(tick - 4) % kCommands.size()];
    input.command.hand = static_cast<std::uint8_t>(tick % 2);
    input.command.index = static_cast<std::uint8_t>(tick % 3);
  }
  return input;
}

/// What a forger would give for these bytes.
std::vector<std::byte> keyframe_of(std::span<const std::byte> bytes) {
  const auto low = static_cast<std::size_t>(bytes[0]);
  const auto high = static_cast<std::size_t>(bytes[1]);
  const auto rest = bytes.subspan(2);
  const std::size_t state = std::min(rest.size(), low + 256 * high);
  const auto tissue = fuzz::with_checksum(rest.subspan(state));
  std::vector<std::byte> whole(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(state));
  whole.insert(whole.end(), tissue.begin(), tissue.end());
  return fuzz::with_checksum(whole);
}

/// Made before the first input: its seconds are none of that input's.
World world(wrist(), exercise(), 1);
const std::vector<std::byte> first = world.write_state();

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::vector<std::byte> given = keyframe_of(std::as_bytes(std::span(data, size)));
  const std::uint64_t before = world.now().state_hash;
  const auto taken = world.read_state(given);
  if (!taken) {
    fuzz::require(taken.error().starts_with("keyframe: ") && world.now().state_hash == before);
    return 0;
  }
  ++fuzz::accepted;
  require_sound(world.now());
  for (int tick = 0; tick < kTicks; ++tick) require_sound(world.step(input_of(world.now(), tick)));
  const procedure::OperationRecord record = world.operation_record();
  for (const procedure::Pass& pass : record.passes) {
    fuzz::require(pass.instrument < instruments::catalogue().size());
  }
  const std::vector<std::byte> left = world.write_state();
  fuzz::require(world.read_state(left).has_value() && world.write_state() == left);
  fuzz::require(world.read_state(first).has_value());
  return 0;
}
