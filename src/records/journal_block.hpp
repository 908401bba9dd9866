// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A journal: a file that only grows, of blocks that are whole or cut away. It is written while
// something happens, so that a killed program or a pulled plug loses what was on the way, not what
// was done. It does not know what its blocks mean.
//
// Layout, little-endian: "CARPJRN1"; then blocks: u32 size of the content, u8 kind, u64 FNV-1a of
// the block's place in the file, its kind and its content, the content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace carpus::records {

inline constexpr std::string_view kJournalMagic = "CARPJRN1";
/// Bytes of a block before its content.
inline constexpr std::size_t kJournalBlockHead = 13;
/// No block is larger: bounds what reading a damaged size may take.
inline constexpr std::size_t kMaxJournalBlock = std::size_t{1} << 26U;

struct JournalBlock {
  std::uint8_t kind = 0;
  std::vector<std::byte> content;
  bool operator==(const JournalBlock&) const = default;
};

/// Its bytes at this place of the file.
[[nodiscard]] std::vector<std::byte> encode_journal_block(std::uint64_t place,
                                                          std::uint8_t kind,
                                                          std::span<const std::byte> content);

/// What can be read of a journal.
struct JournalContent {
  std::vector<JournalBlock> blocks;  ///< those that are whole, up to the first that is not
  std::uint64_t sound_size = 0;      ///< bytes up to there: what is written next goes there
  std::uint64_t torn_bytes = 0;      ///< bytes after it
};

/// Never more than the bytes that are there.
[[nodiscard]] JournalContent decode_journal(std::span<const std::byte> bytes);

}  // namespace carpus::records
