// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A world's state as bytes, for keyframes: every field in the order of its struct's visit(), all
// little-endian, then the tissue's changes, then a checksum. Undo does not reach back before one.
#include <bit>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "core/state_hash.hpp"
#include "simulation/detail/bytes.hpp"
#include "simulation/detail/world_state.hpp"

namespace carpus::simulation {

namespace {

struct WriteFields {
  detail::Writer& out;
  void operator()(const Vec3& v) const {
    out.put(v.x);
    out.put(v.y);
    out.put(v.z);
  }
  void operator()(double value) const { out.put(value); }
  template <typename T>
  void operator()(const T& value) const {
    out.put(static_cast<std::uint64_t>(value), sizeof(T));
  }
};

/// Refuses numbers that are not finite: no tick left them.
struct ReadFields {
  detail::Reader& in;
  bool& is_sound;
  void operator()(double& value) const {
    value = in.get_double();
    is_sound = is_sound && is_finite(Vec3{value, 0, 0});
  }
  void operator()(Vec3& v) const {
    (*this)(v.x);
    (*this)(v.y);
    (*this)(v.z);
  }
  template <typename T>
  void operator()(T& value) const {
    const std::uint64_t bits = in.get(sizeof(T));
    if constexpr (std::is_same_v<T, bool>) {
      is_sound = is_sound && bits <= 1;
      value = bits != 0;
    } else {
      value = static_cast<T>(bits);
    }
  }
};

/// Whether every index in it names something; what a hostile keyframe would bend.
bool are_indices_sound(const detail::Operated& now,
                       const detail::Spent& spent,
                       std::size_t bodies,
                       std::size_t instruments) {
  const auto is_in = [](std::uint8_t index, std::size_t count) {
    return index == 255 || index < count;
  };
  for (std::uint8_t i = 0; i < kMaxItems; ++i) {
    const detail::Item& item = now.items[i];
    if (!is_in(item.instrument, instruments)) return false;
    if (!item.is_there()) continue;
    const bool is_known = is_in(item.hand, kHands) && is_in(item.body, bodies) &&
                          is_in(item.wire, kMaxItems) && item.wire != i &&
                          is_in(item.hole, now.hole_count) && is_in(item.pass, detail::kMaxPasses);
    if (!is_known || item.crossing_count > detail::kMaxCrossings) return false;
    for (std::size_t c = 0; c < item.crossing_count; ++c) {
      if (item.crossings[c].body >= bodies) return false;
    }
    if (item.hand < kHands && now.held[item.hand] != i) return false;
    if (item.wire < kMaxItems &&
        (!now.items[item.wire].is_there() || !now.items[item.wire].is_fixed() ||
         now.items[item.wire].wire < kMaxItems || !item.is_fixed())) {
      return false;
    }
  }
  for (std::uint8_t h = 0; h < kHands; ++h) {
    const std::uint8_t held = now.held[h];
    if (!is_in(held, kMaxItems)) return false;
    if (held < kMaxItems && (!now.items[held].is_there() || now.items[held].hand != h)) {
      return false;
    }
    const HandInput& wish = spent.hands[h].wish;
    if (static_cast<unsigned>(wish.driver) > 2 || static_cast<unsigned>(wish.guidance) > 1) {
      return false;
    }
    if (!is_in(spent.hands[h].touched_body, bodies)) return false;
    if (spent.hands[h].plan.phase > HandPhase::Lowering) return false;
  }
  for (std::size_t i = 0; i < now.track_count; ++i) {
    if (now.tracks[i].body >= bodies) return false;
  }
  // While the pedal is down a look is on record.
  const bool is_live_sound = spent.live_ticks == 0 || spent.shot_count > 0;
  return now.track_count <= kMaxTracks && spent.shot_count <= kMaxShots && is_live_sound;
}

}  // namespace

std::vector<std::byte> World::write_state() const {
  const State& state = *state_;
  detail::Writer out;
  const WriteFields fields{out};
  visit(state.now, fields);
  visit(state.spent, fields);
  for (std::size_t i = 0; i < state.spent.shot_count; ++i) {
    detail::visit_shot(state.shots[i], fields);
  }
  state.tissue.cuts().write_to(out.bytes());
  StateHash hash;
  hash.add_bytes(out.bytes());
  out.put(hash.value(), 8);
  return std::move(out.bytes());
}

Result<bool> World::read_state(std::span<const std::byte> bytes) {
  constexpr std::size_t kChecksum = 8;
  if (bytes.size() < kChecksum) return carpus::Refusal{"keyframe: cut off"};
  const std::span<const std::byte> body = bytes.first(bytes.size() - kChecksum);
  StateHash hash;
  hash.add_bytes(body);
  detail::Reader end(bytes.last(kChecksum));
  if (end.get(8) != hash.value())
    return carpus::Refusal{"keyframe: damaged, its checksum does not match"};

  auto next = std::make_unique<State>(*model_);
  detail::Reader in(body);
  bool is_sound = true;
  const ReadFields fields{in, is_sound};
  visit(next->now, fields);
  visit(next->spent, fields);
  is_sound = is_sound && !in.is_spoilt() &&
             are_indices_sound(next->now, next->spent, model_->data.bones.size(),
                               model_->catalogue.size());
  if (!is_sound) return carpus::Refusal{"keyframe: its state is not one that a tick could leave"};
  for (std::size_t i = 0; i < next->spent.shot_count; ++i) {
    detail::visit_shot(next->shots[i], fields);
  }
  for (std::size_t i = 0; i < next->spent.shot_count; ++i) {
    is_sound = is_sound && next->shots[i].look <= procedure::Look::LiveOn;
  }
  if (!is_sound || in.is_spoilt()) return carpus::Refusal{"keyframe: cut off among the shots"};
  const Result<std::size_t> tissue = next->tissue.cuts().read_from(body.subspan(in.at()));
  if (!tissue) return carpus::Refusal{"keyframe: " + tissue.error()};
  next->pose_bodies(*model_);
  next->carry_fixed_items();
  for (std::uint8_t h = 0; h < kHands; ++h) {
    if (const detail::Item* item = next->in_hand(h)) {
      next->scene.set_instrument(h, next->kind_of(*model_, *item).shape);
    }
  }
  next->snapshot.state_hash = next->spent.hash;
  next->publish_state(*model_);
  state_ = std::move(next);
  return true;
}

}  // namespace carpus::simulation
