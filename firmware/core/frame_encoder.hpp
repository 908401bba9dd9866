// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A frame on the wire: sync, kind, sequence, payload, checksum. The checksum begins with the
// protocol's version, which so costs no byte: a frame of another version is a corrupt one.
#pragma once

#include "firmware/core/crc16.hpp"
#include "firmware/core/wire.hpp"

namespace carpus {
namespace firmware {

/// The checksum of `length` bytes from the kind on.
inline uint16_t frame_crc(const uint8_t* from_kind, uint8_t length) {
  uint16_t crc = add_to_crc(kFirstCrc, version_in_checksum(from_kind[0]));
  for (uint8_t i = 0; i < length; ++i) crc = add_to_crc(crc, from_kind[i]);
  return crc;
}

/// Writes the frame, at most kMaxFrameBytes. @return its length.
template <typename Frame>
uint8_t encode_frame(const Frame& frame, uint8_t sequence, uint8_t* to) {
  to[0] = kSync;
  to[1] = kind_of(frame);
  to[2] = sequence;
  write_payload(frame, to + 3);
  const uint8_t length = payload_bytes_of(frame);
  write(frame_crc(to + 1, static_cast<uint8_t>(length + 2)), to + 3 + length);
  return static_cast<uint8_t>(length + kFrameOverhead);
}

}  // namespace firmware
}  // namespace carpus
