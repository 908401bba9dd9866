// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a journal, and as the blocks of one with the checksums that a forger would make:
// what is whole comes back, what is none is refused in words, an exercise that is accepted adds up.
// As blocks: u8 kind, u16 size, content; a block of kind 5 (the recording) gets its checksum too.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bytes.hpp"
#include "checksum.hpp"
#include "records/journal_block.hpp"
#include "refusals.hpp"
#include "server/exercise_journal.hpp"

namespace {

using namespace carpus;
using records::JournalContent;

constexpr std::uint8_t kRecordingKind = 5;

void try_to_read(const JournalContent& journal) {
  const auto head = server::read_head(journal);
  const auto exercise = server::read_exercise(journal);
  if (!exercise) return fuzz::require(!exercise.error().empty());
  ++fuzz::accepted;
  fuzz::require(head.has_value() && head->origin == exercise->head.origin);
  const auto ticks = exercise->recording.tick_count();
  for (const auto& event : exercise->log) {
    fuzz::require(static_cast<std::uint64_t>(event.tick) <= ticks);
  }
  std::uint64_t before = 0;
  for (const auto& keyframe : exercise->recording.keyframes) {
    fuzz::require(keyframe.tick <= ticks && (before == 0 || keyframe.tick > before));
    before = keyframe.tick;
  }
}

std::vector<std::byte> journal_of(const std::uint8_t* data, std::size_t size, std::size_t& blocks) {
  const auto magic = std::as_bytes(std::span(records::kJournalMagic));
  std::vector<std::byte> journal(magic.begin(), magic.end());
  fuzz::Bytes in(data, size);
  while (in.left() >= 3) {
    const std::uint8_t kind = in.byte();
    const std::size_t claimed = in.byte() + 256U * in.byte();
    std::vector<std::byte> content(std::min(claimed, in.left()));
    for (std::byte& byte : content) byte = static_cast<std::byte>(in.byte());
    if (kind == kRecordingKind) content = fuzz::with_checksum(content);
    const auto block = records::encode_journal_block(journal.size(), kind, content);
    journal.insert(journal.end(), block.begin(), block.end());
    ++blocks;
  }
  return journal;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const JournalContent raw = records::decode_journal(std::as_bytes(std::span(data, size)));
  fuzz::require(raw.sound_size + raw.torn_bytes == size);
  try_to_read(raw);
  std::size_t blocks = 0;
  const std::vector<std::byte> journal = journal_of(data, size, blocks);
  const JournalContent made = records::decode_journal(journal);
  fuzz::require(made.blocks.size() == blocks && made.torn_bytes == 0);
  try_to_read(made);
  return 0;
}
