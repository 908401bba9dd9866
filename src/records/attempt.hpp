// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What is kept of one attempt at a procedure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::records {

/// How an attempt ended.
enum class Outcome : std::uint8_t {
  Unfinished = 0,  ///< the page was closed, the host stopped, or another attempt was begun
  Finished = 1,    ///< the trainee ended the operation; there is a score
};

/// "unfinished" or "finished": as in the database, JSON and the page.
[[nodiscard]] std::string_view name_of(Outcome outcome) noexcept;

/// What finished ASSET forms of an attempt say together.
struct AssetSummary {
  std::int64_t forms = 0;
  std::int64_t passed = 0;  ///< forms by which it passes
  double mean_total = 0;
  bool operator==(const AssetSummary&) const = default;
};

/// What the list of attempts shows.
struct AttemptSummary {
  std::int64_t id = 0;    ///< given by the store; 0 until stored
  std::string origin;     ///< no two attempts have the same; empty in records from before
  std::string trainee;    ///< as typed; may be empty
  std::string case_name;  ///< the case's pseudonym
  std::string case_fingerprint;
  std::optional<bool> case_simulated;  ///< not scanned from a person; none in records from before
  std::string procedure;               ///< "dorsal_scaphoid_fixation"
  std::string mode;                    ///< "practice", "assessed"; empty in records from before
  std::string input_device;            ///< "mouse", "script", …
  std::string started_at;              ///< UTC, ISO 8601
  std::string ended_at;                ///< UTC, ISO 8601
  Outcome outcome = Outcome::Unfinished;
  std::optional<double> overall;     ///< score, 0 to 100; none when unfinished
  std::uint64_t duration_ticks = 0;  ///< simulated time [ms]
  std::string final_hash;            ///< state hash after the last tick, 16 hexadecimal digits
  /// Of those that are in the records; not stored with the attempt.
  std::optional<AssetSummary> asset = std::nullopt;
  bool operator==(const AttemptSummary&) const = default;
};

/// All of it.
struct Attempt {
  AttemptSummary summary;
  std::string score_json;            ///< protocol's `stored_score`; empty when unfinished
  std::string events_json;           ///< protocol's `stored_events`
  std::vector<std::byte> recording;  ///< every tick's input; see simulation/recording.hpp
  bool operator==(const Attempt&) const = default;
};

}  // namespace carpus::records
