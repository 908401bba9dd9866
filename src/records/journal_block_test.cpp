// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "records/journal_block.hpp"

#include <gtest/gtest.h>

#include <string>

namespace carpus::records {
namespace {

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  return {bytes.begin(), bytes.end()};
}

const std::vector<JournalBlock>& blocks() {
  static const std::vector<JournalBlock> made{
      {1, bytes_of("a header")}, {2, {}}, {2, bytes_of("what was done")}, {255, bytes_of("x")}};
  return made;
}

std::vector<std::byte> journal() {
  std::vector<std::byte> file = bytes_of(kJournalMagic);
  for (const JournalBlock& block : blocks()) {
    const auto bytes = encode_journal_block(file.size(), block.kind, block.content);
    file.insert(file.end(), bytes.begin(), bytes.end());
  }
  return file;
}

TEST(Journal, ComesBackFromItsBytes) {
  const JournalContent content = decode_journal(journal());
  EXPECT_EQ(content.blocks, blocks());
  EXPECT_EQ(content.sound_size, journal().size());
  EXPECT_EQ(content.torn_bytes, 0U);
}

TEST(Journal, WhateverIsCutOffLeavesTheWholeBlocksBefore) {
  const std::vector<std::byte> whole = journal();
  std::size_t most = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const JournalContent content = decode_journal(std::span(whole).first(size));
    ASSERT_LE(content.blocks.size(), blocks().size());
    EXPECT_EQ(content.sound_size + content.torn_bytes, size);
    for (std::size_t i = 0; i < content.blocks.size(); ++i) {
      EXPECT_EQ(content.blocks[i], blocks()[i]);
    }
    EXPECT_GE(content.blocks.size(), most);
    most = content.blocks.size();
  }
  EXPECT_EQ(most, blocks().size());
}

TEST(Journal, AFlippedBitCutsItsBlockAndWhatFollows) {
  const std::vector<std::byte> whole = journal();
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::vector<std::byte> flipped = whole;
    flipped[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    const JournalContent content = decode_journal(flipped);
    EXPECT_LE(content.sound_size, bit / 8) << "bit " << bit;
    for (std::size_t i = 0; i < content.blocks.size(); ++i) {
      EXPECT_EQ(content.blocks[i], blocks()[i]);
    }
  }
}

TEST(Journal, ABlockThatLiesElsewhereIsNotTaken) {
  std::vector<std::byte> file = bytes_of(kJournalMagic);
  const auto block = encode_journal_block(file.size(), 2, bytes_of("twice"));
  for (int i = 0; i < 2; ++i) file.insert(file.end(), block.begin(), block.end());
  EXPECT_EQ(decode_journal(file).blocks.size(), 1U);
}

TEST(Journal, ASizeThatLiesIsNotBelieved) {
  std::vector<std::byte> file = bytes_of(kJournalMagic);
  for (int i = 0; i < 13; ++i) file.push_back(std::byte{0xff});
  EXPECT_TRUE(decode_journal(file).blocks.empty());
  EXPECT_TRUE(decode_journal(bytes_of("something else altogether")).blocks.empty());
}

}  // namespace
}  // namespace carpus::records
