// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Frames out of a stream of bytes. What is no frame costs one byte: after a wrong checksum the
// search goes on behind the false sync, in bytes that are kept, so that garbage before, between or
// around frames never takes a whole one with it, however it looks.
#pragma once

#include "firmware/core/frame_encoder.hpp"

namespace carpus {
namespace firmware {

/// @tparam kPayloadBytes  length of the payload of a kind, 255 where the kind is none of ours.
/// @tparam kCapacity  length of the longest frame of those kinds.
template <uint8_t (*kPayloadBytes)(uint8_t), uint8_t kCapacity>
class FrameDecoder {
 public:
  /// Takes one byte; then ask next() until it says no.
  void push(uint8_t byte) {
    if (count_ == kRoom) drop(1);  // cannot be: next() leaves less than a frame
    if (first_ + count_ == kRoom) compact();
    bytes_[first_ + count_] = byte;
    ++count_;
  }

  /// Whether a frame has become whole; it stands until the next call of push() or next().
  bool next() {
    if (taken_ != 0) drop(taken_);
    taken_ = 0;
    while (count_ > 0) {
      if (length_ == 0) {
        if (at(0) != kSync) {
          drop(1);
          continue;
        }
        if (count_ < 2) return false;
        const uint8_t payload = kPayloadBytes(at(1));
        if (payload > kCapacity - kFrameOverhead) {  // 255: unknown
          ++refused_;
          drop(1);
          continue;
        }
        length_ = static_cast<uint8_t>(payload + kFrameOverhead);
        crc_ = add_to_crc(kFirstCrc, version_in_checksum(at(1)));
        summed_ = 1;
      }
      // Byte by byte as they come: the last one is answered the sooner.
      for (; summed_ < length_ - 2 && summed_ < count_; ++summed_) {
        crc_ = add_to_crc(crc_, at(summed_));
      }
      if (count_ < length_) return false;
      uint16_t crc = 0;
      read(bytes_ + first_ + length_ - 2, crc);
      if (crc != crc_) {
        ++refused_;
        drop(1);
        continue;
      }
      taken_ = length_;
      return true;
    }
    return false;
  }

  uint8_t kind() const { return at(1); }
  uint8_t sequence() const { return at(2); }
  const uint8_t* payload() const { return bytes_ + first_ + 3; }
  /// False where it is another kind or a field is out of its range.
  template <typename Frame>
  bool read_frame(Frame& out) const {
    return kind() == kind_of(out) && read_payload(payload(), out);
  }
  /// How many bytes the frame that has begun still waits for, if it is one; 255: none has.
  uint8_t missing() const {
    return length_ == 0 || taken_ != 0 ? uint8_t{255} : static_cast<uint8_t>(length_ - count_);
  }
  /// Sync bytes that began no frame, since the start; wraps.
  uint16_t refused() const { return refused_; }

 private:
  // Twice a frame, so that moving bytes to the front is rare.
  static constexpr uint8_t kRoom = 2 * kCapacity;
  static_assert(kCapacity <= 120, "places must fit a byte");

  uint8_t at(uint8_t i) const { return bytes_[first_ + i]; }
  void drop(uint8_t n) {
    first_ = static_cast<uint8_t>(first_ + n);
    count_ = static_cast<uint8_t>(count_ - n);
    if (count_ == 0) first_ = 0;
    length_ = 0;
  }
  void compact() {
    for (uint8_t i = 0; i < count_; ++i) bytes_[i] = bytes_[first_ + i];
    first_ = 0;
  }

  uint8_t bytes_[kRoom] = {};
  uint8_t first_ = 0;
  uint8_t count_ = 0;
  uint8_t taken_ = 0;
  uint8_t length_ = 0;  ///< of the frame that has begun; 0: none has, as far as is known
  uint8_t summed_ = 0;  ///< how many of its bytes are in `crc_`
  uint16_t crc_ = 0;
  uint16_t refused_ = 0;
};

/// What a host reads.
using HostDecoder = FrameDecoder<device_to_host_payload_bytes, kMaxDeviceFrameBytes>;
/// What a device of any drive reads.
using DeviceDecoder = FrameDecoder<host_to_device_payload_bytes, kMaxFrameBytes>;

}  // namespace firmware
}  // namespace carpus
