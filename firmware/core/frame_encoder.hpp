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

struct NoStart {
  void operator()(uint8_t) const {}
};

/// Writes the frame, at most kMaxFrameBytes. @return its length.
/// @param start  is told the length when all but the checksum is there: a slow board sends already.
template <typename Frame, typename Start = NoStart>
uint8_t encode_frame(const Frame& frame, uint8_t sequence, uint8_t* to, Start start = Start()) {
  const uint8_t payload = payload_bytes_of(frame);
  to[0] = kSync;
  to[1] = kind_of(frame);
  to[2] = sequence;
  write_payload(frame, to + 3);
  start(static_cast<uint8_t>(payload + kFrameOverhead));
  write(frame_crc(to + 1, static_cast<uint8_t>(payload + 2)), to + 3 + payload);
  return static_cast<uint8_t>(payload + kFrameOverhead);
}

}  // namespace firmware
}  // namespace carpus
