// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A disk that fails when it is told to: the C library's functions that change files are replaced in
// this program, for our code and SQLite's alike. It knows of one folder what a power cut leaves:
// the bytes of a file as of its last flush, the names as of the folder's last flush.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

namespace carpus::durability {

/// What of the bytes that were not flushed a power cut leaves.
enum class Unflushed : std::uint8_t {
  Nothing,    ///< they are gone
  SomePages,  ///< any of their pages are there, in no order; names too
};

struct DiskPlan {
  std::filesystem::path folder;  ///< the files that it is about
  std::uint64_t fail_at = 0;     ///< this change of the folder fails: no space, or no flush; 0 none
  bool fails_for_good = false;   ///< and every later one
  std::uint64_t cut_at = 0;      ///< before this change the power is cut; 0 never
  std::filesystem::path after;   ///< empty folder for what the cut leaves
  Unflushed unflushed = Unflushed::Nothing;
  std::uint64_t seed = 1;
  std::function<void()> on_cut;  ///< called first when the power is cut
};

/// Exit status of a process whose power was cut.
inline constexpr int kPowerCut = 42;

/// From now on. One plan a process.
void begin(const DiskPlan& plan);
/// The disk is well again.
void mend();
/// Changes of the folder so far.
[[nodiscard]] std::uint64_t changes();

}  // namespace carpus::durability
