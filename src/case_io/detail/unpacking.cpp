// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/unpacking.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>

namespace carpus::case_io {
namespace {

using image_formats::Packing;
using image_formats::Refuser;

constexpr std::size_t kBlockBytes = std::size_t{1} << 18U;
/// Of zlib: window bits of 2^15, plus 16 for gzip's header and checksum, negative for neither.
constexpr int kZlibStream = 15;
constexpr int kGzipStream = 15 + 16;
constexpr int kBareStream = -15;

class Inflater {
 public:
  Inflater(int kind, const Refuser& refuse) : refuse_(refuse) {
    if (inflateInit2(&stream_, kind) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void feed(std::span<const std::byte> bytes) {
    rest_ = bytes;
    refill();
  }
  [[nodiscard]] std::size_t unread() const { return rest_.size() + stream_.avail_in; }
  /// What was fed and not used, where all of it was fed in one piece.
  [[nodiscard]] std::span<const std::byte> unused() const {
    return {reinterpret_cast<const std::byte*>(stream_.next_in), stream_.avail_in};
  }
  [[nodiscard]] bool is_at_end() const { return is_at_end_; }

  /// Up to `to`'s size; less only at the stream's end or where the input is used up.
  std::size_t take(std::span<std::byte> to) {
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(to.size());
    while (!is_at_end_ && stream_.avail_out > 0) {
      if (stream_.avail_in == 0) refill();
      const int outcome = inflate(&stream_, Z_NO_FLUSH);
      is_at_end_ = outcome == Z_STREAM_END;
      if (outcome == Z_MEM_ERROR) throw std::bad_alloc();
      if (outcome == Z_BUF_ERROR && unread() == 0) break;
      if (outcome != Z_OK && outcome != Z_STREAM_END) {
        refuse_.damaged("its compressed data",
                        stream_.msg != nullptr ? std::string("wrong (") + stream_.msg + ")"
                                               : std::string("wrong"),
                        "so that it cannot be unpacked");
      }
    }
    return to.size() - stream_.avail_out;
  }

  /// For the next member of a gzip file.
  void begin_again() {
    inflateReset(&stream_);
    is_at_end_ = false;
  }

 private:
  void refill() {
    constexpr std::size_t kMost = std::size_t{1} << 30U;  // zlib counts in 32 bits
    const std::size_t count = std::min(kMost, rest_.size());
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(rest_.data()));
    stream_.avail_in = static_cast<uInt>(count);
    rest_ = rest_.subspan(count);
  }

  const Refuser& refuse_;
  z_stream stream_{};
  std::span<const std::byte> rest_;
  bool is_at_end_ = false;
};

[[noreturn]] void refuse_length(const Refuser& refuse, bool is_short, std::uint64_t total) {
  refuse.damaged("its compressed data", is_short ? "cut short" : "longer than it should be",
                 "its header needs " + std::to_string(total) + " bytes");
}

/// One zero to an even length, or checksum and length as GDCM's writer leaves them there.
void check_behind(std::span<const std::byte> behind,
                  std::span<const std::byte> unpacked,
                  const Refuser& refuse) {
  constexpr std::size_t kTrailer = 8;
  bool is_right = behind.empty() || (behind.size() == 1 && behind[0] == std::byte{0});
  if (behind.size() >= kTrailer && behind.size() <= kTrailer + 1) {
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        value |= std::to_integer<std::uint32_t>(behind[at + i]) << (8U * i);
      }
      return value;
    };
    const auto* bytes = reinterpret_cast<const Bytef*>(unpacked.data());
    is_right = number(0) == crc32_z(0, bytes, unpacked.size()) &&
               number(4) == static_cast<std::uint32_t>(unpacked.size()) &&
               (behind.size() == kTrailer || behind.back() == std::byte{0});
  }
  if (is_right) return;
  refuse.damaged("its end", "followed by " + std::to_string(behind.size()) + " bytes",
                 "which belong to nothing or to other data");
}

}  // namespace

void unpack(std::span<const std::byte> stored,
            Packing packing,
            std::uint64_t total,
            const Refuser& refuse,
            const std::function<void(std::span<const std::byte>)>& take) {
  std::vector<std::byte> block(kBlockBytes);
  if (packing == Packing::Raw) {
    if (stored.size() != total) refuse_length(refuse, stored.size() < total, total);
    return take(stored);
  }
  Inflater inflater(packing == Packing::Gzip ? kGzipStream : kZlibStream, refuse);
  inflater.feed(stored);
  std::uint64_t done = 0;
  bool was_empty = false;
  std::uint64_t member_began = 0;
  for (;;) {
    const std::size_t got = inflater.take(block);
    done += got;
    if (done > total) refuse_length(refuse, false, total);
    take(std::span(block).first(got));
    if (!inflater.is_at_end()) {
      if (inflater.unread() == 0 && got < block.size()) refuse_length(refuse, true, total);
      continue;
    }
    if (inflater.unread() == 0) break;
    const bool is_empty = done == member_began;
    // Packers end with at most one empty member; more would be read through for nothing.
    if (packing != Packing::Gzip || (is_empty && was_empty)) {
      refuse.damaged("its end", "followed by " + std::to_string(inflater.unread()) + " bytes",
                     "which belong to nothing");
    }
    was_empty = is_empty;
    member_began = done;
    inflater.begin_again();
  }
  if (done < total) refuse_length(refuse, true, total);
}

std::vector<std::byte> unpack_front(image_formats::ByteSource& stored,
                                    std::size_t bytes,
                                    const Refuser& refuse) {
  // A gzip header may hold a name and a remark; behind it a few hundred bytes are enough.
  constexpr std::uint64_t kFrontBytes = 1 << 16;
  std::vector<std::byte> packed(
      static_cast<std::size_t>(std::min<std::uint64_t>(kFrontBytes, stored.size())));
  if (!stored.read(0, packed)) refuse.damaged("the file", "not readable", "check the disk");
  std::vector<std::byte> front(bytes);
  Inflater inflater(kGzipStream, refuse);
  inflater.feed(packed);
  front.resize(inflater.take(front));
  return front;
}

std::vector<std::byte> unpack_deflated(std::span<const std::byte> stored,
                                       std::uint64_t most,
                                       const Refuser& refuse) {
  std::vector<std::byte> unpacked;
  std::vector<std::byte> block(kBlockBytes);
  Inflater inflater(kBareStream, refuse);
  inflater.feed(stored);
  while (!inflater.is_at_end()) {
    const std::size_t got = inflater.take(block);
    if (!inflater.is_at_end() && got < block.size()) {
      refuse.damaged("its deflated data set", "cut short", "its end is missing");
    }
    if (got > most - unpacked.size()) {
      refuse.damaged("its deflated data set", "longer than " + std::to_string(most) + " bytes",
                     "more than a slice needs");
    }
    unpacked.insert(unpacked.end(), block.begin(),
                    block.begin() + static_cast<std::ptrdiff_t>(got));
  }
  check_behind(inflater.unused(), unpacked, refuse);
  return unpacked;
}

void check_packed_size(std::uint64_t stored, std::uint64_t total, const Refuser& refuse) {
  constexpr std::uint64_t kMostPacked = 1032;  // zlib's own limit
  constexpr std::uint64_t kSlack = 1 << 16;    // headers, names and remarks
  if (total / kMostPacked > stored + kSlack || stored > total + total / 8 + kSlack) {
    refuse.damaged("its compressed data", std::to_string(stored) + " bytes",
                   "which cannot be the " + std::to_string(total) + " that its header needs");
  }
}

}  // namespace carpus::case_io
