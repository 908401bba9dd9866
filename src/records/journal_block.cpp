// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/journal_block.hpp"

#include <algorithm>

#include "core/state_hash.hpp"

namespace carpus::records {

namespace {

/// With its place, so that a block which the disk left elsewhere is not taken for one that is due.
std::uint64_t checksum_of(std::uint64_t place,
                          std::uint8_t kind,
                          std::span<const std::byte> content) {
  StateHash hash;
  hash.add(place);
  hash.add(std::uint64_t{kind});
  hash.add_bytes(content);
  return hash.value();
}

void put(std::vector<std::byte>& bytes, std::uint64_t value, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
}

std::uint64_t get(std::span<const std::byte> bytes, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  }
  return value;
}

}  // namespace

std::vector<std::byte> encode_journal_block(std::uint64_t place,
                                            std::uint8_t kind,
                                            std::span<const std::byte> content) {
  std::vector<std::byte> bytes;
  bytes.reserve(kJournalBlockHead + content.size());
  put(bytes, content.size(), 4);
  put(bytes, kind, 1);
  put(bytes, checksum_of(place, kind, content), 8);
  bytes.insert(bytes.end(), content.begin(), content.end());
  return bytes;
}

JournalContent decode_journal(std::span<const std::byte> bytes) {
  JournalContent journal;
  const auto magic = std::as_bytes(std::span(kJournalMagic.data(), kJournalMagic.size()));
  if (bytes.size() < magic.size() || !std::equal(magic.begin(), magic.end(), bytes.begin())) {
    journal.torn_bytes = bytes.size();
    return journal;
  }
  std::size_t at = magic.size();
  while (bytes.size() - at >= kJournalBlockHead) {
    const auto head = bytes.subspan(at, kJournalBlockHead);
    const auto size = static_cast<std::size_t>(get(head, 4));
    const auto kind = static_cast<std::uint8_t>(head[4]);
    if (size > kMaxJournalBlock || size > bytes.size() - at - kJournalBlockHead) break;
    const auto content = bytes.subspan(at + kJournalBlockHead, size);
    if (get(head.subspan(5), 8) != checksum_of(at, kind, content)) break;
    journal.blocks.push_back({kind, {content.begin(), content.end()}});
    at += kJournalBlockHead + size;
  }
  journal.sound_size = at;
  journal.torn_bytes = bytes.size() - at;
  return journal;
}

}  // namespace carpus::records
